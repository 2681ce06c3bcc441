# shellcheck shell=bash
# Sourced by the scripts beside it: the program, a folder for its results, and rows of tables.
mms="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)/build/release/mms"
out="$(mktemp -d)"
trap 'rm -rf "$out"' EXIT

# value FILE KEY [PATTERN]: the first number behind "KEY" in a JSON file, after PATTERN where given;
# nan where there is none.
value() {
  sed -n "/${3:-.}/,\$p" "$1" | grep -m1 "\"$2\"" | grep -oE '[0-9.eE+-]+,?$' | tr -d , || echo nan
}

# cm FILE KEY: the same of a length in metres, in centimetres.
cm() { awk -v metres="$(value "$1" "$2")" 'BEGIN { print 100 * metres }'; }

# quietly COMMAND...: shows what it says only when it fails.
quietly() { "$@" > "$out/log" 2>&1 || { cat "$out/log"; return 1; }; }
