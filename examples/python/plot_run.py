#!/usr/bin/python3
"""Localizes a recording and plots the trajectory, the static map and the objects from above.

usage: plot_run.py [RECORDING [PICTURE]]

Without PICTURE it opens a window. The parts between "# %%" are cells for editors with notebooks.
"""
# %% Settings
import sys
from collections import defaultdict

import matplotlib

PICTURE = sys.argv[2] if len(sys.argv) > 2 else None
if PICTURE:
    matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import mms_slam

RECORDING = sys.argv[1] if len(sys.argv) > 1 else "sim:stop_and_go?frames=150"

# %% Localize every frame, and keep where the objects were
recording = mms_slam.Recording(RECORDING)
masks = "masks" if recording.has_masks else "network"
slam = mms_slam.Slam(calibration=recording.calibration, segmenter=masks)
paths = defaultdict(list)
for frame in recording:
    result = slam.process_frame(frame)
    for item in result.objects:
        paths[item.box.id, item.box.object_class].append(item.box.center)
slam.finish()

# %% Numbers
trajectory, cloud = slam.trajectory(corrected=True), slam.static_map()
print(f"{len(trajectory)} poses, {len(cloud)} points of the static map, {len(paths)} objects")
if len(recording.ground_truth) > 0:
    error = mms_slam.evaluate_trajectory(recording.ground_truth, trajectory)
    print(f"ATE rmse {100 * error['ate_rmse_m']:.2f} cm over {error['path_m']:.1f} m")

# %% Plot from above: a camera has x to its right, y down and z ahead; of a LiDAR z is up
is_camera = frame.depth.size > 0
right, ahead = (0, 2) if is_camera else (0, 1)
figure, axes = plt.subplots(figsize=(9, 7))
points, colors = cloud.points, cloud.colors / 255
if is_camera:
    walls = np.abs(points[:, 1]) < 1.0  # neither floor nor ceiling
    points, colors = points[walls], colors[walls]
axes.scatter(points[:, right], points[:, ahead], c=colors, s=0.3, linewidths=0, rasterized=True)
for (number, kind), path in sorted(paths.items()):
    path = np.array(path)
    axes.plot(path[:, right], path[:, ahead], linewidth=2, label=f"{kind} {number}")
    axes.plot(*path[-1, [right, ahead]], "ko", markersize=4)
positions = trajectory.poses[:, :3, 3]
axes.plot(positions[:, right], positions[:, ahead], "k-", linewidth=2, label="sensor")
axes.plot(*positions[0, [right, ahead]], "k^", markersize=8, label="begin")
axes.set(xlabel="x [m]", ylabel="z [m]" if is_camera else "y [m]", aspect="equal",
         title=f"{RECORDING}: static map, sensor and objects from above")
axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=8)
figure.tight_layout()
if PICTURE:
    figure.savefig(PICTURE, dpi=120)
else:
    plt.show()
