#!/usr/bin/env bash
# Compares what the completions of bash and zsh offer with each other and with the help.
# usage: completion_test.sh PROGRAM SOURCE_DIR     (status 77: no zsh)
set -euo pipefail
PATH="$(dirname "$(realpath "$1")"):$PATH"
source="$2"
command -v zsh > /dev/null || { echo "skipped: no zsh"; exit 77; }

# shellcheck disable=SC1091
complete() { :; }  # sourced outside of an interactive shell
source "$source/packaging/mms.bash-completion"

# The functions of the zsh completion, without the call at its end.
functions="$(sed '/^_mms "/d' "$source/packaging/mms.zsh-completion")"
zsh_says() { zsh -fc "$functions"$'\n'"$*"; }

faults=0
compare() {
  if [ "$2" != "$3" ] || [ -z "$2" ]; then
    printf '%s differs\n bash: %s\n zsh:  %s\n' "$1" "$2" "$3"
    faults=$((faults + 1))
  fi
}
for line in "mms" "mms run" "mms eval" "mms eval map" "mms convert" "mms calibration"; do
  # shellcheck disable=SC2086
  compare "$line" "$(_mms_words $line | sort | xargs)" \
    "$(zsh_says "_mms_entries commands $line; _mms_entries options $line" | sed 's/:.*//' | sort | xargs)"
done
compare "--segmenter" "$(_mms_choices --segmenter mms run | xargs)" \
  "$(zsh_says "_mms_choices --segmenter mms run" | xargs)"
[ "$(zsh_says "_mms_entries commands mms" | grep -c '^run:Localize a recording')" = 1 ] ||
  { echo "run has no description"; faults=$((faults + 1)); }
exit "$faults"
