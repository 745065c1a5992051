# SPDX-License-Identifier: Apache-2.0
# Figure 14: how the swing of case 2 starts, drawn from above and from the side.

figure_height = 400
load style
unset border
unset tics
unset grid
theta = 25 * pi / 180  # drawn larger than the 10 deg that it is
phi = 45 * pi / 180
r = sin(theta)
start_x = r * cos(phi)
start_y = r * sin(phi)
set style arrow 1 head filled size screen 0.012,20 linecolor rgb "#000000" linewidth 1
set style arrow 2 nohead linecolor rgb "#000000" linewidth 2
set style arrow 3 head filled size screen 0.016,20 linecolor rgb "#D55E00" linewidth 2.5
set style arrow 4 nohead linecolor rgb "#888888" linewidth 1 dashtype (4,4)
set style arrow 5 nohead linecolor rgb "#0072B2" linewidth 3
set multiplot
set size ratio -1
set parametric
set trange [0:1]

# From above: the circle of radius r, the start at azimuth phi, the velocity along the tangent.
set lmargin at screen 0.02
set rmargin at screen 0.44
set tmargin at screen 0.94
set bmargin at screen 0.03
set xrange [-0.55:0.75]
set yrange [-0.50:0.72]
set label 1 "from above" at -0.54,0.68
set arrow 1 from 0,0 to 0.66,0 arrowstyle 1
set arrow 2 from 0,0 to 0,0.62 arrowstyle 1
set label 2 "X" at 0.68,0
set label 3 "Y" at 0,0.67 center
set arrow 3 from 0,0 to start_x,start_y arrowstyle 2
set label 4 "r = l sin θ" at -0.03,-0.08 left
set arrow 4 from start_x,start_y rto -0.26 * sin(phi),0.26 * cos(phi) arrowstyle 3
set label 5 "v = r ψ" at start_x - 0.05,start_y + 0.20 left textcolor rgb "#D55E00"
set label 6 "φ = 45°" at 0.19,0.07
set label 7 "start" at start_x,start_y left offset 1,0 point pointtype 7 pointsize 1.2
plot r * cos(2 * pi * t),r * sin(2 * pi * t) linecolor rgb "#888888" linewidth 1 dashtype (4,4), \
     0.16 * cos(t * phi),0.16 * sin(t * phi) linecolor rgb "#000000" linewidth 1
unset label
unset arrow

# From the side, in the vertical plane through the rod: pivot at the origin.
set lmargin at screen 0.46
set rmargin at screen 0.99
set xrange [-0.40:1.45]
set yrange [-1.12:0.20]
set label 1 "from the side" at -0.38,0.16
set arrow 1 from 0,0 to 0,-1.08 arrowstyle 4
set arrow 2 from 0,0 to r,-cos(theta) arrowstyle 2
set arrow 3 from 0.12 * r - 0.14 * cos(theta),-0.12 * cos(theta) - 0.14 * r \
  rto 0.28 * cos(theta),0.28 * r arrowstyle 5
set label 2 "disc" at 0.2,-0.04 textcolor rgb "#0072B2"
set label 3 "l = 0.3 m" at 0.28,-0.45
set label 4 "θ" at 0.09,-0.46 center
set arrow 4 from 0,-cos(theta) to r,-cos(theta) arrowstyle 4
set label 5 "r" at r / 2,-cos(theta) - 0.07 center
set label 6 "mass" at r,-cos(theta) left offset 1.2,0 point pointtype 7 pointsize 1.5
set label 7 "pivot" at 0,0 right offset -1,0.4 point pointtype 6 pointsize 0.8
set label 8 "θ = 10°, drawn larger" at 0.70,0.16
set label 9 "ψ = 2 rad/s: v = 0.104 m/s\nψ = 5.76 rad/s: 0.300 m/s,\n  the conical swing\n\
ψ = 6 rad/s: 0.313 m/s\nthe paper: 0.42 m/s, for\n  θ = 45° and 2 rad/s" at 0.70,-0.08
plot 0.38 * sin(t * theta),-0.38 * cos(t * theta) linecolor rgb "#000000" linewidth 1
unset multiplot
