#!/usr/bin/env bash
# A task that no source knows, from its file to an episode: listed, checked, trained, put up without a simulator, planned for,
# explained, learned from its robot; and what is told where file and robot do not agree. Run on a bus of its own (with_bus.sh).
#   own_task_test.sh PROSPECT BIN MADE_ROBOT
set -uo pipefail
prospect=$1 bin=$2 robot=$3
. "$(dirname "$0")/support/expect.sh"
export PROSPECT_BUILD=${bin%/bin} PATH="$bin:$PATH" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
work=$(mktemp -d)
export XDG_RUNTIME_DIR=$work PROSPECT_DATA=$work
robot_pid=
trap '[ -n "$robot_pid" ] && kill "$robot_pid" 2>/dev/null; "$prospect" down >/dev/null 2>&1; rm -rf "$work"' EXIT
cd "$work" || exit 1
fault() { faults=$((faults + 1)); echo "FAULT $*"; }
ends() {  # ends CODE COMMAND...: what it said is in `said`
  local code=$1
  shift
  said=$(timeout 120 "$@" 2>&1 </dev/null)
  local got=$?
  checks=$((checks + 1))
  [ "$got" = "$code" ] || fault "$*"$'\n'"  exit code $got, not $code:"$'\n'"$said"
}
says() {  # says TEXT: of the last that ended
  checks=$((checks + 1))
  grep -qF -- "$1" <<<"$said" || fault "'$1' was not said, but:"$'\n'"$said"
}
start_robot() {  # start_robot [OPTION...]: the one before leaves
  [ -n "$robot_pid" ] && kill "$robot_pid" && wait "$robot_pid" 2>/dev/null
  "$robot" rover.yaml "$@" >robot.log 2>&1 &
  robot_pid=$!
}

cat >rover.yaml <<'YAML'
name: rover
picture: {width: 32, height: 48}
actions: [scan, drive(hill), drive(lake), report]
first: scan
follows:
  scan: drive
  drive: [drive(other), report]
  report: []
plan_length: 4
tick_seconds: 0.1
action_time_limit: 5
causes:
  stuck: it is stuck in the mud
YAML

ends 0 "$prospect" task check rover.yaml
says 'a plan begins with: scan'
says 'a plan ends with:   report'
says 'it has no goals'
sed 's/report: \[\]/report: drive/' rover.yaml >round.yaml
expect 14 'round.yaml:6: after .scan. no plan can be complete' "$prospect" task check round.yaml
sed '$a training: {focuss: 1}' rover.yaml >settings.yaml
expect 14 'settings.yaml:14: training: .*focuss' "$prospect" task check settings.yaml

"$robot" rover.yaml --trials 60 trials.h5 || fault 'no trials'
ends 0 "$prospect" train --task rover.yaml --data trials.h5 --out run --iterations 8 --threads 1
[ -e run/rover.safetensors ] || fault 'no weights'
sed 's/drive(hill)/drive(dune)/' rover.yaml >dune.yaml
expect 14 'trials.h5: was recorded with another task than dune.yaml' \
  "$prospect" train --task dune.yaml --data trials.h5 --out other
ends 0 "$prospect" dataset info trials.h5
says ' action 1 '
ends 0 "$prospect" dataset info trials.h5 --task rover.yaml --json info.json
says ' drive(hill) '
says 'try again'
grep -q '"action": "drive(hill)"' info.json || fault 'no names of actions in the report'
for task in dune.yaml stacking; do
  expect 14 'was recorded with another task than .*; name the file that it was recorded with' \
    "$prospect" dataset info trials.h5 --task "$task"
done
ends 0 "$prospect" dataset sheet trials.h5 --rows 1 --out numbers.png
ends 0 "$prospect" dataset sheet trials.h5 --rows 1 --out names.png --task rover.yaml
cmp -s numbers.png names.png && fault 'the sheet shows no names'
expect 14 'was recorded with another task than dune.yaml' "$prospect" dataset sheet trials.h5 --out dune.png --task dune.yaml

expect 2 'rover has no built-in simulator: .* up --no-simulator --task rover.yaml' "$prospect" up --task rover.yaml
ends 0 "$prospect" up --no-simulator --open --task rover.yaml --weights run/rover.safetensors --workers 1
start_robot
ends 0 "$prospect" run --no-reset --policy plan:0,1,2,3 --out plain   # of the task that is up
ends 0 "$prospect" check-robot --task rover.yaml --json check.json
says 'TASK and the task file agree'
says 'succeeded, 0 failed: training needs both'
ends 0 "$prospect" task learn --out learned.yaml
ends 0 "$prospect" task check learned.yaml
expect 2 'learned.yaml is there already' "$prospect" task learn --out learned.yaml

start_robot --fails report
for command in "run --no-reset --refusal-threshold 0 --novelty 0" "run --no-reset" "explain --no-reset --refusal-threshold 0"; do
  said=$("$prospect" $command --task learned.yaml --seed 1 --samples 8 --out planned --json - 2>log)
  code=$?
  checks=$((checks + 1))
  case $code in 0 | 3 | 4) ;; *) fault "$command ends with $code: $(tail -n 3 log)" ;; esac
  grep -q '"plan_length": 4' <<<"$said" || fault "$command does not tell of a plan of 4: $said"
done

start_robot --plan-length 3
ends 2 "$prospect" run --no-reset --policy plan:0,1,3
says 'rover.yaml, 3 on the bus'
ends 2 "$prospect" run --no-reset --task stacking --policy plan:0,1,3
says '--task stacking, but rover is up'
ends 4 "$prospect" check-robot --task rover.yaml
says 'plan_length is 4 in rover.yaml, 3 on the bus'
finish
