"""Errors, warnings, threads, interrupts, closed recordings."""
import os
import signal
import threading
import time

import numpy as np
import pytest

import mms_slam
from conftest import SCENE

# Its depth noise is measured in the first frame, and larger than that of the settings.
NOISY_SCENE = "sim:rack_aisle?frames=8&width=320&sensor=d435"


def test_errors_have_the_text_of_the_program(mms, tmp_path):
    (tmp_path / "empty").mkdir()
    (tmp_path / "bad.yaml").write_text("odometry: {iterations: 2.5}\n")
    cases = [
        (mms_slam.DataError, lambda: mms_slam.Recording("no/such"), ("info", "no/such")),
        (mms_slam.DataError, lambda: mms_slam.Recording(tmp_path / "empty"),
         ("info", tmp_path / "empty")),
        (mms_slam.ConfigError, lambda: mms_slam.Slam(tmp_path / "bad.yaml"),
         ("run", SCENE, "-c", tmp_path / "bad.yaml")),
        (mms_slam.FileError, lambda: mms_slam.Slam(tmp_path / "none.yaml"),
         ("run", SCENE, "-c", tmp_path / "none.yaml")),
        (mms_slam.FileError,
         lambda: mms_slam.Slam(segmenter="network", weights=tmp_path / "w.safetensors"),
         ("run", SCENE, "--weights", tmp_path / "w.safetensors")),
    ]
    for kind, call, words in cases:
        with pytest.raises(kind) as fault:
            call()
        assert isinstance(fault.value, mms_slam.Error)
        assert f"mms: {fault.value}\n" in mms(*words, fails=True)


def test_unknown_setting_is_named():
    with pytest.raises(mms_slam.DataError, match="settings: .*voxel_siz"):
        mms_slam.Slam(settings={"static_map.voxel_siz": 0.1})


def test_results_before_the_first_frame_are_empty_and_change_nothing():
    frames = list(mms_slam.Recording(NOISY_SCENE))

    def poses(ask):
        slam = mms_slam.Slam(calibration=frames[0].calibration)
        if ask:
            assert len(slam.static_map()) == len(slam.static_map(corrected=False)) == 0
            assert len(slam.trajectory()) == len(slam.trajectory(corrected=True)) == 0
            assert not slam.objects()
            slam.finish()
        for frame in frames:
            slam.process_frame(frame)
        return slam.trajectory().poses

    assert np.array_equal(poses(ask=True), poses(ask=False))


def test_recording_is_an_iterator():
    with mms_slam.Recording(SCENE) as recording:
        assert len(recording) == 24 and recording.has_masks
        recording.skip(20)
        frames = list(recording)
        assert [frame.index for frame in frames] == [20, 21, 22, 23]
        assert len(recording.ground_truth) == 24
        assert any("320" in line for line in recording.describe())
    with pytest.raises(ValueError, match="this recording is closed"):
        next(recording)
    with pytest.raises(ValueError, match="this recording is closed"):
        recording.skipped  # pylint: disable=pointless-statement
    recording.close()
    assert frames[0].color.any()  # frames stay valid


def test_damaged_frames_are_warnings(mms, tmp_path):
    mms("simulate", "crowd", "--frames", "6", "--seed", "1", "-o", tmp_path / "sim")
    images = sorted((tmp_path / "sim").rglob("*.png"))
    depth = [image for image in images if image.parent.name == "depth"]
    depth[2].write_bytes(b"no image")
    recording = mms_slam.Recording(tmp_path / "sim")
    with pytest.warns(UserWarning, match=depth[2].name):
        frames = list(recording)
    assert len(frames) == 5 and recording.skipped == 1


