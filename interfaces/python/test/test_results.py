"""Results are those of mms run, bit by bit."""
import json

import numpy as np
import pytest

import mms_slam
from conftest import SCENE

LIDAR_SCENE = "sim:warehouse_loop?frames=6&sensor=lidar16"
PLY_TYPES = {"float": "<f4", "uchar": "u1", "int": "<i4"}


def read_ply(path):
    header, data = path.read_bytes().split(b"end_header\n", 1)
    words = [line.split() for line in header.decode().splitlines()]
    types = [(line[2], PLY_TYPES[line[1]]) for line in words if line[0] == "property"]
    return np.frombuffer(data, np.dtype(types))


def fields(table, *names):
    return np.stack([table[name] for name in names], axis=1)


def check_files(slam, folder, tmp_path):
    slam.trajectory().write(tmp_path / "trajectory.tum")
    assert (tmp_path / "trajectory.tum").read_bytes() == (folder / "trajectory.tum").read_bytes()
    slam.finish()
    written = read_ply(folder / "static_map.ply")
    made = slam.static_map()
    assert len(made) == len(written) > 1000
    assert np.array_equal(made.points, fields(written, "x", "y", "z"))
    assert np.array_equal(made.colors, fields(written, "red", "green", "blue"))
    assert np.array_equal(made.normals, fields(written, "nx", "ny", "nz"))
    assert np.array_equal(made.observations, written["observations"])
    made.write(tmp_path / "map.ply")
    again = read_ply(tmp_path / "map.ply")
    for name in again.dtype.names:
        assert np.array_equal(again[name], written[name]), name
    slam.occupancy_grid().write(tmp_path / "map.yaml")
    for name in ("map.yaml", "map.pgm"):
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes()


def test_frames_give_files_of_run(slam, frames, folder_of, tmp_path):
    results = [slam.process_frame(frame) for frame in frames]
    assert [r.stamp for r in results] == [f.stamp for f in frames]
    assert np.array_equal([r.pose for r in results], slam.trajectory().poses)
    check_files(slam, folder_of(SCENE, "--segmenter", "masks"), tmp_path)


def test_arrays_give_files_of_run(slam, frames, folder_of, tmp_path):
    for frame in frames:
        slam.process(frame.color, frame.depth, frame.stamp, frame.masks)
    check_files(slam, folder_of(SCENE, "--segmenter", "masks"), tmp_path)


def test_raw_depth_is_in_units_of_the_calibration(slam, frames):
    scaled = mms_slam.Slam(calibration=mms_slam.Calibration(frames[0].calibration.camera, 5000.0))
    for frame in frames[:5]:
        raw = np.round(frame.depth * 5000.0).astype(np.uint16)
        expected = slam.process(frame.color, raw / np.float32(5000.0), frame.stamp, frame.masks)
        result = scaled.process(frame.color, raw, frame.stamp, frame.masks)
        assert np.array_equal(result.pose, expected.pose)
        assert np.array_equal(result.points, expected.points, equal_nan=True)


def test_network_gives_files_of_run(frames, folder_of, tmp_path):
    slam = mms_slam.Slam(calibration=frames[0].calibration, segmenter="network")
    for frame in frames[:6]:
        slam.process(frame.color, frame.depth, frame.stamp)
    check_files(slam, folder_of(SCENE, "--segmenter", "network", "--frames", "6"), tmp_path)


def test_scans_give_files_of_run(folder_of, tmp_path):
    recording = mms_slam.Recording(LIDAR_SCENE)
    slam = mms_slam.Slam(calibration=recording.calibration)
    for frame in recording:
        slam.process_scan(frame.points, frame.stamp, frame.times, frame.intensity, frame.color,
                          frame.masks)
    check_files(slam, folder_of(LIDAR_SCENE, "--segmenter", "masks"), tmp_path)


def poses_of(rows):
    """Of lines "stamp x y z qx qy qz qw"."""
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    x, y, z, w = np.array([row[4:8] for row in rows], float).T
    poses[:, :3, 3] = np.array([row[1:4] for row in rows], float)
    poses[:, :3, :3] = np.stack([
        1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], 1).reshape(-1, 3, 3)
    return poses


def test_wheels_and_gyroscope_count_as_those_of_a_recording(mms, tmp_path):
    folder = tmp_path / "sim"
    mms("convert", "sim:stop_and_go?frames=20&width=320&wheels.enabled=true&imu.enabled=true", "-o",
        folder)

    def read(name):
        rows = [line.split(",") for line in (folder / name).read_text().splitlines()[1:]]
        return np.array([int(row[0].replace(".", "")) for row in rows]), rows

    def run(recording, process, slam):
        for frame in recording:
            process(slam, frame)
        return slam.trajectory().poses

    def by_arrays(slam, frame):
        slam.process(frame.color, frame.depth, frame.stamp)

    recording = mms_slam.Recording(folder)
    calibration = recording.calibration
    expected = run(recording, mms_slam.Slam.process_frame, mms_slam.Slam(segmenter="none"))
    slam = mms_slam.Slam(calibration=calibration, segmenter="none")
    stamps, rows = read("odometry.csv")
    slam.add_wheels(mms_slam.Trajectory(stamps, poses_of(rows)))
    stamps, rows = read("imu.csv")
    numbers = np.array([row[1:] for row in rows], float)
    slam.add_gyroscope(stamps, numbers[:, :3], numbers[:, 3:])
    with pytest.raises(ValueError, match="stamps: has 0, allowed: not less than"):
        slam.add_gyroscope(np.array([0]), np.zeros((1, 3)))
    found = run(mms_slam.Recording(folder), by_arrays, slam)
    without = run(mms_slam.Recording(folder), by_arrays,
                  mms_slam.Slam(calibration=calibration, segmenter="none"))
    assert np.allclose(found, expected, atol=1e-6)
    assert not np.allclose(without, expected, atol=1e-6)


