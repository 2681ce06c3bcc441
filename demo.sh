#!/usr/bin/env bash
# Installs what is missing, builds, and runs the main job on a simulated room with people in it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source .ci/setup.sh

install_packages
build mms_program
build/release/mms run
echo
echo "Open $PWD/results/latest/report.html in a browser,"
echo "and $PWD/results/latest/static_map.ply in a viewer of point clouds."
echo "Your own recording: build/release/mms run FOLDER"