def test_repeated_frames_are_left_out_as_by_run(mms, tmp_path):
    mms("convert", SCENE, "-o", tmp_path / "sim")
    depth = sorted((tmp_path / "sim" / "depth").iterdir())
    depth[5].write_bytes(depth[4].read_bytes())
    recording = mms_slam.Recording(tmp_path / "sim")
    slam = mms_slam.Slam(calibration=recording.calibration, segmenter="none")
    with pytest.warns(UserWarning, match="repeats an image or scan of the frame before"):
        frames = list(recording)
    assert len(frames) == 23 and recording.skipped == 1
    for frame in frames:
        slam.process_frame(frame)
    slam.trajectory().write(tmp_path / "poses.tum")
    mms("run", tmp_path / "sim", "-o", tmp_path / "run", "--segmenter", "none")
    written = (tmp_path / "run" / "trajectory.tum").read_bytes()
    assert (tmp_path / "poses.tum").read_bytes() == written


def test_rate_is_of_recordings_without_time_stamps(mms, tmp_path):
    mms("convert", "sim:static?frames=3&width=160", "-o", tmp_path / "sim")
    with pytest.raises(mms_slam.DataError, match="has time stamps of its own"):
        mms_slam.Recording(tmp_path / "sim", rate=20)
    with pytest.raises(ValueError, match="rate: is 0.0"):
        mms_slam.Recording(tmp_path / "sim", rate=0)
    for name in ("rgb", "depth"):
        images = sorted((tmp_path / "sim" / name).iterdir())
        for number, image in enumerate(images):
            image.rename(image.with_name(f"{name}_{number}{image.suffix}"))
        (tmp_path / "sim" / f"{name}.txt").unlink()
    (tmp_path / "sim" / "groundtruth.txt").unlink()
    stamps = [frame.stamp for frame in mms_slam.Recording(tmp_path / "sim", rate=20)]
    assert stamps == [0, 50_000_000, 100_000_000]


def test_topics_of_bags_and_files_of_wheels(mms, tmp_path):
    bag = tmp_path / "two.bag"
    mms("convert", "sim:static?frames=3&width=160", "-o", bag)
    topic = next(word.strip(",") for line in mms("info", bag).splitlines() for word in line.split()
                 if word.startswith("/") and "depth" in word)
    assert len(list(mms_slam.Recording(bag, topics={"depth": topic}))) == 3
    with pytest.raises(mms_slam.Error, match="/other"):
        mms_slam.Recording(bag, topics={"depth": "/other"})
    with pytest.raises(ValueError, match="topics: has the key 'colour', allowed: 'color', "):
        mms_slam.Recording(bag, topics={"colour": "/color"})
    mms("convert", "sim:static?frames=3&width=160", "-o", tmp_path / "sim")
    with pytest.raises(mms_slam.Error, match="wheels.csv"):
        mms_slam.Recording(tmp_path / "sim", wheels=tmp_path / "wheels.csv")
    assert len(list(mms_slam.Recording(tmp_path / "sim", wheels="none", imu="none"))) == 3


def test_other_threads_run_meanwhile(slam, frames):
    """A thread that counts gets on while frames are processed: a held GIL would stop it."""
    longest, stop = [], threading.Event()

    def tick():
        last = time.perf_counter()
        while not stop.is_set():
            time.sleep(0.0005)
            now = time.perf_counter()
            longest.append((last, now))
            last = now

    ticker = threading.Thread(target=tick)
    ticker.start()
    inside = 0
    for frame in frames:
        begin = time.perf_counter()
        slam.process_frame(frame)
        end = time.perf_counter()
        inside += sum(begin < first and last < end for first, last in list(longest))
        longest.clear()
    stop.set()
    ticker.join()
    assert inside > len(frames)


def test_other_threads_run_while_results_are_evaluated():
    points = np.random.default_rng(0).uniform(-10, 10, (50000, 3)).astype(np.float32)
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.0005)

    ticker = threading.Thread(target=tick)
    ticker.start()
    begin = time.perf_counter()
    mms_slam.evaluate_map(points, points[:100], points)
    end = time.perf_counter()
    stop.set()
    ticker.join()
    assert sum(begin + 0.01 < moment < end - 0.01 for moment in list(ticks)) > 10


