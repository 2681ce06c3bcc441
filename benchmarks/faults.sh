#!/usr/bin/env bash
# Runs the program under faults and prints a row for each kind: how many cases, how many survived, and
# how many left something lost or broken.
#   survived  the program ended by itself, with status 0 or an error message and status 1, 2 or 130;
#             killed ones were killed by us
#   lost      a result that is named as complete differs from that of a run without fault, a temporary
#             file is left over (but after kill -9), or frames before the fault cannot be recovered
# usage: benchmarks/faults.sh [N=20] [SEED=1]      (N cases of each kind; MMS=PROGRAM for another one)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
cases="${1:-20}"
RANDOM="${2:-1}"
shim="${SHIM:-$(dirname "$mms")/tests/libmms_failing_io.so}"
[ -f "$shim" ] || { echo "$shim is missing: build the target mms_failing_io" >&2; exit 1; }
cd "$out"
scene="sim:corridor?frames=8&width=320"
run=(run "$scene" --segmenter none --threads 1)

quietly "$mms" "${run[@]}" -o whole
quietly "$mms" convert "$scene" -o whole.bag
quietly "$mms" simulate corridor --frames 8 --set width=320 -o recording
readonly results=(trajectory.tum static_map.ply objects.json keyframes.tum)

# status_ok STATUS: whether the program ended by itself, with a message if it failed.
status_ok() {
  case "$1" in
    0) true ;;
    1 | 2 | 130) grep -q '^mms: ' err ;;
    127) grep -q 'error while loading shared libraries' err ;;  # too little memory to start
    *) false ;;
  esac
}

no_temporary_files() { ! find . -name '*.tmp[0-9]*' | grep -q .; }

# run_ok STATUS: whether the folder run has what its status promises.
run_ok() {
  local file
  for file in "${results[@]}"; do
    [ ! -e "run/$file" ] || cmp -s "run/$file" "whole/$file" || { echo "run/$file differs" >> faults; return 1; }
  done
  [ "$1" -ne 0 ] || [ -e run/run.json ] || { echo "run.json is missing" >> faults; return 1; }
}

# recovered: whether a journal that is left can be read, and has a prefix of the poses.
recovered() {
  [ -s run/journal.bin ] || return 0
  rm -rf recovered
  "$mms" convert run -o recovered > convert_log 2>&1 || { grep -qE 'has no complete frame|is truncated|is empty|is not a journal|incomplete|ends' convert_log; return; }
  cmp -s -n "$(stat -c %s recovered/trajectory.tum)" recovered/trajectory.tum whole/trajectory.tum
}

bag_ok() { [ ! -e x.bag ] || cmp -s x.bag whole.bag; }

# one KIND COMMAND...: a case; CHECK names what must hold after it.
tries=0 survived=0 lost=0
one() {
  local status=0
  rm -rf run run_2 x.bag x.partial* data
  "$@" > log 2> err || status=$?
  tries=$((tries + 1))
  if [ "$killed" = yes ] || status_ok "$status"; then
    survived=$((survived + 1))
  else
    { echo "status $status of: $*"; tail -n 3 err; } >> faults
  fi
  if { [ "$killed" = yes ] || no_temporary_files; } && "$check" "$status" && recovered; then :; else
    lost=$((lost + 1))
    echo "lost after status $status of: $* ($(env | grep -a ^MMS_FAIL | paste -sd' '))" >> faults
  fi
}

row() {
  echo "| $1 | $tries | $survived | $lost |"
  all=$((all + tries)) bad=$((bad + tries - survived + lost))
  tries=0 survived=0 lost=0
}
all=0 bad=0
touch faults

failing() { env "LD_PRELOAD=$shim" "MMS_FAIL=$1" "MMS_FAIL_AT=$2" "MMS_FAIL_ERRNO=$3" "${@:4}"; }
killing() { timeout -s KILL "$1" "${@:2}"; }
limited() { (ulimit -v "$1" && "${@:2}"); }

