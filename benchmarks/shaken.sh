#!/usr/bin/env bash
# Recordings that are shaken (mms_shake_recording: roll to 45 degrees, motion blur along the true
# optical flow, underexposure), with the filter and without it.
# usage: benchmarks/shaken.sh DATA/rgbd [FLAGS FOR mms run WITH FILTER]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
data="${1:?folder with fr1_xyz_clip, desk_crowd and lab_crowd}"
shift
shake="$(tool mms_shake_recording)"
mkdir "$out/shaken"
# 75 frames a swing, up to 3.8 degrees a frame.
quietly "$shake" "$data/fr1_xyz_clip" "$out/shaken/fr1_xyz_clip" 2.5
quietly "$shake" "$data/desk_crowd" "$out/shaken/desk_crowd" 5
quietly "$shake" "$data/lab_crowd" "$out/shaken/lab_crowd" 15
SCENES=" " "$(dirname "${BASH_SOURCE[0]}")/filter_gain.sh" "1" "$out/shaken" "$@"
