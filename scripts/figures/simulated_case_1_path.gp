# SPDX-License-Identifier: Apache-2.0
# Figure 3: case 1 simulated, the path in space and from above.

figure_height = 440
load style
set multiplot
set xrange [-60:60]
set yrange [-60:60]
set tics 40
set key at screen 0.98,0.995 right top

set lmargin at screen 0.60
set rmargin at screen 0.98
set tmargin at screen 0.88
set bmargin at screen 0.16
set size ratio -1
set xlabel "x (mm)"
set ylabel "y (mm)"
set label 1 "start" at 36.83,36.83 right offset -1,0.5 point pointtype 7 pointsize 0.7
plot motion("case_1_euler_cut") using (1e3 * column("x_m")):($1 <= 20 ? 1e3 * column("y_m") : NaN) \
       with lines linetype 2 linewidth 5 title "explicit Euler, 20 samples", \
     motion("case_1") using (1e3 * column("x_m")):(1e3 * column("y_m")) with lines linetype 1 \
       linewidth 1.6 title "exact, 200 samples"
unset label 1
unset key

z_least = -300; z_most = -288; z_step = 4
load space
set view 62,35,1,1
set origin 0,-0.04
set size 0.56,1.08
splot motion("case_1_euler_cut") using (1e3 * column("x_m")):(1e3 * column("y_m")):\
        ($1 <= 20 ? 1e3 * column("z_m") : NaN) with lines linetype 2 linewidth 3, \
      motion("case_1") using (1e3 * column("x_m")):(1e3 * column("y_m")):(1e3 * column("z_m")) \
        with lines linetype 1 linewidth 1.4
unset multiplot
