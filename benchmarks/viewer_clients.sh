#!/usr/bin/env bash
# What viewers cost a run: milliseconds per frame and memory without --view, with it and nobody
# looking, with one viewer, and with a crowd that comes and goes and sends garbage. The kinds take
# turns, so that what else the machine does falls on all of them; the median run of each counts, and
# the range says how far the machine itself is to be trusted.
# Clients run at the lowest priority, as if they were on other machines.
# usage: benchmarks/viewer_clients.sh [DATA=a simulated scene] [ROUNDS=3] [CLIENTS=20] [FLAGS FOR mms run]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/rows.sh"
crowd="$(dirname "$mms")/tests/viewer_crowd"
data="${1:-}"
rounds="${2:-3}"
clients="${3:-20}"
shift $(($# > 3 ? 3 : $#))
port=8471

if [ -z "$data" ]; then
  data="$out/data"
  quietly "$mms" simulate warehouse_loop --frames 450 -o "$data"
fi

# run KIND CLIENTS FLAGS...: one run with so many clients, as a line "KIND ms MiB".
run() {
  local kind="$1" number="$2"
  shift 2
  if [ "$number" -gt 0 ]; then
    nice -n 19 timeout 600 "$crowd" "$port" "$number" 600 > /dev/null 2>&1 &
    local visitors=$!
  fi
  quietly "$mms" run "$data" -o "$out/run" "$@"
  if [ "$number" -gt 0 ]; then
    kill "$visitors"
    wait "$visitors" 2> /dev/null || true
  fi
  echo "$kind $(value "$out/run/metrics.json" mean ms_per_frame) $(value "$out/run/metrics.json" peak_rss_mb)" |
    tee -a "$out/rows" >&2
}

for ((i = 0; i < rounds; ++i)); do
  run alone 0 "$@"
  run nobody 0 --view "$port" "$@"
  run one 1 --view "$port" "$@"
  run crowd "$clients" --view "$port" "$@"
done

# sorted KIND COLUMN
sorted() {
  awk -v kind="$1" -v column="$2" '$1 == kind { print $column }' "$out/rows" | sort -g
}
least() { sorted "$@" | head -n 1; }
most() { sorted "$@" | tail -n 1; }
median() { sorted "$@" | awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'; }

echo "| viewers | ms per frame, median | least to most | against none | MiB |"
echo "| --- | --- | --- | --- | --- |"
alone="$(median alone 2)"
for kind in alone nobody one crowd; do
  awk -v kind="$kind" -v ms="$(median $kind 2)" -v least="$(least $kind 2)" -v most="$(most $kind 2)" \
    -v alone="$alone" -v mib="$(most $kind 3)" -v n="$clients" '
    BEGIN { name["alone"] = "no --view"; name["nobody"] = "--view, nobody looks"
            name["one"] = "one"; name["crowd"] = n " that come, go and send garbage"
            printf "| %s | %.1f | %.1f to %.1f | %+.0f %% | %.0f |\n", name[kind], ms, least, most,
                   100 * (ms / alone - 1), mib }'
done
