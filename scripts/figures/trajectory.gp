# SPDX-License-Identifier: Apache-2.0
# Draws a trajectory from above and its angles against time: gnuplot -d -c trajectory.gp ANGLES TRUTH PNG
angles = ARG1
truth = ARG2
set terminal pngcairo size 1200,520 font "sans,11" linewidth 1.4
set output ARG3
set datafile separator ","
set grid linecolor rgb "#dddddd"
degrees = 180 / pi

set multiplot layout 1,2
set title "Path of the mass, from above"
set xlabel "x / mm"
set ylabel "y / mm"
set size ratio -1
set key center center
plot truth using (column("x_m")*1e3):(column("y_m")*1e3) with lines linecolor rgb "#999999" title "truth", \
     angles using (column("x_m")*1e3):(column("y_m")*1e3) with points pointtype 7 pointsize 0.5 \
       linecolor rgb "#0072b2" title "estimate"

set title "Angles of the rod"
set xlabel "t / s"
set ylabel "angle / deg"
set size noratio
set xrange [0:*]
set yrange [*:*]
set offsets 0, 0, 3, 0
set key top center horizontal
plot truth using (column("t_us")*1e-6):(column("theta1_rad")*degrees) with lines linecolor rgb "#999999" title "truth", \
     truth using (column("t_us")*1e-6):(column("theta2_rad")*degrees) with lines linecolor rgb "#999999" notitle, \
     angles using (column("t_s")):(column("theta1_rad")*degrees) with points pointtype 7 pointsize 0.5 \
       linecolor rgb "#0072b2" title "theta1", \
     angles using (column("t_s")):(column("theta2_rad")*degrees) with points pointtype 7 pointsize 0.5 \
       linecolor rgb "#d55e00" title "theta2"
unset multiplot
