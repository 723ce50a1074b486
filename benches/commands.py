"""Writes the scenes and takes the times; called by commands.sh."""

import json
import math
import os
import random
import resource
import sys
import time

PROGRAM, WORK, RUNS, SCENES = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
OMEGA = "10 rad/s ccw"


def run(*arguments):
    """Milliseconds on the clock and of the processors, from before the process starts until it has ended."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    silent = [(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)]
    child = os.posix_spawn(PROGRAM, [PROGRAM, *arguments], os.environ, file_actions=silent)
    _, status = os.waitpid(child, 0)
    clock = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if status != 0:
        sys.exit(f"{arguments} ended with status {status}")
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return 1e3 * clock, 1e3 * spent


def row(name, runs, *arguments, scenes=None):
    """A row of the table. Scenes per second as measured, and as two processors with nothing else to do would give."""
    clock, spent = (sorted(values) for values in zip(*(run(*arguments) for _ in range(runs))))
    cells = [name]
    for values in (clock, spent):
        low, median, high = (values[round(part * (runs - 1))] for part in (0.1, 0.5, 0.9))
        cells += [f"{median:.1f}", f"{low:.1f} - {high:.1f}"]
    rates = (scenes / (1e-3 * clock[runs // 2]), scenes / (1e-3 * spent[runs // 2] / 2)) if scenes else ()
    cells += [f"{rate:,.0f}" for rate in rates] or ["", ""]
    print("|", " | ".join(cells), "|", flush=True)


def written(folder, scenes):
    path = os.path.join(WORK, folder)
    os.makedirs(path)
    for number, scene in enumerate(scenes):
        with open(os.path.join(path, f"{number:05}.json"), "w") as file:
            json.dump(scene, file, indent=1)
    return path


def four_bar(dice):
    """A crank with a coupler and a rocker that close at this angle, B to the left of the line from A to O4."""
    while True:
        crank, coupler, rocker, ground = (round(dice.uniform(20, 120), 1) for _ in range(4))
        angle = round(dice.uniform(0, 360), 1)
        x, y = crank * math.cos(math.radians(angle)), crank * math.sin(math.radians(angle))
        span = math.hypot(ground - x, y)
        along = (span * span + coupler * coupler - rocker * rocker) / (2 * span)
        if abs(along) < 0.9 * coupler and span > 10:
            break
    across = math.sqrt(coupler * coupler - along * along)
    ux, uy = (ground - x) / span, -y / span
    near = [round(x + along * ux - across * uy, 1), round(y + along * uy + across * ux, 1)]
    return {
        "units": {"length": "mm"},
        "fixed": {"O2": [0, 0], "O4": [ground, 0]},
        "links": {
            "2": {"joins": ["O2", "A"], "length": crank},
            "3": {"joins": ["A", "B"], "length": coupler},
            "4": {"joins": ["O4", "B"], "length": rocker},
        },
        "near": {"B": near},
        "input": {"link": 2, "angle": angle, "omega": OMEGA},
        "find": ["omega(3)", "omega(4)"],
    }


def chain(dyads):
    """A crank and dyads one after the other, all parallelograms: every velocity is the same, and so is its place."""
    fixed, near = {"G0": [0, 0]}, {}
    links = {"2": {"joins": ["G0", "P0"], "length": 60}}
    for i in range(1, dyads + 1):
        fixed[f"G{i}"], near[f"P{i}"] = [120 * i, 0], [120 * i, 60]
        links[str(2 * i + 1)] = {"joins": [f"P{i - 1}", f"P{i}"], "length": 120}
        links[str(2 * i + 2)] = {"joins": [f"G{i}", f"P{i}"], "length": 60}
    return {
        "units": {"length": "mm"},
        "fixed": fixed,
        "links": links,
        "near": near,
        "input": {"link": 2, "angle": 90, "omega": 1},
        "find": [f"v(P{dyads})", f"a(P{dyads})"],
    }


def many_points(count):
    """A four-bar whose coupler has so many points, and the velocity of each."""
    dice = random.Random(3)
    points = {"A": [0, 0], "B": [120, 0]}
    for i in range(count - 2):
        way, reach = 2 * math.pi * i / (count - 2), dice.uniform(0.5, 1)
        points[f"Q{i}"] = [round(60 + 80 * math.cos(way) * reach, 1), round(30 + 50 * math.sin(way) * reach, 1)]
    return {
        "units": {"length": "mm"},
        "fixed": {"O2": [0, 0], "O4": [110, 0]},
        "links": {
            "2": {"joins": ["O2", "A"], "length": 40},
            "3": {"joins": list(points), "shape": points},
            "4": {"joins": ["O4", "B"], "length": 80},
        },
        "near": {"B": [125, 80]},
        "input": {"link": 2, "angle": 60, "omega": OMEGA},
        "find": [f"v({name})" for name in points],
    }


def main():
    dice = random.Random(1)
    sheet = os.path.join(WORK, "sheet.svg")
    print("| command | ms | 10 to 90 of 100 | processor ms | 10 to 90 of 100 | scenes/s | two free processors |")
    print("|---|---|---|---|---|---|---|")
    row("`--version`", RUNS, "--version")
    row("`draw` of 3-1 to SVG", RUNS, "draw", "examples/s000-ch3a-1.json", "-o", sheet)
    bars = written("bars", (four_bar(dice) for _ in range(SCENES)))
    row(f"`check` of {SCENES:,} four-bars", max(RUNS // 10, 5), "check", bars, scenes=SCENES)
    crowd = written("crowd", [many_points(50), chain(99)])
    row("`draw` of a link of 50 points", 5, "draw", os.path.join(crowd, "00000.json"), "-o", sheet)
    row("`draw` of a chain of 200 links", 5, "draw", os.path.join(crowd, "00001.json"), "-o", sheet)


main()
