#!/usr/bin/env python3
"""Draws the planned paths of a show and, over them, where robots were in a rehearsal, as one SVG file.

    lightbots plan SHOW --out plan.json
    lightbots rehearse SHOW --steps steps.csv
    python3 draw_paths.py plan.json steps.csv paths.svg

The steps may be left out. Python 3.9 or newer, no other packages.
"""

import csv
import json
import sys

SAMPLES = 12  # of each piece of a path
PIXELS_A_METRE = 250
MARGIN_M = 0.2


def bezier(start, piece, share):
    """The place on a piece of a path: [duration_s, x1, y1, x2, y2, x, y], a cubic Bezier curve whose parameter is
    proportional to time."""
    _, x1, y1, x2, y2, x, y = piece
    rest = 1 - share
    weights = (rest**3, 3 * rest**2 * share, 3 * rest * share**2, share**3)
    points = (start, (x1, y1), (x2, y2), (x, y))
    return tuple(sum(w * p[axis] for w, p in zip(weights, points)) for axis in (0, 1))


def planned_lines(plan):
    """A list of places for each robot and transition, metres."""
    for transition in plan["transitions"]:
        for path in transition["paths"]:
            at = tuple(path["start"])
            line = [at]
            for piece in path["pieces"]:
                line += [bezier(at, piece, (k + 1) / SAMPLES) for k in range(SAMPLES)]
                at = tuple(piece[5:7])
            yield line


def driven_lines(file):
    """A list of places for each robot, metres."""
    robots = {}
    with open(file, newline="", encoding="utf-8") as steps:
        for row in csv.DictReader(steps):
            robots.setdefault(row["robot"], []).append((float(row["x_m"]), float(row["y_m"])))
    return robots.values()


def svg(planned, driven):
    """The file. y points up on the stage and down in SVG."""
    places = [place for line in planned + driven for place in line] or [(0.0, 0.0)]
    left, right = min(x for x, _ in places) - MARGIN_M, max(x for x, _ in places) + MARGIN_M
    bottom, top = min(y for _, y in places) - MARGIN_M, max(y for _, y in places) + MARGIN_M
    width, height = (right - left) * PIXELS_A_METRE, (top - bottom) * PIXELS_A_METRE

    def path(line, look):
        points = " ".join(f"{(x - left) * PIXELS_A_METRE:.1f},{(top - y) * PIXELS_A_METRE:.1f}" for x, y in line)
        return f'<polyline points="{points}" fill="none" {look}/>'

    return "\n".join(
        [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}">']
        + ['<rect width="100%" height="100%" fill="white"/>']
        + [path(line, 'stroke="silver" stroke-width="4"') for line in planned]
        + [path(line, 'stroke="crimson" stroke-width="1"') for line in driven]
        + ["</svg>"]
    )


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    plan_file, out = sys.argv[1], sys.argv[-1]
    with open(plan_file, encoding="utf-8") as file:
        planned = list(planned_lines(json.load(file)))
    driven = list(driven_lines(sys.argv[2])) if len(sys.argv) == 4 else []
    with open(out, "w", encoding="utf-8") as file:
        file.write(svg(planned, driven))
    print(f"{len(planned)} planned and {len(driven)} driven lines in {out}")


if __name__ == "__main__":
    main()
