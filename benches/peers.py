"""Times and scores of the programs that are installed; called by peers.sh.

Every program gives, for each angle, Ax Ay Bx By and their velocities and accelerations in mm and s.
"""

import math
import struct
import sys
import time

POSITIONS = int(sys.argv[1])
WORK = sys.argv[2]
GROUND, CRANK, COUPLER, ROCKER = 180.0, 60.0, 140.0, 120.0
OMEGA, ALPHA = 10.0, 5.0
ANGLES = [2.0 * math.pi * i / POSITIONS for i in range(POSITIONS)]
BATCHES = 5
SCORED = 360


def closed_form(angle, cos, sin, sqrt, number=float):
    """The loop equations; in floats, or in mpmath for the truth."""
    r1, r2, r3, r4, w, e = map(number, (GROUND, CRANK, COUPLER, ROCKER, OMEGA, ALPHA))
    ax, ay = r2 * cos(angle), r2 * sin(angle)
    dx, dy = r1 - ax, -ay
    square = dx * dx + dy * dy
    along = (square + r3 * r3 - r4 * r4) / (2 * square)
    across = sqrt(r3 * r3 / square - along * along)
    px, py = dx * along - dy * across, dy * along + dx * across
    bx, by = ax + px, ay + py
    qx, qy = bx - r1, by
    det = px * qy - py * qx
    w3, w4 = w * (qx * ay - qy * ax) / det, w * (px * ay - py * ax) / det
    sx = w * w * ax + e * ay + w3 * w3 * px - w4 * w4 * qx
    sy = w * w * ay - e * ax + w3 * w3 * py - w4 * w4 * qy
    e4 = (px * sx + py * sy) / det
    return (ax, ay, bx, by, -w * ay, w * ax, -w4 * qy, w4 * qx,
            -e * ay - w * w * ax, e * ax - w * w * ay, -e4 * qy - w4 * w4 * qx, e4 * qx - w4 * w4 * qy)


def best(run):
    """Seconds of the quickest batch, and what it gave."""
    quickest, rows = math.inf, None
    for _ in range(BATCHES):
        start = time.perf_counter()
        rows = run()
        quickest = min(quickest, time.perf_counter() - start)
    return quickest, rows


def linkgram():
    seconds = float(open(WORK + "/time").read().split("seconds=")[1])
    data = open(WORK + "/rows", "rb").read()
    return seconds, list(struct.iter_unpack("<12d", data))


def plain_python():
    return best(lambda: [closed_form(a, math.cos, math.sin, math.sqrt) for a in ANGLES])


def pylinkage():
    import pylinkage as pl

    def made():
        o2, o4 = pl.Ground(0, 0), pl.Ground(GROUND, 0)
        # Its first step already turns the crank.
        step = 2.0 * math.pi / POSITIONS
        crank = pl.Crank(o2, CRANK, angular_velocity=step, initial_angle=-step)
        b = pl.RRRDyad(crank.output, o4, COUPLER, ROCKER, x=100.0, y=120.0)
        linkage = pl.Linkage([o2, o4, crank, b])
        linkage.set_input_velocity(crank, OMEGA, ALPHA)
        return linkage

    def run():
        linkage = made()
        try:
            where, v, a = linkage.step_fast_with_kinematics(iterations=POSITIONS)
        except ImportError:
            where, v, a = zip(*linkage.step_with_derivatives(iterations=POSITIONS))
        return [(*p[2], *p[3], *v[2], *v[3], *a[2], *a[3]) for p, v, a in zip(where, v, a)]

    run()
    return best(run)


def truth():
    try:
        import mpmath
    except ImportError:
        return {}
    mpmath.mp.dps = 50
    chosen = range(0, POSITIONS, max(1, POSITIONS // SCORED))
    exact = mpmath.mpf
    return {i: closed_form(exact(ANGLES[i]), mpmath.cos, mpmath.sin, mpmath.sqrt, exact) for i in chosen}


def main():
    true = truth()
    print("| program | us per position | place, mm | velocity, mm/s | acceleration, mm/s2 |")
    print("|---|---|---|---|---|")
    for program in (linkgram, plain_python, pylinkage):
        try:
            seconds, rows = program()
        except ImportError as missing:
            print(f"| {program.__name__} | not installed: {missing.name} | | | |")
            continue
        cells = []
        for part in range(3):
            errors = [abs(rows[i][k] - t[k]) for i, t in true.items() for k in range(4 * part, 4 * part + 4)]
            cells.append(f"{float(max(errors)):.1e}" if errors else "not scored")
        print(f"| {program.__name__} | {seconds / POSITIONS * 1e6:.3f} | {' | '.join(cells)} |")


main()
