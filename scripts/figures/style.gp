# SPDX-License-Identifier: Apache-2.0
# What the paper's figures share: terminal, colours, names of files, labels.

set terminal svg size 900,figure_height font "sans-serif,14" background rgb "white"
set output output_file
set datafile separator ","
set datafile columnheaders
set encoding utf8

# Okabe and Ito's palette: true motion black, the paper as printed vermilion, others blue, gn broad
# and light, so that the truth shows on it.
set linetype 1 linecolor rgb "#000000" linewidth 1.2
set linetype 2 linecolor rgb "#D55E00" linewidth 1.8
set linetype 3 linecolor rgb "#0072B2" linewidth 1.8
set linetype 4 linecolor rgb "#56B4E9" linewidth 4.5

set border 3 linewidth 0.8
set tics nomirror out scale 0.5
set grid linecolor rgb "#dddddd" linewidth 0.6
set key noautotitle horizontal samplen 2

motion(name) = work."/".name.".csv"
tilt_deg(z_m) = acos(-z_m / 0.3) * 180 / pi
# Labels of a column of panels at one distance, however wide the numbers are.
label_y = "set label 1 y_words at graph y_place,0.5 center rotate"
# The moment of an estimate as a sample number.
of_t = "(20 * column('t_s'))"
# What the lines of a measurement are, in the top right corner: to set before a figure's first panel
# and to take away after it.
legend = "set label 21 'gn' at screen 0.71,0.975 right; \
  set label 22 'truth' at screen 0.815,0.975 right; \
  set label 23 'Appendix A' at screen 0.955,0.975 right; \
  set arrow 21 from screen 0.717,0.975 rto screen 0.028,0 nohead linetype 4; \
  set arrow 22 from screen 0.822,0.975 rto screen 0.028,0 nohead linetype 1; \
  set arrow 23 from screen 0.962,0.975 rto screen 0.028,0 nohead linetype 2"
no_legend = "unset label 21; unset label 22; unset label 23; \
  unset arrow 21; unset arrow 22; unset arrow 23"
