#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the wiring of both boards: wiring.py FOLDER writes wiring_pico.svg and wiring_nucleo.svg."""
import pathlib
import sys

# Per board: its name, then what stands beside each pin.
BOARDS = {
    "pico": ("Raspberry Pi Pico", {
        "supply": "3V3(OUT) · 36", "emitters": "GPIO15 · 20", "ground": "GND · 18",
        "x": "GPIO26 ADC0 · 31", "y": "GPIO27 ADC1 · 32", "analogue_ground": "AGND · 33"}),
    "nucleo": ("Nucleo-F446RE", {
        "supply": "3V3 · CN6-4", "emitters": "D7 PA8 · CN9-8", "ground": "GND · CN6-6",
        "x": "A0 PA0 · CN8-1", "y": "A1 PA1 · CN8-2", "analogue_ground": "AGND · CN10-32"}),
}
BLACK, BLUE, RED = "#222222", "#1f5fbf", "#b5391f"
LEFT, RIGHT = 390, 630  # edges of the board
SUPPLY, EMITTERS, GROUND, X, Y = 90, 320, 450, 250, 300  # heights of the pins


class Drawing:
    def __init__(self, width, height):
        self.parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
                      f'width="{width}" height="{height}" font-family="sans-serif" font-size="14">',
                      f'<rect width="{width}" height="{height}" fill="white"/>']

    def path(self, data, color=BLACK, fill="none"):
        self.parts.append(f'<path d="{data}" stroke="{color}" stroke-width="2" fill="{fill}"/>')

    def wire(self, *points, color=BLACK):
        self.path("M" + " L".join(f"{x} {y}" for x, y in points), color)

    def dot(self, x, y, color=BLACK):
        self.parts.append(f'<circle cx="{x}" cy="{y}" r="4" fill="{color}"/>')

    def text(self, x, y, words, anchor="start", color=BLACK, weight="normal"):
        self.parts.append(f'<text x="{x}" y="{y}" text-anchor="{anchor}" fill="{color}" '
                          f'font-weight="{weight}">{words}</text>')

    def box(self, x, y, width, height):
        self.parts.append(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="8" '
                          f'stroke="{BLACK}" stroke-width="2" fill="#eef3ee"/>')

    def resistor(self, x, top, bottom, label):
        """Upright, its body 44 high in the middle of the wire."""
        body = (top + bottom) // 2 - 22
        self.wire((x, top), (x, body))
        self.wire((x, body + 44), (x, bottom))
        self.path(f"M{x - 9} {body} h18 v44 h-18 z", fill="white")
        for i, line in enumerate(label.split("|")):
            self.text(x + 16, body + 18 + 17 * i, line)

    def led(self, x, top, bottom):
        middle = (top + bottom) // 2
        self.wire((x, top), (x, middle - 11))
        self.wire((x, middle + 11), (x, bottom))
        self.path(f"M{x - 13} {middle - 11} h26 L{x} {middle + 11} z", fill="white")
        self.wire((x - 13, middle + 11), (x + 13, middle + 11))
        for shift in (0, 9):
            self.path(f"M{x + 17} {middle - 2 + shift} l14 -8 m-7 -1 l7 1 l-3 6", RED)

    def transistor(self, x, top, bottom, side):
        """NPN, collector on top; its base looks to side -1 (left) or 1 (right)."""
        middle = (top + bottom) // 2
        base = x + 20 * side
        self.wire((x, top), (x, middle - 24), (base, middle - 8))
        self.wire((base, middle + 8), (x, middle + 24), (x, bottom))
        self.wire((base, middle - 20), (base, middle + 20))
        # The arrow on the emitter.
        self.path(f"M{x} {middle + 24} l{10 * side} -1 l{-4 * side} -9 z", fill=BLACK)
        return base, middle

    def save(self, path):
        path.write_text("\n".join([*self.parts, "</svg>", ""]), encoding="utf-8")


