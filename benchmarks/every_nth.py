#!/usr/bin/env python3
"""A recording in the TUM layout with every N-th color image alone, and the nearest depth images.

usage: benchmarks/every_nth.py SOURCE RECORDING N [FIRST]
The images are linked, not copied. Prints its images per second.
"""
import os
import shutil
import sys


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [line.split() for line in file if line.strip() and not line.startswith("#")]


source, folder, step = os.path.abspath(sys.argv[1]), sys.argv[2], int(sys.argv[3])
first = int(sys.argv[4]) if len(sys.argv) > 4 else 0
os.makedirs(folder)
for name in ("rgb", "depth"):
    os.symlink(f"{source}/{name}", f"{folder}/{name}")
for name in ("calibration.yaml", "groundtruth.txt"):
    shutil.copy(f"{source}/{name}", folder)
depths = rows(source + "/depth.txt")
colors = rows(source + "/rgb.txt")[first::step]
with open(folder + "/rgb.txt", "w", encoding="utf-8") as color_list, \
        open(folder + "/depth.txt", "w", encoding="utf-8") as depth_list:
    for color in colors:
        nearest = min(depths, key=lambda depth: abs(float(depth[0]) - float(color[0])))
        color_list.write(" ".join(color) + "\n")
        depth_list.write(" ".join(nearest) + "\n")
print(f"{(len(colors) - 1) / (float(colors[-1][0]) - float(colors[0][0])):.1f}")
