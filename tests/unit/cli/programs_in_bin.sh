#!/usr/bin/env bash
# bin/ holds few programs, nothing else, and each is one that the table of commands starts.
#   programs_in_bin.sh BIN CLI_SOURCES
set -euo pipefail
bin=$1 sources=$2
most=16

mapfile -t programs < <(ls "$bin")
echo "${#programs[@]} programs: ${programs[*]}"
[ "${#programs[@]}" -le "$most" ] || { echo "more than $most: make it a subcommand of one of these, or build it elsewhere"; exit 1; }
faults=0
for program in "${programs[@]}"; do
  [ "$program" = prospect ] && continue
  grep -rqF "\"$program\"" "$sources" || { echo "$program is in bin/, but no command starts it"; faults=1; }
done
exit "$faults"
