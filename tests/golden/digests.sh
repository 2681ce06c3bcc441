#!/usr/bin/env bash
# Prints a SHA-256 digest of the results of short runs: trajectory, static map, tracked objects,
# per-frame states and occupancy grid, one line per run. A refactoring keeps every line.
# usage: tests/golden/digests.sh PROGRAM [DATA]
#   PROGRAM  the mms program
#   DATA     folder of recordings (rgbd/ and lidar/ below it); without it, only simulated scenes
# GOLDEN_ONLY=REGEX selects the runs with a matching name.
set -euo pipefail
mms="$(realpath "${1:?path of the mms program}")"
data="${2:-}"
out="$(mktemp -d)"
trap 'rm -rf "$out"' EXIT

# Names of JSON keys and columns may change, values may not. The session of a frame came later.
values_of_json() { sed -E 's/"[A-Za-z0-9_]+"[[:space:]]*://g' "$1"; }
values_of_table() { tail -n +2 "$1" | cut -d, -f1-6; }

# Comments say the frame of the points.
points_of_ply() { LC_ALL=C sed '1,/^end_header$/{/^comment /d}' "$1"; }

digest() { sha256sum | cut -c1-16; }

# The default weights change with each training, these stay.
nano="$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../weights/nano.safetensors")"

# row NAME RECORDING FLAGS...
row() {
  local name="$1" recording="$2"
  shift 2
  [[ "$*" != *"--segmenter network"* ]] || set -- "$@" --weights "$nano"
  [[ "$name" =~ ${GOLDEN_ONLY:-.} ]] || return 0
  if ! "$mms" run "$recording" -o "$out/run" "$@" > "$out/log" 2>&1; then
    cat "$out/log" >&2
    echo "$name failed"
    return 1
  fi
  printf '%s %s %s %s %s %s\n' "$name" \
    "$(digest < "$out/run/trajectory.tum")" "$(points_of_ply "$out/run/static_map.ply" | digest)" \
    "$(values_of_json "$out/run/objects.json" | digest)" \
    "$(values_of_table "$out/run/frames.csv" | digest)" "$(digest < "$out/run/map.pgm")"
  rm -rf "$out/run"
}

echo "# run trajectory static_map objects frames grid"
for scene in warehouse_loop still_walker crowd stop_and_go corridor static fast rack_aisle; do
  for segmenter in network masks none; do
    row "$scene-$segmenter" "sim:$scene?frames=24" --segmenter "$segmenter" --threads 2
  done
done
for fusion in vision none; do
  row "crowd-masks-$fusion" "sim:crowd?frames=24" --segmenter masks --fusion "$fusion" --threads 2
done
row crowd-network-1-thread "sim:crowd?frames=24" --segmenter network --threads 1
row stop_and_go-imperfect "sim:stop_and_go?frames=60&mask_errors.enabled=true" --segmenter masks
for sensor in lidar16 lidar64 livox; do
  row "warehouse_loop-$sensor" "sim:warehouse_loop?sensor=$sensor&frames=12" --threads 2
done
row warehouse_loop-lidar16-none "sim:warehouse_loop?sensor=lidar16&frames=12" --segmenter none \
  --threads 2
row warehouse_loop-lidar16-1-thread "sim:warehouse_loop?sensor=lidar16&frames=12" --threads 1
[ -n "$data" ] || exit 0
for recording in fr1_xyz_clip lab_crowd desk_crowd; do
  for segmenter in network masks none; do
    [ "$segmenter" = masks ] && [ ! -d "$data/rgbd/$recording/masks" ] && continue
    row "$recording-$segmenter" "$data/rgbd/$recording" --segmenter "$segmenter" --frames 40
  done
done
row lab_crowd-network-1-thread "$data/rgbd/lab_crowd" --segmenter network --frames 40 --threads 1
row kitti00_6scans "$data/lidar/kitti00_6scans"
