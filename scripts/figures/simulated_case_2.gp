# SPDX-License-Identifier: Apache-2.0
# Figure 4: case 2 simulated at 2 and at 6 rad/s: x, y, z against the sample number; the schemes.

figure_height = 840
load style
array swings[2] = ["2", "6"]
y_place = -0.17
set multiplot layout 4,2 columnsfirst margins 0.095,0.98,0.065,0.955 spacing 0.105,0.055
set xrange [0:1000]
unset key

do for [column_number = 1:2] {
  swing = "case_2_".swings[column_number]
  doubled = column_number == 1 ? doubled_2 : doubled_6

  set title sprintf("started with %s rad/s", swings[column_number]) offset 0,-0.3
  set xrange [0:1000]
  set xtics 250
  set format x ""
  unset xlabel
  y_words = "x (mm)"; @label_y
  set yrange [-60:60]
  set ytics 40
  plot motion(swing) using 1:(1e3 * column("x_m")) with lines linetype 1 linewidth 0.9
  unset title

  y_words = "y (mm)"; @label_y
  plot motion(swing) using 1:(1e3 * column("y_m")) with lines linetype 1 linewidth 0.9

  set format x "%g"
  y_words = "z (mm)"; @label_y
  set yrange [-300.5:-294]
  set ytics 2
  plot motion(swing) using 1:(1e3 * column("z_m")) with lines linetype 1 linewidth 0.9

  y_words = "tilt (deg)"; @label_y
  set xlabel "sample number, 20 a second" offset 0,0.4
  set xrange [0:(column_number == 1 ? 20 : 60)]
  set xtics column_number == 1 ? 5 : 15
  set yrange [0:100]
  set ytics 30
  set label 2 sprintf("explicit: energy\ndoubled by sample %d", doubled) at graph \
    (column_number == 1 ? 0.56 : 0.04),(column_number == 1 ? 0.36 : 0.90)
  if (column_number == 1) { set key at graph 1.02,1.06 right top vertical } else { unset key }
  plot motion(swing) using 1:(tilt_deg(column("z_m"))) with lines linetype 1 title "exact", \
       motion(swing."_semi-implicit_cut") using 1:(tilt_deg(column("z_m"))) with lines linetype 3 \
         dashtype (6,4) title "semi-implicit Euler", \
       motion(swing."_euler_cut") using 1:(tilt_deg(column("z_m"))) with lines linetype 2 \
         title "explicit Euler"
  unset key
  unset label 2
}
unset multiplot
