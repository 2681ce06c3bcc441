#!/usr/bin/env python3
"""Errors of the accepted loops of a run, by ground truth.

usage: benchmarks/loop_errors.py GROUNDTRUTH.txt LOOPS.csv
Prints: accepted loops, wrong ones (more than 0.3 m or 3 degrees off), median and largest error
[cm], median and largest error [deg].
"""
import sys

from poses import accepted_loops, is_wrong, read_poses

loops = accepted_loops(sys.argv[2], read_poses(sys.argv[1]))
shifts = [100 * loop[2] for loop in loops]
turns = [loop[3] for loop in loops]
wrong = sum(is_wrong(*loop[2:]) for loop in loops)
middle = [f"{sorted(x)[len(x) // 2]:.2f} {max(x):.2f}" if x else "- -" for x in (shifts, turns)]
print(len(shifts), wrong, *middle)
