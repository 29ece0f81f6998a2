#!/usr/bin/env bash
# lcm-spy starts on a display of its own, knows every message type and finds the picture plugin:
#   spy_starts.sh PROSPECT JAR NUMBER_OF_TYPES
set -euo pipefail
prospect=$1 jar=$2 types=$3
folder=$(mktemp -d)
pids=()
trap 'kill "${pids[@]}" 2>/dev/null || true; rm -rf "$folder"' EXIT

# Waits until a file holds a line: wait_for FILE PATTERN
wait_for() {
  local end=$((SECONDS + 40))
  until grep -q "$2" "$1" 2>/dev/null; do
    if ((SECONDS >= end)); then
      echo "no '$2' within 40 s; the program said:" >&2
      cat "$folder"/*.log >&2
      exit 1
    fi
    sleep 0.1
  done
}

Xvfb -displayfd 3 -screen 0 1024x768x24 3>"$folder/display" 2>"$folder/xvfb.log" &
pids+=($!)
wait_for "$folder/display" '[0-9]'
DISPLAY=":$(cat "$folder/display")" "$prospect" spy --jar "$jar" >"$folder/spy.log" 2>&1 &
pids+=($!)
wait_for "$folder/spy.log" "Found $types LCM types"
wait_for "$folder/spy.log" 'prospect_spy.PicturePlugin'
echo "lcm-spy is up with $types types and the picture plugin"
