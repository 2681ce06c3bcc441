#!/usr/bin/env bash
# What a frame costs more in Python than in C++: the time of a call without that of the stages, which
# the result brings, in both. Loop closure is off, which no stage counts. `process` copies the images,
# `process_frame` and C++ take frames that exist.
# usage: benchmarks/python.sh [WIDTH [FRAMES]]   images of WIDTH x 3/4 WIDTH (640, 300 frames)
#   BUILD  build folder (build/release)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [ -x "${BUILD:-build/release}/benchmarks/mms_frame_cost" ]; then
  "${BUILD:-build/release}/benchmarks/mms_frame_cost" "sim:stop_and_go?frames=${2:-300}&width=${1:-640}"
fi
export PYTHONPATH="${BUILD:-build/release}/python"
/usr/bin/python3 - "${1:-640}" "${2:-300}" << 'PYTHON'
import sys
import time

import numpy as np

import mms_slam

width, count = sys.argv[1:]
recording = mms_slam.Recording(f"sim:stop_and_go?frames={count}&width={width}")
frames = list(recording)


def measure(name, call):
    slam = mms_slam.Slam(calibration=recording.calibration, settings={"global_map.enabled": False})
    more, whole = [], []
    for frame in frames:
        begin = time.perf_counter()
        result = call(slam, frame)
        whole.append(1e3 * (time.perf_counter() - begin))
        more.append(whole[-1] - sum(result.stage_ms.values()))
    print(f"{name:14} {np.median(more):.3f} ms median, {np.mean(more):.3f} mean, "
          f"{np.percentile(more, 99):.3f} p99 of {np.mean(whole):.2f} ms per frame")


print(f"{len(frames)} frames of {frames[0].depth.shape[1]} x {frames[0].depth.shape[0]}")
measure("process", lambda slam, f: slam.process(f.color, f.depth, f.stamp, f.masks))
measure("process_frame", lambda slam, f: slam.process_frame(f))
PYTHON
