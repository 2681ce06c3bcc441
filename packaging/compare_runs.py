#!/usr/bin/env python3
"""Prints the largest differences of two runs: poses, and points of the static map.

usage: compare_runs.py NAME RUN OTHER

Exits with 1 where a position differs by 0.1 mm or more.
"""
import math
import sys
from pathlib import Path

MAX_DIFFERENCE = 1e-4  # m


def poses(run):
    lines = (Path(run) / "trajectory.tum").read_text().splitlines()
    return [[float(value) for value in line.split()] for line in lines if not line.startswith("#")]


def angle(one, other):
    """Between two unit quaternions, in degrees."""
    cosine = abs(sum(a * b for a, b in zip(one, other)))
    return math.degrees(2 * math.acos(min(1.0, cosine)))


def main(name, run, other):
    pairs = list(zip(poses(run), poses(other), strict=True))
    distance = max(math.dist(a[1:4], b[1:4]) for a, b in pairs)
    rotation = max(angle(a[4:8], b[4:8]) for a, b in pairs)
    files = ("trajectory.tum", "static_map.ply", "objects.json", "map.pgm")
    same = [file for file in files
            if (Path(run) / file).read_bytes() == (Path(other) / file).read_bytes()]
    sizes = [(Path(folder) / "static_map.ply").stat().st_size for folder in (run, other)]
    print(f"{name}: {len(pairs)} poses, largest difference {1e3 * distance:.6f} mm and "
          f"{rotation:.6f} degrees; map of {sizes[0]} and {sizes[1]} bytes; "
          f"same bits: {', '.join(same) or 'none'}")
    return 0 if distance < MAX_DIFFERENCE else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
