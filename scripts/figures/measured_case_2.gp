# SPDX-License-Identifier: Apache-2.0
# Figure 15: case 2 measured on the simulated rig at 2 and at 6 rad/s, x, y, z; the errors.

figure_height = 820
load style
y_place = -0.17
array swings[2] = ["measured_2", "measured_6"]
array starts[2] = ["2", "6"]
set multiplot layout 4,2 columnsfirst margins 0.095,0.98,0.065,0.915 spacing 0.105,0.05
set xrange [0:200]
set xtics 50

@legend
do for [column_number = 1:2] {
  swing = swings[column_number]
  set title sprintf("started with %s rad/s", starts[column_number]) offset 0,-0.4
  set format x ""
  unset xlabel
  unset label 2

  y_words = "x (mm)"; @label_y
  set yrange [-60:60]
  set ytics 40
  plot motion(swing."_gn") using @of_t:(1e3 * column("x_m")) with lines linetype 4, \
       motion(swing."_truth") using ($1 / 2):(1e3 * column("x_m")) with lines linetype 1, \
       motion(swing."_paper") using @of_t:(1e3 * column("x_m")) with lines linetype 2
  @no_legend
  unset title

  y_words = "y (mm)"; @label_y
  plot motion(swing."_gn") using @of_t:(1e3 * column("y_m")) with lines linetype 4, \
       motion(swing."_truth") using ($1 / 2):(1e3 * column("y_m")) with lines linetype 1, \
       motion(swing."_paper") using @of_t:(1e3 * column("y_m")) with lines linetype 2

  y_words = "z (mm)"; @label_y
  set yrange [-300.5:-294]
  set ytics 2
  plot motion(swing."_gn") using @of_t:(1e3 * column("z_m")) with lines linetype 4, \
       motion(swing."_truth") using ($1 / 2):(1e3 * column("z_m")) with lines linetype 1, \
       motion(swing."_paper") using @of_t:(1e3 * column("z_m")) with lines linetype 2

  y_words = "error (deg)"; @label_y
  set xlabel "sample number, 20 a second" offset 0,0.4
  set format x "%g"
  set yrange [-3:3]
  set ytics 1
  set label 2 "theta1, delay taken out" at graph 0.03,0.94
  plot motion(swing."_gn_error") using 1:2 with lines linetype 4, \
       motion(swing."_aligned_error") using 1:2 with lines linetype 2
}
unset multiplot
