#!/usr/bin/env bash
# Writes the manual page mms.1.gz and default.yaml, all settings with their defaults, from the
# program's output.
# usage: packaging/make_man_page.sh FOLDER VERSION PROGRAM...   (PROGRAM may begin with an emulator)
set -euo pipefail
folder="$1" version="$2"
shift 2
program=("$@")

# Escapes roff: backslashes, hyphens, and a dot or quote at the start of a line.
escape() { sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; }

commands_of() {
  "${program[@]}" "$@" --help |
    awk '/^[^ ]/ { listed = $1 == "Subcommands:" } listed && /^  [a-z]/ { print $1 }'
}

# help_of COMMAND...: the help, wrapped at 76 characters.
help_of() {
  printf '.SS mms %s\n.nf\n' "$(escape <<< "$*")"
  "${program[@]}" "$@" --help | fold -s -w 76 | sed -e 's/[[:space:]]*$//' | cat -s | escape
  printf '.fi\n'
}

page() {
  cat << END
.TH MMS 1 "" "mms-slam $version" "User Commands"
.SH NAME
mms \- visual and LiDAR SLAM among moving people and vehicles
.SH SYNOPSIS
.B mms
.I COMMAND
.RI [ OPTION ...]
.SH DESCRIPTION
.B mms
localizes a depth camera or LiDAR among walking people and moving vehicles and maps what stands still.
It writes the trajectory of the sensor, a static map without people and vehicles, the tracked objects with boxes and
velocities, and a report for the browser.
.SH EXAMPLES
.TP
.B mms run sim:warehouse_loop \-\-frames 100
Run on 100 frames of the simulated warehouse, which has exact ground truth.
.TP
.B mms run FOLDER
Run on a recording; the results are in results/latest.
.TP
.B mms view results/latest
Play a finished run in a browser.
.TP
.B mms doctor
Check that the program works on this machine.
.SH COMMANDS
END
  local command part
  for command in $(commands_of); do
    # mms train starts mms-torch, which is missing in a build without libtorch.
    if [ "$command" = train ] && ! "${program[@]}" train --help > /dev/null 2>&1; then
      printf '.SS mms train\nTrain the segmentation network; part of builds with libtorch.\n'
      continue
    fi
    help_of "$command"
    for part in $(commands_of "$command"); do
      help_of "$command" "$part"
    done
  done
  cat << END
.SH FILES
.TP
.I /usr/share/mms/weights
Weights of the network.
.TP
.I /usr/share/mms/config
All settings with their defaults (default.yaml), and those of training.
.SH EXIT STATUS
0 on success, another value on an error, which is explained on standard error.
END
}

page | gzip -9n > "$folder/mms.1.gz"
"${program[@]}" config dump > "$folder/default.yaml"
