#!/usr/bin/env python3
"""Makes the mistakes of a first hour with the program, and checks its answer to each.

usage: first_hour_test.py PROGRAM [NAME]   (NAME: only cases whose name contains it)
Every case makes its input from two small simulated recordings, runs the program, and expects an
exit status and words in its output. A fault is one line, so a trace or a second error fails, too.
"""

import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = Path(sys.argv[1]).resolve()
ONLY = sys.argv[2] if len(sys.argv) > 2 else ""
RUN = ["run", "data", "--segmenter", "none", "-o", "out"]
CASES = []


def case(status, *words, args=RUN):
    """Registers a function that changes the folder of a case; it may return other arguments."""

    def register(change):
        CASES.append((change.__name__, status, words, args, change))
        return change

    return register


def edit(path, *changes):
    text = path.read_text()
    for old, new in changes:
        assert old in text, (path, old)
        text = text.replace(old, new)
    path.write_text(text)


def lines(path):
    return [line for line in path.read_text().splitlines() if line and not line.startswith("#")]


def set_key(path, key, value):
    kept = [line for line in path.read_text().splitlines() if not line.startswith(key + ":")]
    path.write_text("\n".join(kept + ([f"{key}: {value}"] if value is not None else [])) + "\n")


def key_of(path, key):
    for line in path.read_text().splitlines():
        if line.startswith(key + ":"):
            return float(line.split()[1])
    raise KeyError(key)


# Recordings that are none


@case(1, "no such recording", args=["run", "dta"])
def a_wrong_path(folder):
    pass


@case(1, "is empty: no recording found", args=["run", "nothing"])
def an_empty_folder(folder):
    (folder / "nothing").mkdir()


@case(1, "no recording found", "expected rgb.txt and depth.txt", args=["run", "data/rgb"])
def a_folder_of_color_images_alone(folder):
    pass


@case(1, "did you mean", "data", args=["run", "above"])
def the_folder_above_the_recording(folder):
    (folder / "above").mkdir()
    (folder / "data").rename(folder / "above/data")


@case(1, "is a file; a recording is a folder, a ROS bag (.bag, .mcap, .db3)", args=["run", "notes.txt"])
def a_text_file(folder):
    (folder / "notes.txt").write_text("hello")


@case(1, "x.mcap: is empty", "was not closed", args=["run", "x.mcap"])
def an_mcap_file_without_content(folder):
    (folder / "x.mcap").write_bytes(b"\x89MCAP0\r\n")


@case(1, "bag2_0.db3: is damaged or not a recording of rosbag2", args=["run", "bag2"])
def a_rosbag2_folder_with_a_damaged_file(folder):
    (folder / "bag2").mkdir()
    (folder / "bag2/metadata.yaml").write_text("rosbag2_bagfile_information:\n")
    (folder / "bag2/bag2_0.db3").write_bytes(b"SQLite format 3\0")


@case(1, "is a video", "a folder with the video and depth/", args=["run", "x.mp4"])
def a_video(folder):
    (folder / "x.mp4").write_bytes(b"\0\0\0\x18ftypmp42")


@case(1, "is an archive", "unpack", args=["run", "x.zip"])
def an_archive(folder):
    (folder / "x.zip").write_bytes(b"PK\x03\x04")


@case(1, "x.bag: ", args=["run", "x.bag"])
def a_text_named_bag(folder):
    (folder / "x.bag").write_text("no bag")


@case(1, "x.bag: is empty", args=["run", "x.bag"])
def an_empty_bag(folder):
    (folder / "x.bag").write_bytes(b"")


@case(1, "no such scene", args=["run", "sim:warehous_loop"])
def a_simulation_with_a_typo(folder):
    pass


@case(1, "'frmes'", "did you mean 'frames'", args=["run", "sim:crowd?frmes=3"])
def a_value_of_a_simulation_with_a_typo(folder):
    pass


