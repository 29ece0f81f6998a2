#!/usr/bin/env bash
# prospect-verify on a small figure: within its tolerance, outside it, a command that fails, a report that lacks it.
# usage: verify_exit_codes.sh PROSPECT-VERIFY
set -euo pipefail
verify=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# expect CODE COMMAND POINTER FULL
expect() {
  cat >"$work/figures.yaml" <<YAML
- name: two trials
  commands: ["$2"]
  quick: {trials: 2}
  full: {trials: 3}
  figures:
    - {name: trials, pointer: $3, printed: "", quick: 2, full: $4, tolerance: 0.1}
YAML
  local code=0
  "$verify" --figures "$work/figures.yaml" --weights none --held-out none --work "$work/w" --json "$work/out.json" "${@:5}" >"$work/log" 2>&1 || code=$?
  [ "$code" = "$1" ] || { echo "exit code $code, not $1:"; cat "$work/log"; exit 1; }
}

collect='collect --task navigation --trials {trials} --seed 0 --out {work}/{trials}.h5 --json {report}'
expect 0 "$collect" /trials 3
grep -q '"within": true' "$work/out.json"
expect 0 "$collect" /trials 3 --full
expect 5 "$collect" /trials 4 --full
grep -q OUTSIDE "$work/log"
expect 2 "$collect" /nowhere 3
expect 2 'collect --trials many' /trials 3
grep -q 'collect ended with exit code 2' "$work/log"
