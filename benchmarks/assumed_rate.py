#!/usr/bin/env python3
"""How far a wrong rate of a recording without time stamps moves the poses.

usage: benchmarks/assumed_rate.py DATA...
  DATA  recordings in the TUM layout with ground truth, as in docs/formats.md; DATA:4 takes every
        fourth frame
Each is played without its stamps, at three assumed rates; the poses are compared at the true stamps.
MMS=... chooses another program.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

RATES = (30, 15, 8)  # [Hz]
MAX_DIFFERENCE = 0.02  # [s] between the stamps of color and depth
MMS = os.environ.get("MMS", str(Path(__file__).resolve().parents[1] / "build/release/mms"))


def read_list(file):
    lines = [line.split() for line in file.read_text().splitlines()]
    return [(float(line[0]), line[1]) for line in lines if line and not line[0].startswith("#")]


def link_frames(data, every, folder):
    """Links to numbered images; the stamps of the frames."""
    depths = read_list(data / "depth.txt")
    pairs = []
    for stamp, color in read_list(data / "rgb.txt"):
        depth = min(depths, key=lambda entry: abs(entry[0] - stamp))
        if abs(depth[0] - stamp) <= MAX_DIFFERENCE:
            depths.remove(depth)
            pairs.append((stamp, color, depth[1]))
    pairs = pairs[::every]
    for kind, column in (("rgb", 1), ("depth", 2)):
        (folder / kind).mkdir(parents=True)
        for number, pair in enumerate(pairs):
            image = (data / pair[column]).resolve()
            (folder / kind / f"{number:06}{image.suffix}").symlink_to(image)
    return [pair[0] for pair in pairs]


def run(data, folder, rate, results):
    words = [MMS, "run", folder, "--rate", rate, "--threads", 1, "-q", "-o", results]
    if (data / "calibration.yaml").exists():
        words += ["--calibration", data / "calibration.yaml"]
    done = subprocess.run([str(word) for word in words], check=False, stderr=subprocess.PIPE)
    if done.returncode != 0:
        sys.exit(done.stderr.decode())


def error_of(data, stamps, results):
    """ATE [cm] with the poses at their true stamps."""
    indices = [int(line.split(",")[1])
               for line in (results / "frames.csv").read_text().splitlines()[1:]]
    poses = [line.split(maxsplit=1)[1]
             for line in (results / "trajectory.tum").read_text().splitlines()
             if not line.startswith("#")]
    timed = results / "timed.tum"
    timed.write_text("".join(f"{stamps[i]:.9f} {pose}\n" for i, pose in zip(indices, poses)))
    text = subprocess.run([MMS, "eval", "trajectory", "--json", str(data / "groundtruth.txt"),
                           str(timed)], check=True, capture_output=True, text=True).stdout
    return 100.0 * json.loads(text)["ate_rmse_m"]


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    rates = " / ".join(map(str, RATES))
    print(f"| recording | true rate [Hz] | ATE at {rates} Hz [cm] | lost frames |")
    print("| --- | --- | --- | --- |")
    for word in sys.argv[1:]:
        name, _, every = word.partition(":")
        data = Path(name).resolve()
        errors, losses = [], []
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary) / "images"
            stamps = link_frames(data, int(every or 1), folder)
            for rate in RATES:
                results = Path(temporary) / f"run{rate}"
                run(data, folder, rate, results)
                metrics = json.loads((results / "metrics.json").read_text())
                errors.append(f"{error_of(data, stamps, results):.2f}")
                losses.append(str(metrics["status"]["lost"]))
        true_rate = (len(stamps) - 1) / (stamps[-1] - stamps[0])
        print(f"| `{data.name}`{', every ' + every if every else ''} | {true_rate:.1f} "
              f"| {' / '.join(errors)} | {' / '.join(losses)} of {len(stamps)} |", flush=True)


if __name__ == "__main__":
    main()
