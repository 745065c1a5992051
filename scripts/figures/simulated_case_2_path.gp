# SPDX-License-Identifier: Apache-2.0
# Figure 5: case 2 simulated at 2 and at 6 rad/s: the path in three views.

figure_height = 680
load style
load panels
z_least = -300; z_most = -294; z_step = 2
set multiplot
do for [row = 0:1] {
  swing = row == 0 ? "case_2_2" : "case_2_6"
  row_words = row == 0 ? "2 rad/s, " : "6 rad/s, "
  row_top = 1 - 0.5 * row
  row_bottom = row_top - 0.49

  @side_panel
  plot motion(swing) using @xz with lines linetype 1 linewidth 0.5
  @top_panel
  plot motion(swing) using @xy with lines linetype 1 linewidth 0.5
  @space_panel
  splot motion(swing) using @xyz with lines linetype 1 linewidth 0.3
}
unset multiplot
