"""Arrays are views of the library's memory; what an argument cannot be is said by name."""
import gc
import weakref

import numpy as np
import pytest

import mms_slam


def address(array):
    return array.__array_interface__["data"][0]


def test_arrays_of_frames_and_results_are_views(slam, frames):
    frame, result = frames[0], slam.process_frame(frames[0])
    slam.finish()
    cloud, poses = slam.static_map(), slam.trajectory()
    for owner, names in ((frame, ("color", "depth", "masks")), (result, ("points", "labels")),
                         (cloud, ("points", "colors", "normals", "observations")),
                         (poses, ("stamps", "poses"))):
        for name in names:
            first, second = getattr(owner, name), getattr(owner, name)
            assert first.size > 0 and address(first) == address(second), name
            assert not first.flags.owndata, name


def test_views_outlive_their_owners(frames):
    slam = mms_slam.Slam(calibration=frames[0].calibration)
    points = slam.process_frame(frames[0]).points
    expected = points.copy()
    del slam
    gc.collect()
    for _ in range(20):
        np.ones_like(expected)
    assert np.array_equal(points, expected, equal_nan=True)


def test_shapes_and_types(slam, frames):
    frame = frames[0]
    height, width = frame.depth.shape
    assert frame.color.shape == (height, width, 3) and frame.color.dtype == np.uint8
    assert frame.depth.dtype == np.float32 and frame.masks.dtype == np.uint8
    assert frame.points.shape == (0, 3)
    result = slam.process_frame(frame)
    assert result.pose.shape == (4, 4) and result.information.shape == (6, 6)
    assert np.array_equal(result.world_in_map, np.eye(4))
    assert result.points.shape == (len(result.labels), 3)
    assert np.isnan(result.points[result.labels == 0]).all()
    assert set(result.stage_ms) == {"segmentation", "fusion", "features", "odometry", "mapping"}
    assert result.status == "initialized"
    empty = mms_slam.Slam().trajectory()
    assert len(empty) == 0 and empty.poses.shape == (0, 4, 4) and empty.stamps.shape == (0,)


def broken(frame, **changes):
    return {"color": frame.color, "depth": frame.depth, "stamp": frame.stamp, **changes}


@pytest.mark.parametrize("change, text", [
    (lambda f: {"color": f.color.astype(np.float32)},
     "color: has the type float32, allowed: uint8"),
    (lambda f: {"color": f.color[:, :, 0]}, "color: has the shape (240, 320), "
     "allowed: (240, 320, 3)"),
    (lambda f: {"color": f.color[:, :, ::-1]}, "color: has the strides (960, 3, -1), allowed: "),
    (lambda f: {"depth": f.depth.astype(np.float64)}, "depth: has the type float64, "
     "allowed: float32 [m] or uint16"),
    (lambda f: {"depth": f.depth[:-1]}, "depth: has the shape (239, 320), allowed: (240, 320)"),
    (lambda f: {"depth": f.depth.T.copy().T}, "depth: has the strides (4, 960), allowed: "),
    (lambda f: {"masks": f.masks > 0}, "masks: has the type bool, allowed: uint8"),
    (lambda f: {"masks": f.masks[None]}, "masks: has the shape (1, 240, 320), allowed: (240, 320)"),
])
def test_wrong_arrays_are_named(slam, frames, change, text):
    with pytest.raises(ValueError) as fault:
        slam.process(**broken(frames[0], **change(frames[0])))
    assert text in str(fault.value)
    assert len(slam.trajectory()) == 0


def test_other_arguments_are_named(slam, frames):
    frame = frames[1]
    slam.process_frame(frame)
    cases = [
        (lambda: slam.process_frame(frame), f"stamp: is {frame.stamp}, allowed: more than"),
        (lambda: mms_slam.Slam(segmenter="magic"), "segmenter: is 'magic', allowed: 'masks'"),
        (lambda: mms_slam.Slam(weights="x.onnx"), "weights: is for masks of the network"),
        (lambda: mms_slam.Slam().process(frame.color, frame.depth, 1), "calibration: has no camera"),
        (lambda: mms_slam.Slam(segmenter="none", calibration=frame.calibration).process(
            frame.color, frame.depth, 1, frame.masks), "masks: are given, but the masks come from"),
        (lambda: slam.process_scan(np.zeros((5, 4), np.float32), 1),
         "points: has the shape (5, 4), allowed: (N, 3)"),
        (lambda: slam.process_scan(np.zeros((5, 3), np.float32), 1, np.zeros(4, np.float32)),
         "times: has the shape (4,), allowed: (5,)"),
        (lambda: mms_slam.Trajectory(np.array([1]), np.zeros((1, 4, 4))),
         "poses: is no rigid transform"),
        (lambda: slam.static_map().write("a.txt"), "path: is a.txt, allowed: a name that ends in"),
        (lambda: mms_slam.Calibration(depth_scale=0.0), "depth_scale: is 0, allowed"),
        (lambda: mms_slam.Calibration(depth_scale=float("inf")), "depth_scale: is inf"),
        (lambda: mms_slam.Calibration(max_depth=-3.0), "max_depth: is -3, allowed: 0.1 to 1000 m"),
        (lambda: mms_slam.Calibration(max_depth=float("nan")), "max_depth: is nan"),
    ]
    for call, text in cases:
        with pytest.raises(ValueError) as fault:
            call()
        assert text in str(fault.value)
    with pytest.raises(mms_slam.ConfigError, match="Camera"):
        mms_slam.Camera(-1.0, 1.0, 0.0, 0.0, 10, 10)


