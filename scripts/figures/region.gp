# SPDX-License-Identifier: Apache-2.0
# Draws where two sensors can tell the tilt, the paper's layout: gnuplot -d -c region.gp PNG
set terminal pngcairo size 760,640 font "sans,12"
set output ARG1
rad = pi / 180
lp = 0.02
dx = 0.02
dy = 0.02
# method.md eq. 14 with the rod's direction of eq. 6
conditioning(theta1, theta2) = 1 + lp / dx * sin(theta2) - lp / dy * sin(theta1) * cos(theta2)

set title "Conditioning of two sensors, paper's layout"
set xlabel "theta1 / deg"
set ylabel "theta2 / deg"
set cblabel "1: as sensitive as at rest; 0: blind in one direction"
set xrange [-45:45]
set yrange [-45:45]
set urange [-45:45]
set vrange [-45:45]
set size square
set view map
set samples 181
set isosamples 181
set cbrange [-0.5:2]
set palette defined (-0.5 "#7f3b08", 0 "#e08214", 0.3 "#fee0b6", 1 "#f7f7f7", 2 "#2d004b")
set table $contours
set contour base
set cntrparam levels discrete 0, 0.3
unset surface
splot conditioning(x * rad, y * rad)
unset table
unset contour
set surface
set label 1 "0.3: flagged below" at 9, -38.5 rotate by 42 front
set label 2 "0: singular" at 30, -40 rotate by 46 front
set object 1 circle at 0,0 size 10 front fillstyle empty border linecolor rgb "#1b7837" linewidth 2
set label 3 "10 deg swing" at -9, 12.5 textcolor rgb "#1b7837" front
plot "++" using 1:2:(conditioning($1 * rad, $2 * rad)) with image notitle, \
     $contours with lines linecolor rgb "black" linewidth 2 notitle
