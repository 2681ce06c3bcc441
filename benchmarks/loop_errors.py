#!/usr/bin/env python3
"""Errors of the accepted loops of a run, by ground truth.

usage: benchmarks/loop_errors.py GROUNDTRUTH.txt LOOPS.csv
Prints: accepted loops, wrong ones (more than 0.3 m or 3 degrees off), median and largest error
[cm], median and largest error [deg].
"""
import bisect
import csv
import math
import sys


def rotate(q, v):
    x, y, z, w = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]]


def inverse_times(a, b):
    """Pose b in the frame of pose a; a pose is (position, quaternion x, y, z, w)."""
    x, y, z, w = a[1]
    p = rotate((-x, -y, -z, w), [b[0][i] - a[0][i] for i in range(3)])
    bx, by, bz, bw = b[1]
    q = (w * bx - x * bw - y * bz + z * by, w * by - y * bw - z * bx + x * bz,
         w * bz - z * bw - x * by + y * bx, w * bw + x * bx + y * by + z * bz)
    return p, q


truth = []
with open(sys.argv[1], encoding="utf-8") as file:
    for line in file:
        if line.strip() and not line.startswith("#"):
            v = [float(x) for x in line.split()]
            truth.append((v[0], (v[1:4], tuple(v[4:8]))))
stamps = [stamp for stamp, _ in truth]


def pose_at(stamp):
    i = bisect.bisect_left(stamps, stamp)
    near = min((j for j in (i - 1, i) if 0 <= j < len(stamps)), key=lambda j: abs(stamps[j] - stamp))
    assert abs(stamps[near] - stamp) < 0.005, f"no ground truth at {stamp}"
    return truth[near][1]


shifts, turns = [], []
with open(sys.argv[2], encoding="utf-8") as file:
    for row in csv.DictReader(file):
        if row["outcome"] != "accepted":
            continue
        right = inverse_times(pose_at(float(row["earlier_stamp"])), pose_at(float(row["stamp"])))
        found = ([float(row[k]) for k in ("tx", "ty", "tz")],
                 tuple(float(row[k]) for k in ("qx", "qy", "qz", "qw")))
        error = inverse_times(right, found)
        shifts.append(100 * math.hypot(*error[0]))
        turns.append(math.degrees(2 * math.atan2(math.hypot(*error[1][:3]), abs(error[1][3]))))
wrong = sum(shift > 30 or turn > 3 for shift, turn in zip(shifts, turns))
middle = [f"{sorted(x)[len(x) // 2]:.2f} {max(x):.2f}" if x else "- -" for x in (shifts, turns)]
print(len(shifts), wrong, *middle)