def test_masks_matter(slam, frames):
    masked = [slam.process(f.color, f.depth, f.stamp, f.masks).dynamic_share for f in frames[:3]]
    bare = mms_slam.Slam(calibration=frames[0].calibration)
    without = [bare.process(f.color, f.depth, f.stamp).dynamic_share for f in frames[:3]]
    assert min(masked) > max(without)
    result = masked and slam.process_frame(frames[3])
    assert np.mean(result.labels[result.labels > 0] == 2) == pytest.approx(result.dynamic_share)


def test_settings_are_those_of_the_program(frames, folder_of, tmp_path):
    (tmp_path / "settings.yaml").write_text("static_map: {voxel_size: 0.06, memory: 50}\n")
    slam = mms_slam.Slam(tmp_path / "settings.yaml", frames[0].calibration,
                         settings={"static_map.voxel_size": 0.08, "global_map.enabled": False})
    for frame in frames:
        slam.process_frame(frame)
    check_files(slam, folder_of(SCENE, "--segmenter", "masks", "--set", "static_map.voxel_size=0.08",
                                "--set", "static_map.memory=50",
                                "--set", "global_map.enabled=false"), tmp_path)


def test_evaluation_gives_numbers_of_run(mms, folder_of, tmp_path):
    scene = "sim:rack_aisle?frames=60&width=320"
    folder = folder_of(scene, "--segmenter", "masks")
    metrics = json.loads((folder / "metrics.json").read_text())
    recording = mms_slam.Recording(scene)
    slam = mms_slam.Slam(calibration=recording.calibration)
    tracks = []
    for frame in recording:
        result = slam.process_frame(frame)
        tracks.append(mms_slam.ObjectFrame(result.stamp, [o.box for o in result.objects]))
    assert any(frame.objects for frame in tracks)
    mms_slam.write_objects(tmp_path / "objects.json", tracks)
    read = mms_slam.read_objects(tmp_path / "objects.json")
    seen = [frame for frame in tracks if frame.objects]
    assert [frame.stamp for frame in read] == [frame.stamp for frame in seen]
    assert [[box.id for box in frame.objects] for frame in read] == [
        [box.id for box in frame.objects] for frame in seen]
    assert [o.box.id for o in slam.objects()] == [o.box.id for o in result.objects]
    slam.finish()
    poses, truth = slam.trajectory(), recording.ground_truth

    def check(found, expected):
        known = {key: value for key, value in found.items() if not np.isnan(value)}
        assert known and known == {key: expected[key] for key in known}

    check(mms_slam.evaluate_trajectory(truth, poses), metrics["trajectory"])
    check(mms_slam.evaluate_drift(poses), metrics["drift"])
    check(mms_slam.evaluate_objects(recording.objects_truth(), tracks, truth, poses),
          metrics["live_objects"])
    cloud = recording.map_truth()
    T = mms_slam.align_truth(truth, slam.trajectory(corrected=True)).astype(np.float32)
    points = (cloud.points @ T[:3, :3].T + T[:3, 3]).astype(np.float32)
    found = mms_slam.evaluate_map(points[cloud.labels == 0], points[cloud.labels != 0],
                                  slam.static_map().points)
    assert found == pytest.approx({key: metrics["map"][key] for key in found}, abs=0.01)

    truth.write(tmp_path / "truth.tum")
    printed = mms("eval", "trajectory", tmp_path / "truth.tum", folder / "trajectory.tum", "--json")
    read = mms_slam.Trajectory.read(folder / "trajectory.tum")
    assert np.array_equal(read.stamps, poses.stamps)
    assert np.allclose(read.poses, poses.poses, atol=1e-12)
    assert mms_slam.evaluate_trajectory(mms_slam.Trajectory.read(tmp_path / "truth.tum"),
                                        read) == json.loads(printed)
    assert sum(len(frame.objects) for frame in mms_slam.read_objects(folder / "objects.json")) > 0


def test_frames_bring_their_largest_depth(folder_of, tmp_path):
    scene = "sim:warehouse_loop?frames=10&width=320"  # its camera maps up to 9 m
    slam = mms_slam.Slam()
    for frame in mms_slam.Recording(scene):
        slam.process_frame(frame)
    check_files(slam, folder_of(scene, "--segmenter", "masks"), tmp_path)
