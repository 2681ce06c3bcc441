"""Poses of ground truth and results, for the scripts beside this one.

A pose is (position [m], quaternion x, y, z, w).
"""
import bisect
import csv
import math


def read_poses(path):
    """Stamps [s] and poses of a TUM file."""
    stamps, poses = [], []
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                v = [float(x) for x in line.split()]
                stamps.append(v[0])
                poses.append((v[1:4], tuple(v[4:8])))
    return stamps, poses


def pose_at(truth, stamp):
    """The pose of a stamp, which must be there."""
    stamps, poses = truth
    i = bisect.bisect_left(stamps, stamp)
    near = min((j for j in (i - 1, i) if 0 <= j < len(stamps)), key=lambda j: abs(stamps[j] - stamp))
    assert abs(stamps[near] - stamp) < 0.005, f"no ground truth at {stamp}"
    return poses[near]


def rotate(q, v):
    x, y, z, w = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]]


def inverse_times(a, b):
    """Pose b in the frame of pose a."""
    x, y, z, w = a[1]
    p = rotate((-x, -y, -z, w), [b[0][i] - a[0][i] for i in range(3)])
    bx, by, bz, bw = b[1]
    q = (w * bx - x * bw - y * bz + z * by, w * by - y * bw - z * bx + x * bz,
         w * bz - z * bw - x * by + y * bx, w * bw + x * bx + y * by + z * bz)
    return p, q


def difference(a, b):
    """Distance [m] and angle [degrees] of two poses."""
    p, q = inverse_times(a, b)
    return math.hypot(*p), math.degrees(2 * math.atan2(math.hypot(*q[:3]), abs(q[3])))


def accepted_loops(path, truth):
    """(stamp, earlier stamp, error of position [m], of rotation [degrees]) of each in loops.csv."""
    loops = []
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["outcome"] != "accepted":
                continue
            stamp, earlier = float(row["stamp"]), float(row["earlier_stamp"])
            right = inverse_times(pose_at(truth, earlier), pose_at(truth, stamp))
            found = ([float(row[k]) for k in ("tx", "ty", "tz")],
                     tuple(float(row[k]) for k in ("qx", "qy", "qz", "qw")))
            loops.append((stamp, earlier, *difference(right, found)))
    return loops


def is_wrong(shift, turn):
    """Whether a loop is, by its errors [m], [degrees]."""
    return shift > 0.3 or turn > 3