def test_threads_take_turns(frames):
    """Frames of several threads, one after another; maps are read meanwhile."""
    slam = mms_slam.Slam(calibration=frames[0].calibration)
    turn, sizes, stop = threading.Condition(), [], threading.Event()
    done = 0

    def process(first):
        nonlocal done
        for i in range(first, len(frames), 2):
            with turn:
                turn.wait_for(lambda i=i: done == i)
                slam.process_frame(frames[i])
                done += 1
                turn.notify_all()

    def read():
        while not stop.is_set():
            sizes.append((len(slam.static_map()), len(slam.trajectory()), len(slam.objects())))

    reader = threading.Thread(target=read)
    threads = [threading.Thread(target=process, args=(i,)) for i in range(2)]
    for thread in (reader, *threads):
        thread.start()
    for thread in threads:
        thread.join()
    stop.set()
    reader.join()
    alone = mms_slam.Slam(calibration=frames[0].calibration)
    for frame in frames:
        alone.process_frame(frame)
    assert np.array_equal(slam.trajectory().poses, alone.trajectory().poses)
    assert sizes[-1][0] > 0 and len({size[1] for size in sizes}) > 1


def test_interrupt_leaves_a_whole_state(slam, frames):
    signal.signal(signal.SIGINT, signal.default_int_handler)  # shells ignore it in the background
    interrupts = 0
    timer = None
    while (done := len(slam.trajectory())) < len(frames):
        try:
            if timer is None or not timer.is_alive():
                timer = threading.Timer(0.003, os.kill, (os.getpid(), signal.SIGINT))
                timer.start()
            while done < len(frames):
                slam.process_frame(frames[done])
                done += 1
        except KeyboardInterrupt:
            interrupts += 1
            timer.join()
            if interrupts >= 3:
                timer = threading.Timer(0.0, lambda: None)  # no more
                timer.is_alive = lambda: True
    assert interrupts >= 3
    alone = mms_slam.Slam(calibration=frames[0].calibration)
    for frame in frames:
        alone.process_frame(frame)
    assert np.array_equal(slam.trajectory().poses, alone.trajectory().poses)


def test_threads_that_wait_for_a_slam_stop_no_others():
    frames = list(mms_slam.Recording("sim:warehouse_loop?frames=40&width=320"))
    slam, stop, gaps = mms_slam.Slam(calibration=frames[0].calibration), threading.Event(), []
    slam.process_frame(frames[0])

    def tick():
        last = time.perf_counter()
        while not stop.is_set():
            time.sleep(0.0005)
            now = time.perf_counter()
            gaps.append(now - last)
            last = now

    def read():
        while not stop.is_set():
            slam.static_map()
            time.sleep(0.001)

    threads = [threading.Thread(target=target) for target in (tick, read, read)]
    for thread in threads:
        thread.start()
    begin = time.perf_counter()
    for frame in frames[1:]:
        slam.process_frame(frame)
    took = time.perf_counter() - begin
    stop.set()
    for thread in threads:
        thread.join()
    # Each frame waits for two maps; a thread that holds the lock meanwhile stops the clock so long.
    assert sum(gap for gap in gaps if gap > 0.1) < 0.5 * took


def test_text_that_is_no_utf8_is_shown(mms, tmp_path):
    path = tmp_path / "bad.tum"
    path.write_bytes(b"0 0.\xff1 0 0 0 0 0 1\n")
    with pytest.raises(mms_slam.DataError, match=r"bad\.tum:1: .*\\xff"):
        mms_slam.Trajectory.read(path)
    folder = os.fsencode(tmp_path) + b"/M\xfcnchen"
    mms("simulate", "crowd", "--frames", "4", "--seed", "1", "-o", tmp_path / "sim")
    os.rename(tmp_path / "sim", folder)
    depth = sorted(os.listdir(folder + b"/depth"))
    with open(folder + b"/depth/" + depth[1], "wb") as image:
        image.write(b"no image")
    with pytest.warns(UserWarning, match=r"M\\xfcnchen"):
        assert len(list(mms_slam.Recording(folder))) == 3
