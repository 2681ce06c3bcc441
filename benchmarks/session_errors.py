#!/usr/bin/env python3
"""Errors of each session of a run in the frame of the map, by ground truth.

usage: benchmarks/session_errors.py RECORDING RESULT
Prints for each session: its number, the frames with a pose, those with a place in the map, and rmse
and largest distance of these from the truth [cm]. Only the first pose is aligned with the truth.
"""
import csv
import sys

from poses import difference, pose_at, read_poses

truth = read_poses(sys.argv[1] + "/groundtruth.txt")
poses = read_poses(sys.argv[2] + "/trajectory_map.tum")
known = set(poses[0])
frames = {}  # stamps of the frames that are not lost, by session
with open(sys.argv[2] + "/frames.csv", encoding="utf-8") as file:
    for row in csv.DictReader(file):
        if row["status"] != "lost":
            frames.setdefault(int(row["session"]), []).append(float(row["stamp"]))
for session, stamps in sorted(frames.items()):
    placed = [t for t in stamps if t in known]
    errors = [100 * difference(pose_at(truth, t), pose_at(poses, t))[0] for t in placed]
    rmse = (sum(e * e for e in errors) / len(errors)) ** 0.5 if errors else float("nan")
    print(session, len(stamps), len(placed), f"{rmse:.1f}", f"{max(errors, default=rmse):.1f}")
