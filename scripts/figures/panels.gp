# SPDX-License-Identifier: Apache-2.0
# Macros for the three views of a path in one row: from the side, from above, in space.
# The row reaches on the screen from row_bottom to row_top; z from z_least to z_most mm.

flat_panel = "set size noratio; set border 3 linewidth 0.8; set tics nomirror out scale 0.5; \
  unset label 11; unset label 12; unset label 13; \
  set xrange [-60:60]; set xtics 40; set xlabel 'x (mm)' offset 0,0.3; \
  set tmargin at screen row_top - 28.0 / figure_height; \
  set bmargin at screen row_bottom + 58.0 / figure_height"
side_panel = flat_panel."; set title row_words.'from the side' offset 0,-0.6; \
  set lmargin at screen 0.085; set rmargin at screen 0.32; \
  set yrange [z_least:z_most]; set ytics z_step; set ylabel 'z (mm)' offset 1"
top_panel = flat_panel."; set title row_words.'from above'; \
  set lmargin at screen 0.395; set rmargin at screen 0.66; \
  set yrange [-60:60]; set ytics 40; set ylabel 'y (mm)' offset 1.5"
space_panel = "load space; set view 62,35,1.2,1.0; set origin 0.69,row_bottom; \
  set size 0.29,row_top - row_bottom"

# What the three views plot, in mm.
xz = "(1e3 * column('x_m')):(1e3 * column('z_m'))"
xy = "(1e3 * column('x_m')):(1e3 * column('y_m'))"
xyz = "(1e3 * column('x_m')):(1e3 * column('y_m')):(1e3 * column('z_m'))"