@case(1, "has several sequences", "--sequence 00", args=["run", "kitti"])
def the_folder_of_all_sequences(folder):
    (folder / "kitti/sequences").mkdir(parents=True)
    (folder / "lidar").rename(folder / "kitti/sequences/00")


@case(0, "results", "3 frames (KITTI LiDAR scans)",
      args=["run", "kitti", "--sequence", "00", "--segmenter", "none", "-o", "out"])
def a_sequence_by_its_number(folder):
    the_folder_of_all_sequences(folder)


@case(1, "has x.mp4, and no depth images", args=["run", "video"])
def a_video_without_depth_images(folder):
    (folder / "video").mkdir()
    (folder / "video/x.mp4").write_bytes(b"x")


@case(1, "x.mp4: cannot be read as a video", args=["run", "video"])
def a_damaged_video(folder):
    a_video_without_depth_images(folder)
    (folder / "data/depth").rename(folder / "video/depth")


def write_pcap(path, packets):
    """Writes UDP payloads, each with its time [s], as a capture of Ethernet."""
    with open(path, "wb") as file:
        file.write(struct.pack("<IHHQII", 0xA1B2C3D4, 2, 4, 0, 65535, 1))
        for time, payload in packets:
            udp = struct.pack(">HHHH", 2368, 2368, 8 + len(payload), 0) + payload
            ip = struct.pack(">BBHHHBBHII", 0x45, 0, 20 + len(udp), 0, 0, 64, 17, 0, 1, 2)
            packet = bytes(12) + b"\x08\x00" + ip + udp
            file.write(struct.pack("<IIII", 1700000000, int(1e6 * time), len(packet), len(packet)))
            file.write(packet)


