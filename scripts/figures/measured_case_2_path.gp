# SPDX-License-Identifier: Apache-2.0
# Figure 16: case 2 measured on the simulated rig at 2 and at 6 rad/s, the path in three views.

figure_height = 720
load style
load panels
z_least = -300; z_most = -294; z_step = 2
set multiplot
@legend
do for [row = 0:1] {
  swing = row == 0 ? "measured_2" : "measured_6"
  row_words = row == 0 ? "2 rad/s, " : "6 rad/s, "
  row_top = 0.96 - 0.48 * row
  row_bottom = row_top - 0.47
  @side_panel
  plot motion(swing."_gn") using @xz with lines linetype 4 linewidth 2, \
       motion(swing."_truth") every 2 using @xz with lines linetype 1 linewidth 0.7, \
       motion(swing."_paper") using @xz with lines linetype 2 linewidth 0.8
  @no_legend
  @top_panel
  plot motion(swing."_gn") using @xy with lines linetype 4 linewidth 2, \
       motion(swing."_truth") every 2 using @xy with lines linetype 1 linewidth 0.7, \
       motion(swing."_paper") using @xy with lines linetype 2 linewidth 0.8
  @space_panel
  splot motion(swing."_gn") using @xyz with lines linetype 4 linewidth 2, \
        motion(swing."_truth") every 2 using @xyz with lines linetype 1 linewidth 0.7, \
        motion(swing."_paper") using @xyz with lines linetype 2 linewidth 0.8
}
unset multiplot
@legend