def test_trajectory_goes_there_and_back():
    poses = np.tile(np.eye(4), (3, 1, 1))
    poses[:, 0, 3] = [0.0, 0.5, 1.25]
    poses[2, :3, :3] = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    trajectory = mms_slam.Trajectory(np.array([5, 6, 7]), poses)
    assert np.array_equal(trajectory.poses, poses)
    assert trajectory.stamps.tolist() == [5, 6, 7]


def test_objects_do_not_keep_the_points_of_their_frame():
    recording = mms_slam.Recording("sim:stop_and_go?frames=8&width=320")
    slam = mms_slam.Slam(calibration=recording.calibration)
    for frame in recording:
        result = slam.process_frame(frame)
        if result.objects:
            break
    velocity, alive = result.objects[0].box.velocity, weakref.ref(result)
    del result
    gc.collect()
    assert alive() is None and np.isfinite(velocity).all()


def test_arrays_that_are_copied_may_have_gaps(slam, frames):
    for frame in frames[:5]:
        slam.process_frame(frame)
    one = slam.trajectory()
    two = mms_slam.Trajectory(one.stamps[::2], one.poses[::2])
    assert np.array_equal(two.poses, one.poses[::2])
    scan = np.random.default_rng(0).normal(size=(500, 4)).astype(np.float32)
    a = mms_slam.Slam().process_scan(scan[:, :3], 1, intensity=scan[:, 3])
    b = mms_slam.Slam().process_scan(scan[:, :3].copy(), 1)
    assert np.array_equal(a.points, b.points, equal_nan=True)


def test_depth_of_a_camera_of_its_own_is_registered(frames, tmp_path):
    camera, color = frames[0].calibration.camera, frames[0].color
    (tmp_path / "c.yaml").write_text(
        f"fx: {camera.fx}\nfy: {camera.fy}\ncx: {camera.cx}\ncy: {camera.cy}\n"
        f"width: {camera.width}\nheight: {camera.height}\ndepth_scale: 1000\n"
        f"depth_camera:\n  fx: {camera.fx / 2}\n  fy: {camera.fy / 2}\n"
        f"  cx: {camera.cx / 2 - 0.25}\n  cy: {camera.cy / 2 - 0.25}\n"
        f"  width: {camera.width // 2}\n  height: {camera.height // 2}\n"
        "  T_color_depth: [1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0]\n")
    read = mms_slam.Calibration.read(tmp_path / "c.yaml")
    made = mms_slam.Calibration(camera, depth_camera=read.depth_camera,
                                T_color_depth=read.T_color_depth)
    assert made.T_color_depth[0, 3] == 0.1 and made.depth_camera.width == camera.width // 2
    wall = np.full((camera.height, camera.width), 2.0, np.float32)
    small = np.full((camera.height // 2, camera.width // 2), 2000, np.uint16)
    left = np.nanmin(mms_slam.Slam(calibration=frames[0].calibration).process(
        color, wall, 1).points[:, 0])
    for calibration in (read, made):
        slam = mms_slam.Slam(calibration=calibration)
        with pytest.raises(ValueError, match=r"depth: has the shape .*, allowed: \(120, 160\)"):
            slam.process(color, wall, 1)
        points = slam.process(color, small, 1).points  # 10 cm to the right of the depth camera
        assert np.nanmin(points[:, 0]) == pytest.approx(left + 0.1, abs=0.03)
    with pytest.raises(ValueError, match="depth_camera: needs a camera"):
        mms_slam.Calibration(depth_camera=camera)


def test_grid_of_the_floor(slam, frames, tmp_path):
    assert slam.occupancy_grid().cells.shape == (0, 0)
    for frame in frames:
        slam.process_frame(frame)
    grid = slam.occupancy_grid()
    rows, columns = grid.cells.shape
    assert grid.cells.dtype == np.uint8 and set(np.unique(grid.cells)) == {0, 1, 2}
    end = grid.origin + grid.resolution * np.array([columns, rows])
    assert grid.origin[0] < 2 and end[0] > 5 and grid.origin[1] < -1 and end[1] > 1  # ahead
    assert np.abs(grid.pose[:3, 2] - [0, -1, 0]).max() < 0.1  # up, of a level camera
    with pytest.raises(ValueError, match="path: .* ends in .yaml"):
        grid.write(tmp_path / "map.pgm")
    without = mms_slam.Slam(settings={"occupancy.enabled": False})
    with pytest.raises(RuntimeError, match="occupancy.enabled is off"):
        without.occupancy_grid()