def vlp16_packets(seconds):
    """What a VLP-16 measures in a room of 8 x 6 x 3 m."""
    block_time = 110.592e-6
    for number in range(int(seconds / (12 * block_time))):
        start = 12 * block_time * number
        payload = b""
        for block in range(12):
            angle = (3600 * (start + block * block_time)) % 360
            payload += struct.pack("<HH", 0xEEFF, int(100 * angle))
            for channel in range(32):
                up = math.radians(channel % 16 - (15 if channel % 2 == 0 else 0))
                turn = math.radians(angle + 0.2 * (channel // 16) + 0.0083 * (channel % 16))
                walls = (abs(4 / (math.cos(turn) * math.cos(up))),
                         abs(3 / (math.sin(turn) * math.cos(up) or 1e-9)),
                         abs(1.5 / (math.sin(up) or 1e-9)))
                payload += struct.pack("<HB", int(min(walls) / 0.002), 50)
        yield start, payload + struct.pack("<IBB", int(1e6 * start), 0x37, 0x22)


@case(0, "Velodyne VLP-16", "4 frames", args=["run", "x.pcap", "--segmenter", "none", "-o", "out"])
def a_capture_of_lidar_packets(folder):
    write_pcap(folder / "x.pcap", vlp16_packets(0.43))


@case(1, "x.pcap: has no data packets of a Velodyne or an Ouster, but UDP datagrams of 6464 bytes",
      "as x.json beside it", args=["run", "x.pcap"])
def a_capture_of_an_ouster_without_metadata(folder):
    write_pcap(folder / "x.pcap", [(0.0, bytes(6464))])


# Lists and images


@case(1, "depth.txt is missing")
def no_list_of_depth_images(folder):
    (folder / "data/depth.txt").unlink()


@case(1, "3 more like: frame", "none of its", "could be processed")
def all_depth_images_missing(folder):
    shutil.rmtree(folder / "data/depth")


@case(0, "warning: frame", "no such file")
def one_depth_image_missing(folder):
    sorted((folder / "data/depth").iterdir())[1].unlink()


@case(0, "is a truncated PNG")
def a_truncated_depth_image(folder):
    file = sorted((folder / "data/depth").iterdir())[1]
    file.write_bytes(file.read_bytes()[:500])


@case(0, "is empty, expected an image")
def an_empty_color_image(folder):
    sorted((folder / "data/rgb").iterdir())[1].write_bytes(b"")


@case(1, "expected a 16-bit depth image")
def lists_of_color_and_depth_swapped(folder):
    data = folder / "data"
    (data / "rgb.txt").rename(data / "x")
    (data / "depth.txt").rename(data / "rgb.txt")
    (data / "x").rename(data / "depth.txt")


@case(1, "no two match within 0.02 s", "the lists begin at")
def lists_with_different_clocks(folder):
    path = folder / "data/depth.txt"
    rows = [line.split() for line in lines(path)]
    path.write_text("".join(f"{float(t) + 1000:.6f} {f}\n" for t, f in rows))


@case(0, "not in order in the list, sorted", args=["info", "data"])
def an_unsorted_list(folder):
    path = folder / "data/rgb.txt"
    path.write_text("\n".join(reversed(lines(path))) + "\n")


@case(0, "frames           ", "6")
def stamps_in_nanoseconds(folder):
    for name in ("rgb", "depth"):
        path = folder / f"data/{name}.txt"
        rows = [line.split() for line in lines(path)]
        path.write_text("".join(f"{int((float(t) + 1.3e9) * 1e9)} {f}\n" for t, f in rows))
    (folder / "data/groundtruth.txt").unlink()


@case(0, "duplicate stamp", "such lines")
def every_line_twice(folder):
    path = folder / "data/rgb.txt"
    path.write_text("".join(line + "\n" + line + "\n" for line in lines(path)))


@case(0, "line skipped, expected 'stamp path'")
def a_damaged_line(folder):
    with (folder / "data/rgb.txt").open("a") as file:
        file.write("nonsense\n")


@case(0, "different clocks")
def ground_truth_with_another_clock(folder):
    path = folder / "data/groundtruth.txt"
    rows = [line.split() for line in lines(path)]
    path.write_text("".join(f"{float(r[0]) + 9e5:.6f} {' '.join(r[1:])}\n" for r in rows))


@case(1, "groundtruth.txt:1")
def a_damaged_ground_truth(folder):
    (folder / "data/groundtruth.txt").write_text("one two three\n")


# Calibration


@case(1, "has no camera calibration", "calibration.yaml", "--intrinsics")
def no_calibration(folder):
    (folder / "data/calibration.yaml").unlink()


@case(1, "calibration.yaml:", "unknown key 'fxx'")
def a_calibration_with_a_typo(folder):
    edit(folder / "data/calibration.yaml", ("fx:", "fxx:"))


@case(1, "fx is 'wide', expected a number")
def a_calibration_with_a_word(folder):
    set_key(folder / "data/calibration.yaml", "fx", "wide")


@case(1, "fx is -500, allowed: ")
def a_negative_focal_length(folder):
    set_key(folder / "data/calibration.yaml", "fx", "-500")


@case(1, "is 640x480 pixels", "none of its")
def a_calibration_of_another_size(folder):
    set_key(folder / "data/calibration.yaml", "width", 1280)
    set_key(folder / "data/calibration.yaml", "height", 960)


@case(0, "implausible: ", "is the depth scale of")
def a_depth_scale_ten_times_too_small(folder):
    path = folder / "data/calibration.yaml"
    set_key(path, "depth_scale", key_of(path, "depth_scale") / 10)


@case(0, "implausible: ", "is the depth scale of")
def a_depth_scale_ten_times_too_large(folder):
    path = folder / "data/calibration.yaml"
    set_key(path, "depth_scale", key_of(path, "depth_scale") * 10)


@case(0, "implausible: ", "far from the center")
def cx_and_cy_swapped(folder):
    path = folder / "data/calibration.yaml"
    cx, cy = key_of(path, "cx"), key_of(path, "cy")
    set_key(path, "cx", cy)
    set_key(path, "cy", cx)


MOVING = ["run", "moving", "--segmenter", "masks", "-o", "out"]


@case(0, "implausible: the depth images are 3 frames (200 ms) behind", args=MOVING)
def depth_images_of_earlier_frames(folder):
    simulate(folder, "moving", "--frames", "16")
    path = folder / "moving/depth.txt"
    stamps = [line.split()[0] for line in lines(path)]
    images = [line.split()[1] for line in lines(path)]
    pairs = zip(stamps[3:], images)
    path.write_text("".join(f"{stamp} {image}\n" for stamp, image in pairs))


@case(0, "implausible: the masks are 3 frames (200 ms) behind", args=MOVING)
def masks_of_earlier_frames(folder):
    simulate(folder, "moving", "--frames", "16")
    masks = sorted((folder / "moving/masks").iterdir())
    for late, early in reversed(list(zip(masks[3:], masks))):
        shutil.copy(early, late)


@case(1, "camera_matrix has 2 numbers, expected nine", args=RUN + ["--calibration", "camera.yaml"])
def a_calibration_file_without_camera(folder):
    (folder / "camera.yaml").write_text("camera_matrix: {data: [1, 2]}\n")


@case(1, "is 'equidistant', which is not supported", args=RUN + ["--calibration", "camera.yaml"])
def a_fisheye_calibration(folder):
    (folder / "camera.yaml").write_text(
        "cam0:\n  camera_model: pinhole\n  distortion_model: equidistant\n"
        "  distortion_coeffs: [0, 0, 0, 0]\n  intrinsics: [500, 500, 320, 240]\n"
        "  resolution: [640, 480]\n")


@case(2, "--calibration", args=RUN + ["--calibration", "none.yaml"])
def a_calibration_file_that_is_missing(folder):
    pass


@case(2, "is not fx,fy,cx,cy in pixels", args=RUN + ["--intrinsics", "500,500,320"])
def three_intrinsics(folder):
    pass


@case(2, "--depth-scale", args=RUN + ["--depth-scale", "none"])
def a_depth_scale_that_is_no_number(folder):
    pass


# Masks and networks


@case(1, "has no masks", args=["run", "data", "--segmenter", "masks", "-o", "out"])
def no_masks(folder):
    shutil.rmtree(folder / "data/masks")


@case(1, "has no mask for any frame", args=["run", "data", "--masks", "others", "-o", "out"])
def masks_with_other_names(folder):
    (folder / "others").mkdir()
    source = next((folder / "data/masks").iterdir())
    shutil.copy(source, folder / "others/a.png")


@case(0, "warning: frame", "mask", args=["run", "data", "--segmenter", "masks", "-o", "out"])
def a_mask_that_is_a_color_image(folder):
    mask = sorted((folder / "data/masks").iterdir())[1]
    shutil.copy(next((folder / "data/rgb").iterdir()), mask)


@case(1, "none.safetensors", args=["run", "data", "--weights", "none.safetensors", "-o", "out"])
def weights_that_are_missing(folder):
    pass


@case(1, "bad.safetensors", args=["run", "data", "--weights", "bad.safetensors", "-o", "out"])
def weights_that_are_none(folder):
    (folder / "bad.safetensors").write_text("no weights")


# Settings


@case(1, "my.yaml", args=RUN + ["-c", "my.yaml"])
def settings_that_are_missing(folder):
    pass


@case(1, "my.yaml:1: unknown key 'static_mapp'", "did you mean", args=RUN + ["-c", "my.yaml"])
def a_group_of_settings_with_a_typo(folder):
    (folder / "my.yaml").write_text("static_mapp: {voxel_size: 0.1}\n")


@case(1, "static_map.voxel_size is 'big', expected a number", args=RUN + ["-c", "my.yaml"])
def a_setting_with_a_word(folder):
    (folder / "my.yaml").write_text("static_map: {voxel_size: big}\n")


@case(1, "static_map.voxel_size is 100, allowed: ", args=RUN + ["-c", "my.yaml"])
def a_setting_out_of_range(folder):
    (folder / "my.yaml").write_text("static_map: {voxel_size: 100}\n")


@case(1, "my.yaml:", "is not YAML", args=RUN + ["-c", "my.yaml"])
def settings_that_are_no_yaml(folder):
    (folder / "my.yaml").write_text("static_map: {voxel_size: [\n")


@case(1, "--set", "did you mean", args=RUN + ["--set", "static_map.voxl_size=0.1"])
def a_setting_of_the_command_line_with_a_typo(folder):
    pass


@case(1, "'static_map.voxel_size' is not key=value", args=RUN + ["--set", "static_map.voxel_size"])
def a_setting_without_value(folder):
    pass


# Outputs


@case(1, "out", args=RUN)
def an_output_that_is_a_file(folder):
    (folder / "out").write_text("mine")


@case(1, "did not write, as mine.txt", args=RUN)
def an_output_with_other_files(folder):
    (folder / "out").mkdir()
    (folder / "out/mine.txt").write_text("mine")


@case(1, "did not write", args=["run", "data", "--segmenter", "none", "-o", "data", "--overwrite"])
def an_output_into_the_recording(folder):
    pass


@case(1, "has earlier results", "--overwrite", args=RUN)
def an_output_with_earlier_results(folder):
    (folder / "out").mkdir()
    (folder / "out/metrics.json").write_text("{}\n")


@case(1, "did not end", "mms convert", args=RUN)
def an_output_with_the_journal_of_a_killed_run(folder):
    (folder / "out").mkdir()
    (folder / "out/journal.bin").write_bytes(b"mmsjrnl\n")


# Command line


@case(2, "no command given, expected run", args=[])
def no_command(folder):
    pass


@case(2, "unknown command 'rum', did you mean 'run'?", args=["rum", "data"])
def a_command_with_a_typo(folder):
    pass


@case(2, "unknown option '--fusio', did you mean '--fusion'?", args=["run", "--fusio", "none", "data"])
def an_option_with_a_typo(folder):
    pass


@case(2, "unexpected argument 'out'", args=["run", "data", "out"])
def an_argument_too_many(folder):
    pass


@case(2, "--frames: Value 0", args=RUN + ["--frames", "0"])
def no_frames(folder):
    pass


@case(1, "--start: is 100, but data has 6 frames", args=RUN + ["--start", "100"])
def a_start_behind_the_end(folder):
    pass


@case(2, "--threads", args=RUN + ["--threads", "many"])
def threads_as_a_word(folder):
    pass


@case(2, "{multimodal,vision,none}", args=RUN + ["--fusion", "both"])
def an_unknown_fusion(folder):
    pass


@case(2, "is not a port", args=["run", "data", "--view", "99999"])
def a_port_that_is_none(folder):
    pass


@case(1, "is not a bag and has no topics", args=RUN + ["--topic-color", "/camera"])
def a_topic_of_a_folder(folder):
    pass


# LiDAR


@case(1, "scans/", args=["run", "scans", "--segmenter", "none", "-o", "out"])
def a_scan_of_odd_size(folder):
    (folder / "scans").mkdir()
    (folder / "scans/000000.bin").write_bytes(b"123")


@case(0, "warning: frame", args=["run", "lidar", "--segmenter", "none", "-o", "out"])
def an_empty_scan(folder):
    sorted((folder / "lidar/velodyne").iterdir())[1].write_bytes(b"")


@case(1, "times.txt", args=["run", "lidar", "--segmenter", "none", "-o", "out"])
def too_few_times(folder):
    path = folder / "lidar/times.txt"
    path.write_text(path.read_text().split("\n")[0] + "\n")


@case(1, "PCD", args=["run", "scans", "--segmenter", "none", "-o", "out"])
def a_cloud_that_is_none(folder):
    (folder / "scans").mkdir()
    (folder / "scans/cloud_1.pcd").write_text("no cloud\n")


@case(0, "points: 5 float32 each", args=["info", "scans"])
def scans_of_five_numbers(folder):
    (folder / "scans").mkdir()
    for index in range(2):
        points = b""
        for i in range(2000):
            point = (5 + 0.01 * i % 3, 0.001 * i - 1, 0.002 * (i % 500), i % 200, i % 32)
            points += struct.pack("<5f", *point)
        (folder / f"scans/{index:06}.bin").write_bytes(points)


# Other commands


@case(1, "are both from the same recording and clock?", args=["eval", "trajectory", "data/groundtruth.txt", "other.tum"])
def trajectories_with_different_clocks(folder):
    (folder / "other.tum").write_text(
        "".join(f"{9000 + i} {i} 0 0 0 0 0 1\n" for i in range(5)))


@case(1, "empty.tum", args=["eval", "trajectory", "data/groundtruth.txt", "empty.tum"])
def an_empty_trajectory(folder):
    (folder / "empty.tum").write_text("")


@case(1, "none.ply", args=["eval", "map", "data/map_truth.ply", "none.ply"])
def a_map_that_is_missing(folder):
    pass


@case(1, "x.xyz", args=["convert", "data/groundtruth.txt", "-o", "x.xyz"])
def an_unknown_format(folder):
    pass


@case(1, "is no image that can be read", args=["segment", "bad.png", "-o", "found"])
def a_picture_that_is_none(folder):
    (folder / "bad.png").write_text("no picture")


@case(1, "did you mean 'crowd'?", args=["simulate", "crwd", "-o", "x"])
def a_scene_with_a_typo(folder):
    pass


@case(1, "--seed: seed is '-1', allowed: ", args=["simulate", "crowd", "-o", "x", "--seed", "-1"])
def a_negative_seed(folder):
    pass


@case(1, "data: ", args=["view", "data"])
def a_view_of_a_recording(folder):
    pass


@case(1, "none.yaml", args=["train", "-c", "none.yaml", "-o", "runs"])
def a_training_without_settings(folder):
    pass


@case(1, "none.yaml: no such file", args=["calibration", "convert", "none.yaml", "-o", "x.yaml"])
def a_calibration_to_convert_that_is_missing(folder):
    pass


def simulate(folder, name, *options):
    command = [PROGRAM, "simulate", "still_walker", "-o", folder / name, *options]
    subprocess.run(command, check=True, capture_output=True)


def check(base, name, status, words, args, change):
    """The faults of a case, as text."""
    folder = base.parent / "case"
    shutil.copytree(base, folder)
    args = change(folder) or args
    result = subprocess.run([PROGRAM, *args], cwd=folder, capture_output=True, text=True,
                            stdin=subprocess.DEVNULL, timeout=120)
    shutil.rmtree(folder)
    output = result.stdout + result.stderr
    faults = [f"'{word}' is missing" for word in words if word not in output]
    if result.returncode != status:
        faults.append(f"exit status {result.returncode}, expected {status}")
    errors = [line for line in result.stderr.splitlines() if line.startswith("mms: ")]
    if len(errors) != (0 if status == 0 else 1):
        faults.append(f"{len(errors)} lines of errors")
    return "".join(f"\n  {fault}" for fault in faults) + (f"\n{output}" if faults else "")


def main():
    failed = 0
    with tempfile.TemporaryDirectory() as place:
        base = Path(place) / "base"
        base.mkdir()
        simulate(base, "data", "--frames", "6")
        simulate(base, "lidar", "--frames", "3", "--sensor", "lidar16")
        chosen = [one for one in CASES if ONLY in one[0]]
        for name, *rest in chosen:
            fault = check(base, name, *rest)
            if fault:
                failed += 1
                print(f"{name.replace('_', ' ')}:{fault}")
    print(f"{len(chosen)} mistakes, {failed} with another answer")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
