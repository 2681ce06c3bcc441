#!/usr/bin/env python3
"""Relocalization on a real recording: its even frames, darkness, then odd frames from the middle on.

usage: benchmarks/carried_recording.py make SOURCE RECORDING
       benchmarks/carried_recording.py errors RECORDING RESULT
SOURCE is in the TUM layout. "make" adds depth noise to the frames after the dark. "errors" prints
the frames after the dark until the first pose, its distance and the median distance of the first ten
from the poses of the neighboring even frames [cm]: the sensor's own motion is a part of it.
"""
import csv
import os
import shutil
import sys

import numpy as np
from PIL import Image

DARK = 8  # frames
AFTER = 40  # frames
NOISE = 0.0012  # of the depth squared [1/m]
RATE = 15.0  # [Hz]


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [line.split() for line in file if line.strip() and not line.startswith("#")]


def depth_scale(folder):
    with open(folder + "/calibration.yaml", encoding="utf-8") as file:
        lines = [line for line in file if line.startswith("depth_scale")]
    return float(lines[0].split(":")[1].split("#")[0])


def make(source, folder):
    colors, depths = rows(source + "/rgb.txt"), rows(source + "/depth.txt")
    stamps = np.array([float(row[0]) for row in depths])
    scale = depth_scale(source)
    middle = len(colors) // 4 | 1
    order = [(i, "first") for i in range(0, len(colors), 2)] + [(0, "dark")] * DARK
    order += [(i, "again") for i in range(middle, len(colors) - 1, 2)][:AFTER]
    noise = np.random.default_rng(1)
    os.makedirs(folder + "/rgb")
    os.makedirs(folder + "/depth")
    shutil.copy(source + "/calibration.yaml", folder)
    lists = {name: open(f"{folder}/{name}.txt", "w", encoding="utf-8") for name in
             ("rgb", "depth", "source")}
    for k, (i, part) in enumerate(order):
        stamp = f"{1000 + k / RATE:.6f}"
        color = np.array(Image.open(f"{source}/{colors[i][1]}"))
        nearest = int(np.argmin(abs(stamps - float(colors[i][0]))))
        depth = np.array(Image.open(f"{source}/{depths[nearest][1]}")).astype(float)
        if part == "dark":
            color[:], depth[:] = 0, 0
        elif part == "again":
            sigma = NOISE * (depth / scale) ** 2 * scale
            depth = np.where(depth > 0, depth + sigma * noise.normal(size=depth.shape), 0)
        Image.fromarray(color).save(f"{folder}/rgb/{stamp}.png")
        Image.fromarray(np.clip(depth, 0, 65535).astype(np.uint16)).save(
            f"{folder}/depth/{stamp}.png")
        for name in ("rgb", "depth"):
            lists[name].write(f"{stamp} {name}/{stamp}.png\n")
        lists["source"].write(f"{i} {part}\n")
    for file in lists.values():
        file.close()


def errors(folder, result):
    sources = rows(folder + "/source.txt")
    places = [np.array([float(x) for x in row[1:4]]) for row in rows(result + "/trajectory.tum")]
    with open(result + "/frames.csv", encoding="utf-8") as file:
        frames = list(csv.DictReader(file))
    first = {int(i): place for (i, part), place in zip(sources, places) if part == "first"}
    distances, waited = [], 0
    for (i, part), place, frame in zip(sources, places, frames):
        if part != "again":
            continue
        if frame["status"] == "lost":
            waited += not distances
            continue
        around = [first[j] for j in (int(i) - 1, int(i) + 1) if j in first]
        distances.append(100 * np.linalg.norm(place - np.mean(around, axis=0)))
    print(waited, f"{distances[0]:.1f} {np.median(distances[:10]):.1f}" if distances else "lost")


{"make": make, "errors": errors}[sys.argv[1]](*sys.argv[2:])
