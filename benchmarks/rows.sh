# shellcheck shell=bash
# Sourced by the other scripts: path of the program (MMS=... chooses another), a folder for its results, and rows of tables.
mms="${MMS:-$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)/build/release/mms}"
out="$(mktemp -d)"
trap 'rm -rf "$out"' EXIT

# tool NAME: path of a program of the preset bench, or of one built beside mms.
tool() {
  local place
  for place in "$(dirname "$mms")" "$(dirname "$mms")/../bench"; do
    if [ -x "$place/benchmarks/$1" ]; then echo "$place/benchmarks/$1" && return; fi
  done
  echo "$1 is missing: cmake --preset bench && cmake --build --preset bench" >&2
  return 1
}

# value FILE KEY [PATTERN]: the first number of "KEY" in a JSON file, after PATTERN if given; nan if
# there is none.
value() {
  sed -n "/${3:-.}/,\$p" "$1" | grep -m1 -oE "\"$2\": ?[0-9.eE+-]+" | head -n 1 |
    grep -oE '[0-9.eE+-]+$' || echo nan
}

# cm FILE KEY: a length in meters, converted to centimeters.
cm() { awk -v meters="$(value "$1" "$2")" 'BEGIN { print 100 * meters }'; }

# ms FILE STATISTIC: mean, p50 or p99 of the time per frame, in milliseconds.
ms() { awk -v seconds="$(value "$1" "$2" time_per_frame_s)" 'BEGIN { print 1000 * seconds }'; }

# quietly COMMAND...: prints its output only if it fails. Without a terminal, so that --view ends.
quietly() { "$@" < /dev/null > "$out/log" 2>&1 || { cat "$out/log"; return 1; }; }

# cpu_of COMMAND...: user and system time of all threads [s].
cpu_of() {
  local TIMEFORMAT='%U %S'
  { time quietly "$@"; } 2> "$out/time"
  awk '{ print $1 + $2 }' "$out/time"
}
