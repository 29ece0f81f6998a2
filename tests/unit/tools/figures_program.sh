#!/usr/bin/env bash
# prospect-figures with the bundled weights on a few fresh trials: all pictures and captions, the same for the same seed; exit codes.
# usage: figures_program.sh PROSPECT-FIGURES PROSPECT-DATA NAVIGATION.safetensors
set -euo pipefail
figures=$1 collect=$2 weights=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "$*"; cat "$work/log"; exit 1; }

# expect CODE TEXT ARGUMENTS...: with that exit code, and TEXT in what it says
expect() {
  local code=0 wanted=$1 text=$2
  shift 2
  "$figures" "$@" >"$work/log" 2>&1 || code=$?
  [ "$code" = "$wanted" ] || fail "exit code $code, not $wanted: $*"
  grep -q -- "$text" "$work/log" || fail "does not say '$text': $*"
}

"$collect" collect --task navigation --trials 40 --seed 0 --out "$work/data.h5" >"$work/log" 2>&1 || fail "no data"
"$collect" collect --task navigation --trials 1 --seed 0 --out "$work/train.h5" >"$work/log" 2>&1 || fail "no data"
printf 'not a data set' >"$work/damaged.h5"
all=(--task navigation --weights "$weights" --data "$work/data.h5" --trials 3 --samples 10)

expect 0 calibration.png "${all[@]}" --out "$work/a" --seed 7
for name in hidden-states random-states variants futures search calibration; do
  [ "$(stat -c %s "$work/a/$name.png")" -gt 10000 ] || fail "$name.png is missing or empty"
  grep -q "^## $name.png" "$work/a/captions.md" || fail "captions.md has no $name.png"
done
expect 0 random-states.png "${all[@]}" --out "$work/b" --seed 7 --only random-states,search
cmp "$work/a/random-states.png" "$work/b/random-states.png"
cmp "$work/a/search.png" "$work/b/search.png"
[ ! -e "$work/b/futures.png" ] || fail "draws more than was asked for"
expect 0 random-states.png "${all[@]}" --out "$work/c" --seed 8 --only random-states
! cmp -s "$work/a/random-states.png" "$work/c/random-states.png" || fail "the seed changes nothing"
mkdir "$work/variants"
expect 0 variants.png "${all[@]}" --out "$work/b" --variants "$work/variants" --only variants
grep -q 'Not trained: Naive, L1,' "$work/b/captions.md" || fail "does not name the untrained"

expect 2 random-states "${all[@]}" --out "$work/b" --only everything
expect 2 unknown "${all[@]:2}" --out "$work/b" --task cooking
expect 10 none.safetensors --task navigation --weights "$work/none.safetensors" --data "$work/data.h5" --out "$work/b"
expect 10 'not for' "${all[@]:2}" --out "$work/b" --task stacking
mkdir -p "$work/variants/l1" && printf 'x' >"$work/variants/l1/navigation.safetensors"
expect 10 l1/navigation "${all[@]}" --out "$work/b" --variants "$work/variants" --only variants
expect 14 missing.h5 --task navigation --weights "$weights" --data "$work/missing.h5" --out "$work/b"
expect 14 damaged.h5 --task navigation --weights "$weights" --data "$work/damaged.h5" --out "$work/b"
expect 14 'no test trials' --task navigation --weights "$weights" --data "$work/train.h5" --out "$work/b"
expect 13 'cannot be written' "${all[@]}" --out "$work/damaged.h5/folder"
