#!/usr/bin/env python3
"""Runs recordings in the layouts of EuRoC, ScanNet and KITTI by the quickstart's commands.

usage: layouts_test.py PREFIX WORK_DIR
  PREFIX    where MMS-SLAM is installed
  WORK_DIR  folder for the recordings and results
The recordings are simulated ones, written again as the data sets publish theirs. Their poses are
those of the body (EuRoC), of the camera (ScanNet), and of another camera than the LiDAR (KITTI).
"""

import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

PREFIX, WORK = (Path(argument).resolve() for argument in sys.argv[1:3])
FRAMES = 20
MAX_ATE = 0.02  # [m]; of a way of half a meter

# Calibration of KITTI odometry's first sequence: the projection of camera 2, and camera 0 from LiDAR.
KITTI_P2 = "718.856 0 607.1928 45.38225 0 718.856 185.2157 -0.1130887 0 0 1 0.003779761"
KITTI_TR = [[4.276802385584e-04, -9.999672484946e-01, -8.084491683471e-03, -1.198459927713e-02],
            [-7.210626507497e-03, 8.081198471645e-03, -9.999413164504e-01, -5.403984729748e-02],
            [9.999738645903e-01, 4.859485810390e-04, -7.206933692422e-03, -2.921968648686e-01],
            [0, 0, 0, 1]]
BODY_FROM_CAMERA = [[0, 0, 1, 0.1], [-1, 0, 0, 0.02], [0, -1, 0, 0.3], [0, 0, 0, 1]]


def mms(*arguments):
    """Runs the installed program by its name, as a user would; returns its output."""
    environment = dict(os.environ, PATH=f"{PREFIX / 'bin'}:{os.environ['PATH']}")
    result = subprocess.run(["mms", *map(str, arguments)], cwd=WORK, env=environment, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert result.returncode == 0, result.stdout
    return result.stdout


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def inverse(pose):
    turned = [[pose[j][i] for j in range(3)] for i in range(3)]
    shift = [-sum(turned[i][k] * pose[k][3] for k in range(3)) for i in range(3)]
    return [turned[i] + [shift[i]] for i in range(3)] + [[0, 0, 0, 1]]


def rows(path):
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return [[float(word) for word in line.split()] for line in lines]


def pose_of(t, q):
    x, y, z, w = q
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), t[0]],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), t[1]],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), t[2]],
            [0, 0, 0, 1]]


def quaternion_of(pose):
    """w x y z; for rotations by less than half a turn."""
    w = 0.5 * math.sqrt(max(0.0, 1 + pose[0][0] + pose[1][1] + pose[2][2]))
    return [w, (pose[2][1] - pose[1][2]) / (4 * w), (pose[0][2] - pose[2][0]) / (4 * w),
            (pose[1][0] - pose[0][1]) / (4 * w)]


def truth_of(recording):
    return [(row[0], pose_of(row[1:4], row[4:8])) for row in rows(recording / "groundtruth.txt")]


def simulated(name, *options):
    mms("simulate", "warehouse_loop", "--frames", FRAMES, "-o", name, *options)
    return WORK / name


def images_of(recording, kind):
    listed = (recording / f"{kind}.txt").read_text().splitlines()
    return [recording / line.split()[1] for line in listed if not line.startswith("#")]


