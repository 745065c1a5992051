# SPDX-License-Identifier: Apache-2.0
# Figure 13: case 1 measured on the simulated rig, the path in three views.

figure_height = 380
load style
load panels
z_least = -300; z_most = -294; z_step = 2
swing = "measured_1"
row_words = ""
row_top = 0.93
row_bottom = 0.03
set multiplot
@legend
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
unset multiplot
@legend