def draw_emitters(drawing):
    """Left of the board: both LEDs on one transistor."""
    for x, name in ((70, "Sx"), (190, "Sy")):
        drawing.resistor(x, SUPPLY, 170, "100 Ω")
        drawing.led(x, 170, 240)
        drawing.text(x - 18, 232, name, anchor="end", weight="bold")
    drawing.wire((70, SUPPLY), (LEFT, SUPPLY))
    drawing.dot(190, SUPPLY)
    drawing.wire((70, 240), (190, 240))
    drawing.dot(130, 240)
    base, middle = drawing.transistor(130, 240, GROUND, 1)
    drawing.text(112, middle + 5, "2N3904", anchor="end")
    drawing.wire((base, middle), (base + 30, middle), (base + 30, EMITTERS), (200, EMITTERS))
    drawing.path(f"M200 {EMITTERS - 9} h44 v18 h-44 z", fill="white")
    drawing.text(206, EMITTERS - 16, "1 kΩ")
    drawing.wire((244, EMITTERS), (LEFT, EMITTERS))
    drawing.dot(290, EMITTERS)
    drawing.resistor(290, EMITTERS, GROUND, "10 kΩ")
    drawing.dot(290, GROUND)
    drawing.wire((130, GROUND), (LEFT, GROUND))


def draw_receivers(drawing):
    """Right of the board: a phototransistor and its load for each channel."""
    for x, pin, name, color in ((760, X, "Sx", BLUE), (900, Y, "Sy", RED)):
        base, middle = drawing.transistor(x, SUPPLY, pin, 1)
        for shift in (0, 9):
            drawing.path(f"M{base + 26} {middle - 10 + shift} l-16 8 m7 2 l-7 -2 l3 -6", RED)
        drawing.text(x - 12, middle + 5, name, anchor="end", weight="bold")
        drawing.dot(x, pin, color)
        drawing.resistor(x, pin, GROUND, "R load|330 Ω")
        drawing.dot(x, GROUND)
    drawing.wire((RIGHT, SUPPLY), (900, SUPPLY))
    drawing.dot(760, SUPPLY)
    drawing.wire((RIGHT, X), (760, X), color=BLUE)
    # The wire of y hops over the column of x.
    drawing.path(f"M{RIGHT} {Y} H752 a8 8 0 0 1 16 0 H900", RED)
    drawing.wire((RIGHT, GROUND), (900, GROUND))


def draw(name, pins):
    drawing = Drawing(1000, 520)
    drawing.box(LEFT, 50, RIGHT - LEFT, 430)
    drawing.text((LEFT + RIGHT) // 2, 160, name, anchor="middle", weight="bold")
    drawing.text((LEFT + RIGHT) // 2, 182, "pin · place on the board", anchor="middle")
    for pin, height in (("supply", SUPPLY), ("emitters", EMITTERS), ("ground", GROUND)):
        drawing.text(LEFT + 8, height + 5, pins[pin])
    for pin, height, color in (("supply", SUPPLY, BLACK), ("x", X, BLUE), ("y", Y, RED),
                               ("analogue_ground", GROUND, BLACK)):
        drawing.text(RIGHT - 8, height + 5, pins[pin], anchor="end", color=color)
    draw_emitters(drawing)
    draw_receivers(drawing)
    drawing.text(130, 40, "the sensors' LEDs", anchor="middle", weight="bold")
    drawing.text(830, 40, "the sensors' phototransistors", anchor="middle", weight="bold")
    drawing.text(500, 508, "Sx and Sy are one housing each: LED and phototransistor of a name belong "
                 "together.", anchor="middle")
    return drawing


def main():
    folder = pathlib.Path(sys.argv[1])
    for board, (name, pins) in BOARDS.items():
        draw(name, pins).save(folder / f"wiring_{board}.svg")


if __name__ == "__main__":
    main()
