# SPDX-License-Identifier: Apache-2.0
# What a figure shows: curves and axes of gnuplot's SVG, back in the data's units.
import re

NUMBER = r"-?[\d.]+"
PANEL_NAMES = "abcdefg"


def texts(svg):
    """All that stands written in the figure."""
    return [re.sub(r"</?tspan[^>]*>", "", text).strip()
            for text in re.findall(r"<text>(.*?)</text>", svg, re.DOTALL)]


def placed_texts(svg):
    """(x, y, text) of all that stands written upright, in pixels."""
    pattern = (rf'<g transform="translate\(({NUMBER}),({NUMBER})\)" [^>]*>\s*<text>(.*?)</text>')
    found = [(float(x), float(y), re.sub(r"</?tspan[^>]*>", "", text).strip())
             for x, y, text in re.findall(pattern, svg, re.DOTALL)]
    return [place for place in found if place[2]]


def ticks(part, anchor, axis):
    """(pixel, value) of the ticks of one axis, at the marks themselves."""
    pattern = (rf"<path [^>]*d='M({NUMBER}),({NUMBER}) [^']*'/>\s*"
               rf'<g transform="translate[^>]*text-anchor="{anchor}">\s*'
               rf"<text>(?:<tspan[^>]*>)?\s*({NUMBER})\s*(?:</tspan>)?</text>")
    return [(float(found[axis]), float(found[2])) for found in re.findall(pattern, part)]


class Scale:
    """A linear axis, by its first and last tick."""

    def __init__(self, marks):
        (self.pixel, self.value), (pixel, value) = marks[0], marks[-1]
        self.per_unit = (pixel - self.pixel) / (value - self.value)

    def pixel_of(self, value):
        return self.pixel + (value - self.value) * self.per_unit


def panel(svg, index):
    """The part of the SVG that draws a panel with its axes."""
    starts = [svg.index(f'id="gnuplot_plot_1{name}"')
              for name in PANEL_NAMES if f'id="gnuplot_plot_1{name}"' in svg]
    begin = 0 if index == 0 else starts[index - 1]
    end = starts[index + 1] if index + 1 < len(starts) else len(svg)
    return svg[begin:end], svg[begin:starts[index]]


def curve(svg, number, index):
    """Vertices in pixels of a panel's curve, a list for each unbroken piece."""
    begin = svg.index(f'id="gnuplot_plot_{number}{PANEL_NAMES[index]}"')
    end = svg.find('id="gnuplot_plot_', begin + 1)
    part = svg[begin:end if end > 0 else len(svg)]
    part = part[:part.index("\n\t</g>\n")]
    pieces = []
    for path in re.findall(r"<path [^>]*d='([^']*)'", part):
        for piece in path.split("M")[1:]:
            pieces.append([(float(x), float(y))
                           for x, y in re.findall(rf"({NUMBER}),({NUMBER})", piece)])
    return pieces


def axes(svg, index):
    """The scales of a panel's two axes."""
    _, before = panel(svg, index)
    x, y = ticks(before, "middle", 0), ticks(before, "end", 1)
    # What stands before a panel's first curve are also the axes' ticks of the panel above.
    return Scale(last_run(x)), Scale(last_run(y))


def last_run(marks):
    """The last ticks whose values rise."""
    begin = len(marks) - 1
    while begin > 0 and marks[begin - 1][1] < marks[begin][1]:
        begin -= 1
    return marks[begin:]
