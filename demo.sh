#!/usr/bin/env bash
# Installs what is missing, builds, and drives through a simulated warehouse with people and vehicles in it, which the
# network has to find. Prints accuracy and speed against the exact truth.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source .ci/setup.sh

install_packages
build mms_program
build/release/mms run sim:warehouse_loop --frames 450
echo
echo "Open $PWD/results/latest/report.html in a browser (its pictures are in results/latest/pictures),"
echo "and $PWD/results/latest/static_map.ply in a viewer of point clouds,"
echo "or play the whole run in a browser: build/release/mms view results/latest"
echo "Your own recording: build/release/mms run FOLDER"
