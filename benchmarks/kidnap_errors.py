#!/usr/bin/env python3
"""How fast and how right a sensor is relocalized that was carried in the dark, by ground truth.

usage: benchmarks/kidnap_errors.py RECORDING RESULT DARK_FROM DARK_FOR LIGHT_FOR
The place in the map counts as known as frames.csv says; the pose is that of trajectory_map.tum.
Prints: cases, those with a right pose within 1 s of the light, those with one later, those with a
wrong pose (more than 20 cm or 5 degrees off), median and largest time to the first pose [s].
"""
import csv
import sys

from poses import difference, pose_at, read_poses

MAX_DISTANCE, MAX_ANGLE = 0.2, 5.0  # [m], [degrees]
MAX_DELAY = 1.0  # [s]

truth = read_poses(sys.argv[1] + "/groundtruth.txt")
poses = read_poses(sys.argv[2] + "/trajectory_map.tum")
dark_from, dark_for, light_for = map(float, sys.argv[3:6])
with open(sys.argv[2] + "/frames.csv", encoding="utf-8") as file:
    known = [float(row["stamp"]) for row in csv.DictReader(file) if row["in_map"] == "1"]

delays, wrong, cases = [], 0, 0
light = dark_from + dark_for
while light + light_for <= truth[0][-1] + 0.5:
    cases += 1
    in_light = [t for t in known if light - 1e-3 <= t < light + light_for - 1e-3]
    errors = [difference(pose_at(truth, t), pose_at(poses, t)) for t in in_light]
    is_right = [shift < MAX_DISTANCE and turn < MAX_ANGLE for shift, turn in errors]
    wrong += not all(is_right)
    if in_light and is_right[0]:
        delays.append(in_light[0] - light)
    light += dark_for + light_for
fast = sum(delay <= MAX_DELAY for delay in delays)
times = f"{sorted(delays)[len(delays) // 2]:.2f} {max(delays):.2f}" if delays else "- -"
print(cases, fast, len(delays) - fast, wrong, times)
