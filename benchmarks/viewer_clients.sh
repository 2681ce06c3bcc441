#!/usr/bin/env bash
# Cost of many viewers for a run: milliseconds per frame and memory without --view, with --view and no
# viewer, with one viewer, and with many viewers that connect, disconnect and send invalid data. The
# run has all cores but the last, on which the clients run, as if on other machines. They still share
# caches and memory; as a reference the clients also use another server during a run without --view
# (elsewhere).
# The variants alternate, so that other load affects all of them; the result is the median of the
# ratios within a round.
# usage: benchmarks/viewer_clients.sh [DATA=a simulated scene] [ROUNDS=3] [CLIENTS=20] [FLAGS FOR mms run]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
crowd="$(dirname "$mms")/tests/viewer_crowd"
data="${1:-}"
rounds="${2:-3}"
clients="${3:-20}"
shift $(($# > 3 ? 3 : $#))
port=8471
last_core=$(($(nproc) - 1))
[ "$last_core" -gt 0 ] || { echo "two cores are required: one for the clients" >&2; exit 1; }

if [ -z "$data" ]; then
  data="$out/data"
  quietly "$mms" simulate warehouse_loop --frames 450 -o "$data"
fi
quietly "$mms" run "sim:warehouse_loop?frames=60" -o "$out/elsewhere" --segmenter none

# aside COMMAND...: runs in the background on the last core.
aside() { taskset -c "$last_core" timeout 600 "$@" > /dev/null 2>&1 & }

# run KIND CLIENTS FLAGS...: one run with CLIENTS clients, as a line "KIND ms MB".
run() {
  local kind="$1" number="$2" others=()
  shift 2
  if [ "$kind" = elsewhere ]; then
    aside "$mms" view "$out/elsewhere" --port $((port + 1))
    others+=($!)
    aside "$crowd" $((port + 1)) "$number" 600
    others+=($!)
  elif [ "$number" -gt 0 ]; then
    aside "$crowd" "$port" "$number" 600
    others+=($!)
  fi
  quietly taskset -c "0-$((last_core - 1))" "$mms" run "$data" -o "$out/run" --overwrite "$@"
  for other in "${others[@]}"; do
    kill "$other"
    wait "$other" 2> /dev/null || true
  done
  echo "$kind $(ms "$out/run/metrics.json" mean) $(value "$out/run/metrics.json" peak_memory_mb)" |
    tee -a "$out/rows" >&2
}

for ((i = 0; i < rounds; ++i)); do
  run alone 0 "$@"
  run nobody 0 --view "$port" "$@"
  run one 1 --view "$port" "$@"
  run crowd "$clients" --view "$port" "$@"
  run elsewhere "$clients" "$@"
done

# column KIND NUMBER
column() { awk -v kind="$1" -v number="$2" '$1 == kind { print $number }' "$out/rows"; }
median() { sort -g | awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'; }

# slower KIND BASE: slowdown relative to the other variant, in percent.
slower() {
  paste <(column "$1" 2) <(column "$2" 2) | awk '{ print 100 * ($1 / $2 - 1) }' | median |
    xargs printf '%+.0f %%'
}

# row KIND NAME
row() {
  printf '| %s | %.1f | %.1f to %.1f | %s | %s | %.0f |\n' "$2" "$(column "$1" 2 | median)" \
    "$(column "$1" 2 | sort -g | head -n 1)" "$(column "$1" 2 | sort -g | tail -n 1)" \
    "$(slower "$1" alone)" "$(slower "$1" elsewhere)" "$(column "$1" 3 | sort -g | tail -n 1)"
}

echo "| viewers | ms per frame, median | min to max | relative to none | relative to elsewhere | MB |"
echo "| --- | --- | --- | --- | --- | --- |"
row alone "no --view"
row elsewhere "no --view, $clients at another server"
row nobody "--view, no viewer"
row one "one"
row crowd "$clients that reconnect and send invalid data"
