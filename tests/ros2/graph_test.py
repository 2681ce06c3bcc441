#!/usr/bin/env python3
"""Runs `mms ros2` in a graph with a program on Fast DDS, which plays a recording to it and receives
its results. usage: graph_test.py MMS PARTNER WORK_DIR

Checks that the poses and the map are those of `mms run` of the recording, bit for bit; that the
partner gets all results, which the libraries of Foxglove decode (where Node is installed); what
nodes of ROS 2 see of the node; the services; and that the node goes on when the partner is killed
and another one starts. WORK_DIR keeps the packages of Node.
"""

import json
import os
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

MMS, PARTNER, WORK = (os.path.abspath(path) for path in sys.argv[1:4])
READERS = Path(__file__).resolve().parent.parent / "ros2_readers"
FRAMES = 40
WAIT = 100  # longest of all steps on a machine under load [s]
TOPICS = {
    "/mms_slam/odometry": "nav_msgs/Odometry",
    "/tf": "tf2_msgs/TFMessage",
    "/mms_slam/path": "nav_msgs/Path",
    "/mms_slam/static_cloud": "sensor_msgs/PointCloud2",
    "/mms_slam/dynamic_cloud": "sensor_msgs/PointCloud2",
    "/mms_slam/map": "sensor_msgs/PointCloud2",
    "/mms_slam/object_markers": "visualization_msgs/MarkerArray",
    "/mms_slam/objects": "mms_msgs/Objects",
    "/mms_slam/mask": "sensor_msgs/Image",
    "/diagnostics": "diagnostic_msgs/DiagnosticArray",
}
HASHES = {  # as Jazzy shows them
    "rt/mms_slam/odometry": "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
    "rt/tf": "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
    "rt/mms_slam/map": "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
    "ros_discovery_info": "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e",
}

os.environ["ROS_LOCALHOST_ONLY"] = "1"
os.environ["ROS_DOMAIN_ID"] = str(1 + os.getpid() % 100)
os.environ.pop("CYCLONEDDS_URI", None)
os.environ.pop("ROS_DISTRO", None)
os.chdir(tempfile.mkdtemp(prefix="mms_ros2_"))


def check(condition, what):
    if not condition:
        sys.exit(f"failed: {what} (in {os.getcwd()})")