def camera_of(recording):
    lines = (recording / "calibration.yaml").read_text().splitlines()
    return {line.split(":")[0]: line.split(":")[1].split("#")[0].strip() for line in lines}


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def copy(source, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(source, target)


def euroc(recording):
    folder = WORK / "euroc"
    camera = camera_of(recording)
    start = 1_403_636_579_000_000_000
    truth = "#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z\n"
    names = {"cam0": "rgb", "depth0": "depth"}
    lists = {name: "#timestamp [ns],filename\n" for name in names}
    for i, (stamp, pose) in enumerate(truth_of(recording)):
        time = start + round(stamp * 1e9)
        for name, kind in names.items():
            image = images_of(recording, kind)[i]
            copy(image, folder / f"mav0/{name}/data/{time}{image.suffix}")
            lists[name] += f"{time},{time}{image.suffix}\n"
        body = product(product(BODY_FROM_CAMERA, pose), inverse(BODY_FROM_CAMERA))
        numbers = [body[k][3] for k in range(3)] + quaternion_of(body)
        truth += f"{time}," + ",".join(f"{number:.9f}" for number in numbers) + "\n"
    for name, text in lists.items():
        write(folder / f"mav0/{name}/data.csv", text)
    values = ", ".join(f"{value}" for row in BODY_FROM_CAMERA for value in row)
    distortion = camera.get("distortion", "[0, 0, 0, 0]")
    write(folder / "mav0/cam0/sensor.yaml",
          f"sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [{values}]\n"
          f"resolution: [{camera['width']}, {camera['height']}]\ncamera_model: pinhole\n"
          f"intrinsics: [{camera['fx']}, {camera['fy']}, {camera['cx']}, {camera['cy']}]\n"
          f"distortion_model: radial-tangential\ndistortion_coefficients: {distortion}\n")
    write(folder / "mav0/state_groundtruth_estimate0/data.csv", truth)
    return folder


def scannet(recording):
    folder = WORK / "scannet"
    camera = camera_of(recording)
    matrix = (f"{camera['fx']} 0 {camera['cx']} 0\n0 {camera['fy']} {camera['cy']} 0\n"
              "0 0 1 0\n0 0 0 1\n")
    for kind in ("color", "depth"):
        write(folder / f"intrinsic/intrinsic_{kind}.txt", matrix)
    for i, (_, pose) in enumerate(truth_of(recording)):
        for kind, target in (("rgb", "color"), ("depth", "depth")):
            image = images_of(recording, kind)[i]
            copy(image, folder / f"{target}/{i}{image.suffix}")
        write(folder / f"pose/{i}.txt",
              "\n".join(" ".join(f"{value:.9f}" for value in row) for row in pose) + "\n")
    return folder


def kitti(recording):
    sequence = WORK / "kitti/sequences/07"
    numbers = " ".join(f"{value:.12e}" for row in KITTI_TR[:3] for value in row)
    write(sequence / "calib.txt", f"P2: {KITTI_P2}\nTr: {numbers}\n")
    truth = truth_of(recording)
    write(sequence / "times.txt", "".join(f"{stamp:.6e}\n" for stamp, _ in truth))
    shutil.copytree(recording / "velodyne", sequence / "velodyne")
    poses = ""
    for _, pose in truth:
        camera = product(product(KITTI_TR, pose), inverse(KITTI_TR))
        poses += " ".join(f"{value:.9e}" for row in camera[:3] for value in row) + "\n"
    write(WORK / "kitti/poses/07.txt", poses)
    return sequence


def check(folder, layout):
    """Runs the commands, and compares the report's accuracy with the files that the viewer shows."""
    assert f"layout: {layout}" in mms("info", folder)
    output = mms("run", folder)
    assert "implausible" not in output, output
    result = WORK / "results/latest"
    metrics = json.loads((result / "metrics.json").read_text())
    assert metrics["frames"] == FRAMES, metrics
    truth, poses = rows(result / "truth.tum"), rows(result / "trajectory.tum")
    assert len(truth) == len(poses) == FRAMES, (len(truth), len(poses))
    squares = [math.dist(a[1:4], b[1:4]) ** 2 for a, b in zip(truth, poses)]
    error = math.sqrt(sum(squares) / FRAMES)
    ate = metrics["trajectory"]["ate_rmse_m"]
    # Truth is aligned by positions and rotations for the viewer, by positions alone for the ATE.
    assert ate - 1e-6 < error < ate + 0.002, (error, ate)
    assert f">{ate:.4f} m<" in (result / "report.html").read_text(), ate
    assert ate < MAX_ATE, ate
    print(f"{layout}: {FRAMES} frames, ATE {100 * ate:.2f} cm")


def main():
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    camera = simulated("camera", "--sensor", "d435")
    check(euroc(camera), "EuRoC")
    check(scannet(camera), "ScanNet")
    check(kitti(simulated("lidar", "--sensor", "lidar16")), "KITTI")


main()
