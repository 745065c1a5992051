# SPDX-License-Identifier: Apache-2.0
# Figure 2: case 1 simulated, x, y and z against the sample number, and how the scheme runs away.

figure_height = 780
load style
y_place = -0.072
set multiplot layout 4,1 margins 0.09,0.98,0.07,0.955 spacing 0,0.045
set xrange [0:200]
set format x ""
set key at screen 0.98,0.995 right top

y_words = "x (mm)"; @label_y
set yrange [-60:60]
set ytics 40
plot motion("case_1") using 1:(1e3 * column("x_m")) with lines linetype 1 title "exact", \
     motion("case_1_semi") using 1:(1e3 * column("x_m")) with lines linetype 3 dashtype (6,4) \
       title "semi-implicit Euler", \
     motion("case_1_euler_cut") using 1:($1 <= 20 ? 1e3 * column("x_m") : NaN) with lines \
       linetype 2 title "explicit Euler"
unset key

y_words = "y (mm)"; @label_y
plot motion("case_1") using 1:(1e3 * column("y_m")) with lines linetype 1, \
     motion("case_1_semi") using 1:(1e3 * column("y_m")) with lines linetype 3 dashtype (6,4), \
     motion("case_1_euler_cut") using 1:($1 <= 20 ? 1e3 * column("y_m") : NaN) with lines linetype 2

y_words = "z (mm)"; @label_y
set yrange [-300.5:-293]
set ytics 2
plot motion("case_1") using 1:(1e3 * column("z_m")) with lines linetype 1, \
     motion("case_1_semi") using 1:(1e3 * column("z_m")) with lines linetype 3 dashtype (6,4), \
     motion("case_1_euler_cut") using 1:($1 <= 13 ? 1e3 * column("z_m") : NaN) with lines linetype 2

y_words = "tilt (deg)"; @label_y
set xlabel "sample number, 20 a second" offset 0,0.4
set format x "%g"
set yrange [0:100]
set ytics 30
set label 2 sprintf("explicit Euler: energy doubled by sample %d,\n\
over the horizontal at sample %d", doubled, over) at 64,78
plot motion("case_1") using 1:(tilt_deg(column("z_m"))) with lines linetype 1, \
     motion("case_1_semi") using 1:(tilt_deg(column("z_m"))) with lines linetype 3 dashtype (6,4), \
     motion("case_1_euler_cut") using 1:(tilt_deg(column("z_m"))) with lines linetype 2
unset multiplot