def run_mms(*words):
    subprocess.run([MMS, *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def start_node(folder, *words):
    log = open(folder + ".log", "w")
    return subprocess.Popen(
        [MMS, "ros2", "--mask", "/camera/mask/image_raw", "-o", folder, "--queue", "1000", *words],
        stdout=log, stderr=log)


def start_partner(*words):
    return subprocess.Popen([PARTNER, "masks", "on", "timeout", str(WAIT), *words],
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def finish(process, what, status=0):
    try:
        output = process.communicate(timeout=WAIT)[0]
    except subprocess.TimeoutExpired:
        process.kill()
        sys.exit(f"failed: {what} takes longer than {WAIT} s (in {os.getcwd()})")
    check(process.returncode == status, f"{what} ended with {process.returncode}: {output}")
    return output


def wait_for(condition, what):
    end = time.monotonic() + WAIT
    while not condition():
        check(time.monotonic() < end, what)
        time.sleep(0.05)


def poses(folder):
    return [line for line in Path(folder, "trajectory.tum").read_text().splitlines()
            if not line.startswith("#")]


def check_same_results():
    """The partner plays the recording; the node ends by itself after its last frame."""
    node = start_node("live", "--frames", str(FRAMES))
    topics = ",".join(f"{topic}={kind}" for topic, kind in TOPICS.items())
    partner = start_partner("play", "x.mcap", "receive", "received", "topics", topics,
                            "expect", str(FRAMES))
    output = finish(partner, "the partner")
    finish(node, "the node")
    for name in ("trajectory.tum", "static_map.ply"):
        check(Path("live", name).read_bytes() == Path("run", name).read_bytes(),
              f"{name} differs from that of mms run")
    counts = dict(line.split() for line in output.splitlines() if line.startswith("/"))
    check(counts["/mms_slam/odometry"] == str(FRAMES), f"counts of messages: {counts}")
    check(all(int(count) > 0 for count in counts.values()), f"counts of messages: {counts}")
    print(f"ok: {FRAMES} poses and the map are those of mms run; received: {counts}")


def check_lidar():
    """Scans with images, their transform from /tf_static, in a namespace."""
    run_mms("convert", "sim:warehouse_loop?frames=12&width=320&sensor=lidar16", "-o", "lidar.mcap")
    run_mms("run", "lidar.mcap", "--segmenter", "masks", "-o", "lidar_run")
    node = start_node("lidar_live", "--frames", "12", "--points", "/points", "--color",
                      "/camera/color/image_raw", "--namespace", "robot")
    finish(start_partner("play", "lidar.mcap", "receive", "lidar", "topics",
                         "/robot/mms_slam/odometry=nav_msgs/Odometry", "expect", "12"),
           "the partner with a LiDAR")
    finish(node, "the node with a LiDAR")
    for name in ("trajectory.tum", "static_map.ply"):
        check(Path("lidar_live", name).read_bytes() == Path("lidar_run", name).read_bytes(),
              f"{name} of the LiDAR differs from that of mms run")
    print("ok: 12 poses and the map of a LiDAR with a camera are those of mms run")


def check_map():
    """The pose in an earlier map is published once its place is recognized."""
    frames = 80
    run_mms("convert", f"sim:warehouse_loop?frames={frames}&width=320", "-o", "long.mcap")
    run_mms("run", "long.mcap", "--segmenter", "masks", "--save-map", "x.mmsmap", "-o", "long")
    node = start_node("in_map", "--frames", str(frames), "--map", "x.mmsmap", "--localise")
    finish(start_partner("play", "long.mcap", "receive", "in_map_tf", "topics",
                         "/tf=tf2_msgs/TFMessage", "expect", str(frames)),
           "the partner of a node with a map")
    finish(node, "the node with a map")
    samples = sorted(Path("in_map_tf").glob("_tf.*.cdr"), key=lambda p: int(p.name.split(".")[1]))
    transforms = [struct.unpack_from("<I", sample.read_bytes(), 4)[0] for sample in samples]
    known = transforms.index(2) if 2 in transforms else None
    check(known and transforms == [1] * known + [2] * (frames - known),
          f"numbers of transforms: {transforms}")
    print(f"ok: the pose in the map is known from frame {known} on")


def check_decoded():
    """By other libraries than ours."""
    installed = subprocess.run([READERS / "install.sh", WORK], stdout=subprocess.PIPE, text=True)
    if installed.returncode == 77:
        print(f"not decoded by the libraries of Foxglove, {installed.stdout.strip()}")
        return
    check(installed.returncode == 0, "the packages of Node cannot be installed")
    topics = ",".join(f"{topic}={kind}" for topic, kind in TOPICS.items())
    result = subprocess.run(
        ["node", READERS / "decode_samples.mjs", Path(WORK) / "node_modules", "received", topics,
         "x.mcap", "run/run.mcap"], stdout=subprocess.PIPE, text=True)
    check(result.returncode == 0, "a message is not what the libraries of Foxglove expect")
    last = {}
    for line in result.stdout.splitlines():
        decoded = json.loads(line)
        last[decoded["topic"]] = decoded["last"]
    check(last.keys() == TOPICS.keys(), f"decoded: {list(last)}")
    odometry = last["/mms_slam/odometry"]
    check(odometry["header"]["frame_id"] == "mms_world", f"odometry: {odometry['header']}")
    check(odometry["child_frame_id"] == "camera_color_optical_frame", "child of the odometry")
    pose = [float(number) for number in poses("run")[-1].split()]
    position = odometry["pose"]["pose"]["position"]
    check(all(abs(position[axis] - pose[1 + i]) < 1e-6 for i, axis in enumerate("xyz")),
          f"the last odometry is {position}, the last pose {pose}")
    sensor, world = last["/tf"]["transforms"]
    check(sensor["header"]["frame_id"] == world["child_frame_id"] == "mms_world", f"/tf: {sensor}")
    check(sensor["child_frame_id"] == "camera_color_optical_frame", f"/tf: {sensor}")
    check(world["header"]["frame_id"] == "map", f"/tf: {world}")
    rotation = [world["transform"]["rotation"][axis] for axis in "xyzw"]
    check(all(abs(abs(value) - 0.5) < 1e-6 for value in rotation), f"map is not level: {rotation}")
    check(last["/mms_slam/map"]["width"] > 1000, "points of the map")
    check(last["/mms_slam/objects"]["objects"], "objects of the last frame")
    names = [status["name"] for status in last["/diagnostics"]["status"]]
    check("/mms_slam: inputs" in names, f"diagnostics: {names}")
    print(f"ok: the libraries of Foxglove decode {', '.join(last)}")


def endpoints(folder):
    """The lines of graph.txt as (kind, topic) -> (type, qos, identifier, user data)."""
    found = {}
    participants = []
    for line in Path(folder, "graph.txt").read_text().splitlines():
        words = line.split(" ")
        if words[0] == "participant":
            participants.append(words[1])
        else:
            found[words[0], words[1]] = (words[2], words[3:5], words[5], " ".join(words[6:]))
    return participants, found


def check_graph(folder, distro):
    """What ros2 node list, ros2 topic list and ros2 topic info --verbose read."""
    participants, found = endpoints(folder)
    check("enclave=/;" in participants, f"user data of the participants: {participants}")
    for topic, number in HASHES.items():
        kind, qos, _, data = found["writer", topic]
        expected = "" if distro == "humble" else f"typehash=RIHS01_{number};"
        check(data == expected, f"user data of {topic}: {data}")
        check(qos[0] == "reliable", f"{topic} is {qos}")
    check(found["writer", "rt/mms_slam/map"][1][1] == "transient_local", "durability of the map")
    check(found["writer", "rt/mms_slam/odometry"][0] == "nav_msgs::msg::dds_::Odometry_", "type")
    check(found["reader", "rt/camera/color/image_raw"][0] == "sensor_msgs::msg::dds_::Image_",
          "type of the color images")
    size = 24 if distro == "humble" else 16
    info = max(Path(folder).glob("ros_discovery_info.*.cdr"),
               key=lambda file: int(file.name.split(".")[1])).read_bytes()
    names = re.findall(rb"mms_slam\0", info)
    check(b"mms_slam\0" in names, f"no name of the node in {info[:80]}")
    at = info.index(b"mms_slam\0") + len(b"mms_slam\0")
    at += -(at - 4) % 4
    listed = []
    for _ in range(2):  # readers, writers
        count = struct.unpack_from("<I", info, at)[0]
        at += 4
        listed += [info[at + i * size:at + i * size + 16] for i in range(count)]
        at += count * size
    check(at <= len(info) < at + 4, f"{len(info)} bytes of discovery, expected {at}")
    for key, (_, _, identifier, _) in found.items():
        if key[1].startswith("rt/"):
            raw = bytes(int(byte, 16) for byte in identifier.strip(".").split("."))
            check(raw in listed, f"{key} is not one of the node's in ros_discovery_info")
    print(f"ok: the graph of {distro} has the node with {len(listed)} endpoints")


def check_discovery():
    discovery = "ros_discovery_info=rmw_dds_common/ParticipantEntitiesInfo"
    for distro in ("humble", "jazzy"):
        node = start_node("none_" + distro, "--ros-distro", distro)
        folder = "graph_" + distro
        finish(start_partner("receive", folder, "topics", discovery, "expect", "1", "call",
                             "/mms_slam/save_map"), "a call without frames")
        check_graph(folder, distro)
        node.send_signal(signal.SIGINT)
        finish(node, "a node without frames", 130)
        check(not Path("none_" + distro).exists(), "results without frames")


def check_settings():
    """A wrong setting is an error before any frame."""
    Path("taken").mkdir()
    Path("taken", "x").write_text("")
    for words, message in ((("--set", "mapping.nothing=1"), "mapping.nothing"),
                           (("--config", "none.yaml"), "none.yaml"),
                           (("--weights", "none.safetensors"), "none.safetensors"),
                           (("--weights", "small"), "small"),
                           (("--map", "none.mmsmap"), "none.mmsmap"),
                           (("--localize",), "--localize"),
                           (("-o", "taken"), "taken")):
        result = subprocess.run([MMS, "ros2", *words], capture_output=True, text=True, timeout=WAIT,
                                check=False)
        check(result.returncode == 1 and message in result.stderr, f"{words}: {result.stderr}")
    print("ok: wrong settings are errors before any frame")


def check_restart():
    """A partner is killed and another one starts; the service works; Ctrl-C writes the results."""
    node = start_node("restarted", "--realtime", "--save-folder", "saved")
    odometry = "/mms_slam/odometry=nav_msgs/Odometry"
    first = start_partner("play", "x.mcap", "receive", "first", "topics", odometry)
    wait_for(lambda: len(list(Path("first").glob("*.cdr"))) >= 5, "frames of the first partner")
    first.kill()
    first.communicate()
    second = start_partner("play", "x.mcap", "skip", "0.9", "receive", "second", "topics",
                           odometry, "expect", "5", "call", "/mms_slam/save_map")
    output = finish(second, "the second partner")
    check("reply: success 1" in output and "points" in output, f"save_map: {output}")
    for name in ("static_map.ply", "trajectory.tum", "trajectory_map.tum", "map.pgm"):
        check(Path("saved", name).exists(), f"{name} of a saved map")
    node.send_signal(signal.SIGINT)
    finish(node, "the interrupted node")
    stamps = [float(line.split()[0]) for line in poses("restarted")]
    check(stamps == sorted(set(stamps)), f"stamps: {stamps}")
    check(stamps[-1] > 0.9, f"the last stamp is {stamps[-1]}")
    for name in ("static_map.ply", "report.html", "metrics.json"):
        check(Path("restarted", name).exists(), f"{name} after Ctrl-C")
    print(f"ok: {len(stamps)} poses with a partner that was killed, up to {stamps[-1]} s")


def check_next_runs():
    """A run with frames is reset, and the next one goes on in a map. After check_map."""
    node = start_node("runs", "--save-map", "runs.mmsmap")
    odometry = ("topics", "/mms_slam/odometry=nav_msgs/Odometry")

    def call(service, name, *words):
        return finish(start_partner("receive", name, *odometry, "call", "/mms_slam/" + service,
                                    *words), service)

    finish(start_partner("play", "x.mcap", "receive", "runs_1", *odometry, "expect", "20"),
           "the partner of the first run")
    for name, content, result in (("none.mmsmap", None, 1), ("x" * 300, None, 1),
                                  ("text.mmsmap", "text", 2)):
        if content:
            Path(name).write_text(content)
        output = call("load_map", "refused", "map", os.path.abspath(name))
        check(f"reply: result {result}" in output, f"load_map of {name}: {output}")
    output = call("reset", "reset")
    check("reply: success 1" in output, f"reset: {output}")
    wait_for(Path("runs.mmsmap").exists, "the map of the first run")
    wait_for(lambda: Path("runs.log").read_text().count("waits for frames") == 2, "the next run")
    output = call("load_map", "load", "map", "file://" + os.path.abspath("x.mmsmap"))
    check("reply: result 0" in output, f"load_map: {output}")
    wait_for(lambda: Path("runs.log").read_text().count("waits for frames") == 3, "the third run")
    finish(start_partner("play", "long.mcap", "receive", "runs_3", *odometry, "expect", "40"),
           "the partner of the third run")
    node.send_signal(signal.SIGINT)
    finish(node, "the node with three runs")
    for folder, saved in (("runs", "runs.mmsmap"), ("runs_2", "runs_2.mmsmap")):
        check(len(poses(folder)) >= 20, f"poses in {folder}")
        check(Path(saved).exists(), saved)
    in_map = subprocess.run([MMS, "info", "runs_2.mmsmap"], capture_output=True, text=True,
                            check=True).stdout
    check("2 sessions" in in_map, f"the map of the third run: {in_map}")
    print("ok: after ~/reset and ~/load_map the next runs begin, and all results are kept")


def check_clock_back():
    """Where another recording begins with earlier stamps, so does another run. After check_map."""
    node = start_node("again")
    for recording, count in (("x.mcap", "20"), ("long.mcap", "10")):
        finish(start_partner("play", recording, "receive", "again_" + recording,
                             "topics", "/mms_slam/odometry=nav_msgs/Odometry", "expect", count),
               "the partner with " + recording)
    node.send_signal(signal.SIGINT)
    finish(node, "the node with stamps that went back")
    log = Path("again.log").read_text()
    check("the clock went back: another run begins" in log, f"the log: {log}")
    for folder, count in (("again", 20), ("again_2", 5)):
        check(len(poses(folder)) >= count, f"poses in {folder}")
    print("ok: where the clock goes back, the run ends with its results and another one begins")


run_mms("convert", f"sim:warehouse_loop?frames={FRAMES}&width=320", "-o", "x.mcap")
run_mms("run", "x.mcap", "--segmenter", "masks", "--mcap", "-o", "run")
check_same_results()
check_lidar()
check_map()
check_decoded()
check_discovery()
check_restart()
check_next_runs()
check_clock_back()
check_settings()
