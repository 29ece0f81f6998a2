#!/usr/bin/env bash
# Options that say which scenes there are: out of range they are named at once, and a scene file of one's own is taken by all
# that make scenes. Run on a bus of its own (with_bus.sh).
#   scene_options_test.sh PROSPECT BIN
set -uo pipefail
prospect=$1 bin=$2
root=$(dirname "$prospect")
. "$(dirname "$0")/support/expect.sh"
export PROSPECT_BUILD=${bin%/bin}
work=$(mktemp -d)
export XDG_RUNTIME_DIR=$work PROSPECT_DATA=$work
trap '"$prospect" down >/dev/null 2>&1; rm -rf "$work"' EXIT
cd "$work" || exit 1

for command in demo up run explain; do
  expect 2 "--tower wants .* 2 to 4, not '5'" "$prospect" "$command" --tower 5
  expect 2 "--objects wants .* 4 to 7, not '9'" "$prospect" "$command" --task navigation --objects 9
  expect 2 "--legs wants .* 3 to 5, not '6'" "$prospect" "$command" --task navigation --legs 6
  expect 2 "--legs is not for stacking, which takes --tower" "$prospect" "$command" --task stacking --legs 5
done
for command in evaluate "evaluate plans" "evaluate shifts" oracle takes "view --out x.png"; do
  expect 2 "--tower wants .* 2 to 4, not '5'" "$prospect" $command --tower 5
done
for command in ceiling "collect --out x.h5"; do
  expect 2 "--tower wants one of 2, 3, 4, mixed, not '5'" "$prospect" $command --tower 5
done
for command in evaluate "evaluate plans" "evaluate shifts" oracle takes ceiling "view --out x.png" "collect --out x.h5"; do
  expect 2 'none.yaml: cannot be read' "$prospect" $command --scene-file none.yaml
done

# In one second nothing can be done, so that every plan ends at once.
sed 's/time_limit: 30.0/time_limit: 1.0/' "$root/config/scenes/stacking.yaml" >own.yaml
sed 's/time_limit: 30.0/time_limit: 1.5/' "$root/config/scenes/stacking.yaml" >other.yaml
sed 's/block_height: 0.05/block_height: 5/' "$root/config/scenes/stacking.yaml" >broken.yaml
world=$("$bin/prospect-simulator" --task stacking --scene-file own.yaml --check)
[ "$world" != "$("$bin/prospect-simulator" --task stacking --check)" ] || exit 1

for command in demo up explain; do
  expect 14 "no scene file at 'none.yaml'" "$prospect" "$command" --weights scripted --scene-file none.yaml
  expect 2 "block_height" "$prospect" "$command" --weights scripted --scene-file broken.yaml
  expect 2 "scene-file is not for navigation" "$prospect" "$command" --task navigation --weights scripted --scene-file own.yaml
done

ends() {  # ends CODE COMMAND...: whatever it says
  local code=$1 said
  shift
  said=$(timeout 120 "$@" 2>&1 </dev/null)
  local got=$?
  checks=$((checks + 1))
  [ "$got" = "$code" ] && return
  faults=$((faults + 1))
  printf 'FAULT %s\n  exit code %s, not %s:\n%s\n' "$*" "$got" "$code" "$said"
}
holds() {  # holds FILE TEXT
  checks=$((checks + 1))
  grep -qF -- "$2" "$1" && return
  faults=$((faults + 1))
  printf 'FAULT %s does not hold "%s"\n' "$1" "$2"
}

ends 0 "$prospect" up --task stacking --weights scripted --workers 1 --scene-file own.yaml
ends 4 "$prospect" run --seed 1600000 --policy expert --scene-file own.yaml --out of_own
holds of_own/result.json "\"world_version\": \"$world\""
ends 4 "$prospect" run --seed 1600000 --policy expert --out as_up
holds as_up/result.json "\"world_version\": \"$world\""
ends 2 "$prospect" run --seed 1600000 --policy expert --scene-file other.yaml --out of_other
grep -q 'another scene is up' of_other/result.json || { faults=$((faults + 1)); echo 'FAULT the other scene is not named'; }
ends 0 "$prospect" down

expect 2 "carried out in the world $world" "$bin/prospect-world" view --episode of_own/result.json --out seen.png
ends 0 "$bin/prospect-world" view --episode of_own/result.json --scene-file own.yaml --out seen.png
ends 0 "$prospect" oracle --task stacking --scenes 1 --scene-file own.yaml --json oracle.json
holds oracle.json '"hopeless"'
ls "$work"/oracle/*"$world"* >/dev/null || { faults=$((faults + 1)); echo 'FAULT the oracle was asked of another world'; }
ends 0 "$prospect" takes --task stacking --scenes 1 --actions 2 --scene-file own.yaml
ends 0 "$prospect" ceiling --task stacking --trials 2 --runs 2 --jobs 1 --scene-file own.yaml
ends 0 "$prospect" evaluate --task stacking --scenes 1 --jobs 1 --rows planner --samples 1 --scene-file own.yaml --json evaluate.json
holds evaluate.json 'own.yaml'
finish
