# SPDX-License-Identifier: Apache-2.0
# Figure 12: case 1 measured on the simulated rig, x, y and z against the sample number; the errors.

figure_height = 780
load style
y_place = -0.072
swing = "measured_1"
set multiplot layout 4,1 margins 0.09,0.98,0.07,0.955 spacing 0,0.045
set xrange [0:200]
set format x ""
@legend

y_words = "x (mm)"; @label_y
set yrange [-45:45]
set ytics 30
plot motion(swing."_gn") using @of_t:(1e3 * column("x_m")) with lines linetype 4, \
     motion(swing."_truth") using ($1 / 2):(1e3 * column("x_m")) with lines linetype 1, \
     motion(swing."_paper") using @of_t:(1e3 * column("x_m")) with lines linetype 2
@no_legend

y_words = "y (mm)"; @label_y
plot motion(swing."_gn") using @of_t:(1e3 * column("y_m")) with lines linetype 4, \
     motion(swing."_truth") using ($1 / 2):(1e3 * column("y_m")) with lines linetype 1, \
     motion(swing."_paper") using @of_t:(1e3 * column("y_m")) with lines linetype 2

y_words = "z (mm)"; @label_y
set yrange [-300.5:-295]
set ytics 2
plot motion(swing."_gn") using @of_t:(1e3 * column("z_m")) with lines linetype 4, \
     motion(swing."_truth") using ($1 / 2):(1e3 * column("z_m")) with lines linetype 1, \
     motion(swing."_paper") using @of_t:(1e3 * column("z_m")) with lines linetype 2

y_words = "error (deg)"; @label_y
set xlabel "sample number, 20 a second" offset 0,0.4
set format x "%g"
set yrange [-2:2]
set ytics 1
set label 2 "theta1, the filter's delay taken out of both" at graph 0.02,0.94
plot motion(swing."_gn_error") using 1:2 with lines linetype 4, \
     motion(swing."_aligned_error") using 1:2 with lines linetype 2
unset multiplot