echo "| fault | cases | survived | lost |"
echo "| --- | --- | --- | --- |"
killed=no
for kind in "write 28 ENOSPC" "write 5 EIO" "short 0 short" "open 24 EMFILE" "open 13 EACCES"; do
  read -r call error name <<< "$kind"
  [ "$call" = short ] && export MMS_FAIL_COUNT=1000 || unset MMS_FAIL_COUNT  # one byte each is slow
  check=run_ok
  for ((i = 1; i <= cases; ++i)); do
    one failing "$call" "$i" "$error" "$mms" "${run[@]}" -o run
  done
  row "\`mms run\`, $name from the n-th $call on"
  check=bag_ok
  for ((i = 1; i <= cases; ++i)); do
    one failing "$call" "$i" "$error" "$mms" convert "$scene" -o x.bag
  done
  row "\`mms convert\`, $name from the n-th $call on"
done

export MMS_FAIL_COUNT=1
check=run_ok
for ((i = 1; i <= cases; ++i)); do
  one failing write "$i" 28 "$mms" "${run[@]}" -o run
done
row "\`mms run\`, ENOSPC of the n-th write alone"
unset MMS_FAIL_COUNT

check=run_ok
for ((i = 0; i < cases; ++i)); do
  one limited $((200000 + 1800000 * i / cases)) "$mms" "${run[@]}" -o run
done
row "\`mms run\`, memory limits from 0.2 to 2 GB"

killed=yes
# part SECONDS: a random part of a time.
part() { awk -v seconds="$1" -v r="$RANDOM" 'BEGIN { printf "%.3f", 0.02 + seconds * r / 32768 }'; }
# seconds COMMAND...: its time.
seconds() { local from="$EPOCHREALTIME"; "$@" > log 2>&1; awk -v a="$from" -v b="$EPOCHREALTIME" 'BEGIN { print b - a }'; }

rm -rf run x.bag
time_of_run="$(seconds "$mms" "${run[@]}" -o run)"
check=run_ok
for ((i = 0; i < cases; ++i)); do one killing "$(part "$time_of_run")" "$mms" "${run[@]}" -o run; done
row "\`mms run\`, kill -9 at a random instant"
time_of_convert="$(seconds "$mms" convert "$scene" -o x.bag)"
check=bag_ok
for ((i = 0; i < cases; ++i)); do one killing "$(part "$time_of_convert")" "$mms" convert "$scene" -o x.bag; done
row "\`mms convert\`, kill -9 at a random instant"
# A killed simulation can be made again in the same folder.
simulation_ok() { [ ! -e data/scene.yaml ] || quietly "$mms" simulate corridor --frames 2 --set width=320 -o data --overwrite; }
check=simulation_ok
time_of_simulate="$(seconds "$mms" simulate corridor --frames 8 --set width=320 -o data)"
for ((i = 0; i < cases; ++i)); do
  one killing "$(part "$time_of_simulate")" "$mms" simulate corridor --frames 8 --set width=320 -o data
done
row "\`mms simulate\`, kill -9 at a random instant"

# Maps: whatever happens, the file is the old map or a whole new one.
scene="sim:warehouse_loop?frames=20&width=320"
run=(run "$scene&seed=3" --segmenter none --threads 1 -o run)
quietly "$mms" run "$scene" --segmenter none -o first --save-map old.mmsmap
rm -rf run
quietly "$mms" run "$scene&seed=2" --segmenter none -o other --save-map other.mmsmap
recovered() { [ ! -s run/journal.bin ] || quietly "$mms" convert run -o recovered --overwrite; }
# map_ok STATUS: after success, the map is the new one.
map_ok() {
  "$mms" map check map.mmsmap > check_log 2>&1 || { cat check_log >> faults; return 1; }
  [ "$1" -ne 0 ] || ! cmp -s old.mmsmap map.mmsmap
}
check=map_ok
# with_map COMMAND...: a case with the old map in the place of the new one.
with_map() { rm -f map.mmsmap* && cp old.mmsmap map.mmsmap && one "$@"; }
# killing_after FILE SECONDS COMMAND...: kills it that long after the file has appeared.
killing_after() {
  "${@:3}" &
  local command=$!
  until [ -e "$1" ] || ! kill -0 "$command" 2> /dev/null; do sleep 0.002; done
  sleep "$2"
  kill -KILL "$command" 2> /dev/null || true
  wait "$command"
}
# seconds_after FILE COMMAND...: its time since the file has appeared.
seconds_after() {
  "${@:2}" > log 2>&1 &
  local command=$! from
  until [ -e "$1" ]; do sleep 0.002; done
  from="$EPOCHREALTIME"
  wait "$command"
  awk -v a="$from" -v b="$EPOCHREALTIME" 'BEGIN { print b - a }'
}

