#!/usr/bin/env python3
"""How many of the loops that exist a run has found, by ground truth.

usage: benchmarks/loop_recall.py GROUNDTRUTH.txt LOOPS.csv
A place (every 0.25 m or 15 degrees) is known if the sensor was within 2 m of it and looked in its
direction to 45 degrees, 20 m of path or more before. A revisit is a stretch of such places.
Prints: path [m], revisits, those with a right loop within 5 s of their start, known places, those
with a right loop within the 5 s after them or before, in the same revisit.
"""
import math
import sys

from poses import accepted_loops, difference, is_wrong, read_poses

MAX_DISTANCE, MAX_ANGLE = 2.0, 45.0  # [m], [degrees]
MIN_PATH = 20.0  # [m]
MAX_DELAY = 5.0  # [s]

stamps, poses = truth = read_poses(sys.argv[1])
right = [loop[0] for loop in accepted_loops(sys.argv[2], truth) if not is_wrong(*loop[2:])]

places = []  # (stamp, pose, path so far)
path = 0.0
for i, pose in enumerate(poses):
    path += math.dist(pose[0], poses[i - 1][0]) if i else 0.0
    if places:
        shift, turn = difference(places[-1][1], pose)
        if shift < 0.25 and turn < 15.0:
            continue
    places.append((stamps[i], pose, path))


def is_known(place):
    for _, pose, before in places:
        if before > place[2] - MIN_PATH:
            return False
        if math.dist(pose[0], place[1][0]) < MAX_DISTANCE and \
                difference(pose, place[1])[1] < MAX_ANGLE:
            return True
    return False


revisits = []  # stamps of their places
was_known = False
for place in places:
    known = is_known(place)
    if known and not was_known:
        revisits.append([])
    if known:
        revisits[-1].append(place[0])
    was_known = known

found = sum(any(0.0 <= t - revisit[0] <= MAX_DELAY for t in right) for revisit in revisits)
near = sum(any(revisit[0] <= t <= revisit[-1] + MAX_DELAY and abs(t - stamp) <= MAX_DELAY
               for t in right) for revisit in revisits for stamp in revisit)
print(f"{path:.0f}", len(revisits), found, sum(map(len, revisits)), near)
