#!/usr/bin/env bash
# Writes the generated pages, cli.md and configuration.md, from what the program itself says.
# usage: docs/generate.sh [PROGRAM] [FOLDER]
#   PROGRAM  the mms program (default: build/release/mms)
#   FOLDER   where the pages go (default: this folder)
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
mms="$(realpath "${1:-$here/../build/release/mms}")"
folder="${2:-$here}"

# Subcommands of a command, from its help on stdin.
subcommands() {
  awk '/^Subcommands:/ {inside = 1; next} /^[^ ]/ {inside = 0} inside && /^  [a-z]/ {print $1}'
}

# section NAME...: help of a command and of those below it.
# shellcheck disable=SC2016  # the backquotes are Markdown
section() {
  local text name
  if ! text="$("$mms" "$@" --help 2> /dev/null)"; then
    # mms train needs a build with libtorch: without one its section stays as it is.
    printf '\n%s\n' "$(awk -v head="## mms $*" '/^## / {inside = $0 == head} inside' "$here/cli.md")"
    return
  fi
  printf '\n## %s\n\n```text\n%s\n```\n' "mms${*:+ $*}" "$text"
  for name in $(subcommands <<< "$text"); do section "$@" "$name"; done
}

cli() {
  cat << 'PAGE'
# Commands

For everyone who uses the program: all commands and options.
This page is written by `docs/generate.sh` from `mms --help`; do not edit it.
The [quickstart](quickstart.md) shows the common ones, [formats](formats.md) the files.

A command ends with 0 when it did its work, 1 for bad input, 2 for wrong usage, 130 when it was
interrupted.
PAGE
  section
}

# Tables of settings, one a group, from documented YAML on stdin: `key: value  # doc [unit], range`.
tables() {
  awk -v top="$1" '
    function escaped(text) { gsub(/\|/, "\\|", text); return text }
    function open(name, doc) { order[++sections] = name; docs[name] = doc }
    BEGIN { open(top, "") }
    match($0, /^ */) { depth = RLENGTH / 2; line = substr($0, RLENGTH + 1) }
    line ~ /^# / { doc = substr(line, 3); next }
    line ~ /^[a-z0-9_]+:( *#.*)?$/ {
      split(line, parts, ":")
      path[depth] = (depth ? path[depth - 1] "." : "") parts[1]
      open(path[depth], doc)
      doc = ""
      next
    }
    match(line, /^[a-z0-9_]+: /) {
      key = substr(line, 1, RLENGTH - 2)
      rest = substr(line, RLENGTH + 1)
      at = index(rest, "  # ")
      value = at ? substr(rest, 1, at - 1) : rest
      note = at ? substr(rest, at + 4) : ""
      range = ""
      if (match(note, /, [^,]*$/)) {
        range = substr(note, RSTART + 2)
        note = substr(note, 1, RSTART - 1)
      }
      unit = ""
      if (match(note, / \[[^\]]*\]$/)) {
        unit = substr(note, RSTART + 2, RLENGTH - 3)
        note = substr(note, 1, RSTART - 1)
      }
      name = depth ? path[depth - 1] : top
      rows[name] = rows[name] sprintf("| `%s` | `%s` | %s | %s | %s |\n", key, escaped(value), \
                                      escaped(unit), escaped(range), escaped(note))
    }
    END {
      for (i = 1; i <= sections; ++i) {
        name = order[i]
        if (docs[name] == "" && rows[name] == "") continue
        printf "\n### %s\n", name
        if (docs[name] != "") printf "\n%s\n", toupper(substr(docs[name], 1, 1)) substr(docs[name], 2) "."
        if (rows[name] == "") continue
        printf "\n| setting | default | unit | range | meaning |\n| --- | --- | --- | --- | --- |\n%s", rows[name]
      }
    }'
}

configuration() {
  cat << 'PAGE'
# Settings

For those who tune the system or add a sensor: every setting with default, unit and range.
This page is written by `docs/generate.sh` from `mms config dump`; do not edit it.

```sh
mms config dump > my.yaml           # every setting, with comments
mms config check my.yaml            # checks names, types and ranges
mms run "sim:still_walker?frames=10" --segmenter masks -c my.yaml -o first
```

A settings file holds only what you want to change:

```yaml
fusion: {mode: vision}
static_map:
  voxel_size: 0.05
```

A wrong name or value is one error with file, line, allowed range and the nearest name.
A setting's former name is read for one version, with a warning ([changelog](../CHANGELOG.md)).
Every run writes the settings it used to `config.yaml` in its folder.

## Settings of a run

The headings are groups: `fusion.planes` is the group `planes` inside the group `fusion`.
PAGE
  "$mms" config dump | tables "top level"
  cat << 'PAGE'

## Values of a simulated scene

For `mms simulate --set KEY=VALUE` and `sim:SCENE?KEY=VALUE` ([simulation](simulation.md)).
The defaults are those of `warehouse_loop`.
PAGE
  "$mms" simulate warehouse_loop --print | tables "scene"
}

page="$(cli)"
printf '%s\n' "$page" > "$folder/cli.md"
configuration > "$folder/configuration.md"