export MMS_FAIL_FILE=.mmsmap
for way in "--save-map map.mmsmap --overwrite" "--map map.mmsmap"; do
  read -ra words <<< "$way"
  killed=no
  for kind in "write 28 ENOSPC" "write 5 EIO" "short 0 short"; do
    read -r call error name <<< "$kind"
    [ "$call" = short ] && export MMS_FAIL_COUNT=1000 || unset MMS_FAIL_COUNT
    for ((i = 1; i <= cases; ++i)); do
      with_map failing "$call" "$i" "$error" "$mms" "${run[@]}" "${words[@]}"
    done
    row "\`mms run ${words[0]}\`, $name from the n-th write to the map on"
  done
  killed=yes
  cp old.mmsmap map.mmsmap
  rm -rf run
  time_of_saving="$(seconds_after run/report.html "$mms" "${run[@]}" "${words[@]}")"
  for ((i = 0; i < cases; ++i)); do
    with_map killing_after run/report.html "$(part "$time_of_saving")" "$mms" "${run[@]}" "${words[@]}"
  done
  row "\`mms run ${words[0]}\`, kill -9 while it saves the map"
done
merge=(merge old.mmsmap other.mmsmap -o map.mmsmap --overwrite)
killed=no
for kind in "write 28 ENOSPC" "write 5 EIO" "short 0 short"; do
  read -r call error name <<< "$kind"
  [ "$call" = short ] && export MMS_FAIL_COUNT=1000 || unset MMS_FAIL_COUNT
  for ((i = 1; i <= cases; ++i)); do with_map failing "$call" "$i" "$error" "$mms" "${merge[@]}"; done
  row "\`mms merge\`, $name from the n-th write on"
done
killed=yes
time_of_merge="$(seconds "$mms" "${merge[@]}")"
for ((i = 0; i < cases; ++i)); do with_map killing "$(part "$time_of_merge")" "$mms" "${merge[@]}"; done
row "\`mms merge\`, kill -9 at a random instant"
unset MMS_FAIL_FILE MMS_FAIL_COUNT

# The same command goes on with a batch or a training that was killed.
recovered() { true; }
printf '"sim:corridor?frames=4&width=320&seed=%d" --segmenter none\n' 1 2 3 > list
time_of_batch="$(seconds "$mms" batch list -o whole_batch)"
batch_ok() { quietly "$mms" batch list -o batch && cmp -s batch/batch.csv whole_batch/batch.csv; }
check=batch_ok
for ((i = 0; i < cases; ++i)); do
  rm -rf batch
  one killing "$(part "$time_of_batch")" "$mms" batch list -o batch
done
row "\`mms batch\`, kill -9 at a random instant"
if [ -x "$(dirname "$mms")/mms-torch" ]; then
  quietly "$mms" simulate training-set -o training --images 4
  cat > train.yaml << 'END'
