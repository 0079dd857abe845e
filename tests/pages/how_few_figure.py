#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws docs/screenshots/how-few.svg from the tables of docs/without-a-tracker.md.

    tests/pages/how_few_figure.py [--print]      --print: to standard output instead of the file
"""
import math
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "without-a-tracker.md"
FIGURE = ROOT / "docs" / "screenshots" / "how-few.svg"

# Row of a table, 1 sigma in µm, words beside the line, colour in light and dark, dashes.
LINES = [
    ("sockets, no length known", 10, "sockets, no length", "#0072b2", "#56b4e9", "7 4"),
    ("sockets 80 mm apart, and that is known", 10, "sockets, a known distance", "#0072b2", "#56b4e9", ""),
    ("planes", 10, "planes", "#7a5195", "#c9a3e0", "2 4"),
    ("ball bar, its length is known", 10, "ball bar, known length", "#009e73", "#3ddcae", ""),
    ("distances to anchors", 50, "wire, 50 µm", "#d55e00", "#ff9a52", "7 4"),
    ("distances to anchors", 10, "wire, 10 µm", "#d55e00", "#ff9a52", ""),
    ("tracker", 10, "tracker", "#555555", "#bbbbbb", ""),
]
LEFT, TOP, WIDTH, HEIGHT = 62, 56, 430, 300
READINGS, ERRORS = (18, 440), (0.0025, 0.5)


def tables(page):
    """(name, sigma): {readings: error in mm} of every row that starts with a name and a sigma."""
    out, head = {}, []
    for line in page.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if line.startswith("| measured by | 1 sigma"):
            head = [int(re.sub(r"\D", "", cell)) for cell in cells[2:]]
        elif line.startswith("|") and len(cells) == len(head) + 2 and cells[1].endswith("µm"):
            values = [float(cell.split(",")[0]) for cell in cells[2:]]
            out[cells[0], int(cells[1].split()[0])] = dict(zip(head, values))
    return out


def share(value, ends):
    low, high = map(math.log, ends)
    return (math.log(value) - low) / (high - low)


def x_of(readings):
    return LEFT + WIDTH * share(readings, READINGS)


def y_of(error):
    return TOP + HEIGHT * (1 - share(error, ERRORS))


def apart(places, least=15):
    """Moves the words beside the lines so far that none stands upon another."""
    order = sorted(range(len(places)), key=lambda k: places[k])
    out = list(places)
    for before, after in zip(order, order[1:]):
        out[after] = max(out[after], out[before] + least)
    return out


def drawn(found):
    svg = [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 700 410" font-family="sans-serif" font-size="12">',
        "<style>text{fill:#222}.grid{stroke:#ddd}.page{fill:#fff}"
        "@media(prefers-color-scheme:dark){text{fill:#ddd}.grid{stroke:#444}.page{fill:#16181c}"
        + "".join(f".c{k}{{stroke:{line[4]}!important}}.d{k}{{fill:{line[4]}!important}}" for k, line in enumerate(LINES))
        + "}</style>",
        "<title>Error at fresh joints against the number of readings</title>",
        '<rect class="page" width="700" height="410"/>',
        f'<text x="{LEFT}" y="22" font-size="15" font-weight="bold">How few readings will do</text>',
        f'<text x="{LEFT}" y="42">mean error at joints that were not measured [mm]; 1 sigma of a reading 10 µm unless said</text>',
    ]
    for error in (0.003, 0.01, 0.03, 0.1, 0.3):
        y = y_of(error)
        svg.append(f'<path class="grid" d="M{LEFT} {y:.1f}H{LEFT + WIDTH}"/>')
        svg.append(f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{error:g}</text>')
    for readings in (20, 50, 100, 200, 400):
        x = x_of(readings)
        svg.append(f'<path class="grid" d="M{x:.1f} {TOP}V{TOP + HEIGHT}"/>')
        svg.append(f'<text x="{x:.1f}" y="{TOP + HEIGHT + 18}" text-anchor="middle">{readings}</text>')
    svg.append(f'<text x="{LEFT + WIDTH / 2}" y="{TOP + HEIGHT + 38}" text-anchor="middle">readings</text>')
    ends = apart([y_of(list(found[name, sigma].values())[-1]) for name, sigma, *_ in LINES])
    for k, (name, sigma, words, colour, _, dashes) in enumerate(LINES):
        points = [(x_of(n), y_of(error)) for n, error in found[name, sigma].items()]
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        svg.append(f'<path class="c{k}" d="{path}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes}"/>')
        svg += [f'<circle class="d{k}" cx="{x:.1f}" cy="{y:.1f}" r="3.2" fill="{colour}"/>' for x, y in points]
        (x, y), at = points[-1], LEFT + WIDTH + 14
        svg.append(f'<path class="c{k}" d="M{x + 5:.1f} {y:.1f}L{at - 3} {ends[k]:.1f}" fill="none" stroke="{colour}" stroke-width="0.7"/>')
        svg.append(f'<text x="{at}" y="{ends[k] + 4:.1f}">{words}</text>')
    return "\n".join(svg) + "\n</svg>\n"


def main():
    svg = drawn(tables(PAGE.read_text(encoding="utf-8")))
    if "--print" in sys.argv:
        sys.stdout.write(svg)
    else:
        FIGURE.write_text(svg, encoding="utf-8")


if __name__ == "__main__":
    main()
