# SPDX-License-Identifier: Apache-2.0
# What the views in space share: the box and its labels; z reaches from z_least to z_most mm.

unset lmargin
unset rmargin
unset tmargin
unset bmargin
unset title
unset xlabel
unset ylabel
set size noratio
set border 895 linewidth 0.6
set xyplane 0
set grid x y z linecolor rgb "#dddddd" linewidth 0.6
set zrange [z_least:z_most]
set ztics z_step
set label 11 "x (mm)" at first 0,-60,z_least offset -2.5,-2.2 center
set label 12 "y (mm)" at first 60,0,z_least offset 1.8,-2 left
set label 13 "z (mm)" at first -60,-60,z_most offset -2.5,1 center
