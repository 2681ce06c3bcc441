"""Map files: made by one run, used by the next one."""
import contextlib
import sqlite3

import numpy as np
import pytest

import mms_slam
from conftest import SCENE


def run(tmp_path, **arguments):
    """The last result of a run over the scene, after its map is saved."""
    recording = mms_slam.Recording(SCENE)
    slam = mms_slam.Slam(calibration=recording.calibration, **arguments)
    for frame in recording:
        result = slam.process_frame(frame)
    slam.finish()
    return result, slam.save_map()


def test_map_of_a_run_is_used_by_the_next_one(mms, tmp_path):
    path = tmp_path / "room.mmsmap"
    result, saved = run(tmp_path, save_map=path)
    assert saved and result.world_in_map is not None
    assert "1 sessions" in mms("info", path) and "24 frames" in mms("info", path)
    before = path.read_bytes()
    localized, saved = run(tmp_path, map=path, localize=True)
    assert not saved and path.read_bytes() == before
    assert localized.world_in_map is not None
    assert (localized.world_in_map @ localized.pose)[:3, 3] == pytest.approx(
        result.pose[:3, 3], abs=0.02)
    _, saved = run(tmp_path, map=path)
    assert saved and "2 sessions" in mms("info", path)


def test_maps_have_the_settings_of_a_run(mms, tmp_path):
    scene = "sim:rack_aisle?frames=8&width=320&sensor=d435"  # its noise and range are its own
    slam = mms_slam.Slam(save_map=tmp_path / "python.mmsmap")
    for frame in mms_slam.Recording(scene):
        slam.process_frame(frame)
    slam.finish()
    assert slam.save_map()
    mms("run", scene, "--segmenter", "masks", "-o", tmp_path / "run",
        "--save-map", tmp_path / "run.mmsmap")

    def settings(name):
        with contextlib.closing(sqlite3.connect(tmp_path / name)) as database:
            return database.execute("SELECT settings FROM sessions").fetchall()

    assert settings("python.mmsmap") == settings("run.mmsmap")


def test_maps_of_another_camera_are_named_after_a_look_at_the_empty_map(tmp_path):
    path = tmp_path / "room.mmsmap"
    run(tmp_path, save_map=path)
    recording = mms_slam.Recording("sim:rack_aisle?frames=1&width=320&sensor=kinect")
    slam = mms_slam.Slam(calibration=recording.calibration, map=path)
    assert len(slam.static_map()) == 0
    with pytest.warns(UserWarning, match="the map is of another camera"):
        slam.process_frame(next(recording))


def test_a_given_place_is_searched_anew(slam, frames):
    def process(frame):
        return slam.process(frame.color, frame.depth, frame.stamp, frame.masks)

    assert [process(frame).session for frame in frames[:12]] == [0] * 12
    with pytest.raises(ValueError, match="pose: is no rigid transform"):
        slam.expect_place(np.zeros((4, 4)))
    slam.expect_place(slam.trajectory().poses[-1])
    assert [process(frame).session for frame in frames[12:15]] == [1] * 3


def test_no_map_is_saved_unless_one_is_named(tmp_path):
    assert not run(tmp_path)[1]


def test_without_frames_there_is_no_map_to_save(tmp_path):
    path = tmp_path / "room.mmsmap"
    slam = mms_slam.Slam(save_map=path)
    slam.finish()
    with pytest.raises(RuntimeError, match="save_map: no frame was processed"):
        slam.save_map()
    assert not path.exists()


def test_wrong_map_files_are_named(tmp_path):
    path = tmp_path / "a.mmsmap"
    path.write_text("no map")
    with pytest.raises(mms_slam.Error, match="a.mmsmap"):
        mms_slam.Slam(map=path)
    with pytest.raises(ValueError, match="save_map: .*exists"):
        mms_slam.Slam(save_map=path)
    with pytest.raises(ValueError, match="localize: needs a map"):
        mms_slam.Slam(localize=True)
    with pytest.raises(ValueError, match="save_map"):
        mms_slam.Slam(map=path, save_map=tmp_path / "b.mmsmap", localize=True)
    assert path.read_text() == "no map"