network: {long_side: 128, short_side: 96, head: {grid_density: 0.4, object_scale: 20}}
data: [{annotations: training/annotations.json}]
half_precision: false
schedule: {images: 8, batch: 2, warm_up: 2}
END
  time_of_training="$(seconds "$mms" train -c train.yaml -o whole_training)"
  training_ok() {
    quietly "$mms" train -c train.yaml -o trained &&
      quietly "$mms" segment training/images --weights trained/weights.safetensors -o segmented --overwrite
  }
  check=training_ok
  for ((i = 0; i < cases; ++i)); do
    rm -rf trained segmented
    one killing "$(part "$time_of_training")" "$mms" train -c train.yaml -o trained
  done
  row "\`mms train\`, kill -9 at a random instant"
fi

# Sensors: lists whose stamps stall, repeat, jump back or forward; images that are missing or cut.
killed=no
# sensor NAME PROGRAM OF AWK: changes the lines of rgb.txt.
sensor() {
  rm -rf faulty && cp -r recording faulty
  awk -v CONVFMT=%.9f -v OFMT=%.9f "$2" recording/rgb.txt > faulty/rgb.txt
  one "$mms" run faulty --segmenter none -o run
  row "sensor $1"
}
sensor_ok() { [ "$1" -ne 0 ] || [ -s run/trajectory.tum ]; }
recovered() { true; }
check=sensor_ok
sensor "stalls for 10 s" '/^#/ { print; next } { if (++n > 4) $1 += 10; print }'
sensor "repeats a frame" '{ print } !/^#/ && ++n == 4 { print }'
sensor "repeats stamps" '/^#/ { print; next } { if (++n == 5) $1 = last; last = $1; print }'
sensor "jumps back by 1 s" '/^#/ { print; next } { if (++n == 5) $1 -= 1; print }'
sensor "jumps forward by a year" '/^#/ { print; next } { if (++n > 4) $1 += 31536000; print }'
sensor "has no stamps" '/^#/ { print; next } { $1 = "nan"; print }'
sensor "misses half of its images" '/^#/ || ++n % 2 { print; next } { $2 = $2 ".missing"; print }'
cp -r recording cut
for image in cut/rgb/*.png; do truncate -s -100 "$image"; done
one "$mms" run cut --segmenter none -o run
row "sensor gives truncated images"

# Masks that are late, missing, damaged or absurd.
quietly "$mms" simulate warehouse_loop --frames 8 --set width=320 -o people
# mask FILE WIDTH HEIGHT LABEL: an image with that label everywhere, or "noise".
mask() {
  python3 - "$@" << 'END'
import random, struct, sys, zlib
width, height, label = int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
rows = [random.randbytes(width) if label == "noise" else bytes([int(label)]) * width for _ in range(height)]
chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
open(sys.argv[1], "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 0, 0, 0, 0)) +
                              chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows))) + chunk(b"IEND", b""))
END
}
# masks NAME COMMAND...: changes the masks FIRST SECOND ... of a copy of the recording.
masks() {
  rm -rf faulty && cp -r people faulty
  (cd faulty/masks && "${@:2}" *.png)
  one "$mms" run faulty --segmenter masks -o run
  row "masks $1"
}
each() { local file; for file in "${@:2}"; do $1 "$file"; done; }
late() { while [ $# -gt 1 ]; do cp "${@: -2:1}" "${@: -1}" && set -- "${@:1:$#-1}"; done; }
everywhere() { mask "$1" 320 240 1; }
noise() { mask "$1" 320 240 noise; }
small() { mask "$1" 7 5 1; }
large() { mask "$1" 5000 4000 1; }
unknown() { mask "$1" 320 240 200; }
cut() { truncate -s -40 "$1"; }
empty() { : > "$1"; }
masks "a frame late" late
masks "missing" each rm
masks "person everywhere" each everywhere
masks "of noise" each noise
masks "of 7x5 pixels" each small
masks "of 5000x4000 pixels" each large
masks "with unknown labels" each unknown
masks "truncated" each cut
masks "empty files" each empty

echo "| all | $all | $((all - bad)) without fault | $bad faults |"
[ "$bad" -eq 0 ] || { cat faults >&2; exit 1; }
