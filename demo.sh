#!/usr/bin/env bash
# Installs missing packages, builds, and runs a simulated warehouse with people and vehicles, which
# the network has to find. Prints accuracy and speed against exact ground truth.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source .ci/setup.sh

# Minutes of a first build on two cores; docs/results.md says how it was measured.
readonly build_minutes=8
readonly mms=build/demo/mms

echo "This demo takes three steps:"
echo "  1. install the missing packages of the group [demo] of packages.txt (1 minute if all are missing)"
echo "  2. build $mms (about $build_minutes minutes on two cores the first time, seconds afterwards)"
echo "  3. run it on 450 frames of a simulated warehouse (1 minute)"

echo "Step 1 of 3: packages"
install_packages demo
echo "Step 2 of 3: build"
build demo
echo "Step 3 of 3: run"
"$mms" run sim:warehouse_loop --frames 450
echo
echo "Open $PWD/results/latest/report.html in a browser (its images are in results/latest/pictures),"
echo "and $PWD/results/latest/static_map.ply in a point cloud viewer,"
echo "or play the whole run in a browser: $mms view results/latest"
echo "For your own recording: $mms run FOLDER"
