#!/usr/bin/env bash
# A task at the bounds of what a file may say, its robot and the services on a bus of their own (with_bus.sh): a search ends with a
# plan, and the robot keeps to the rules.
#   task_bounds_test.sh BIN MADE_ROBOT most-actions    255 actions, each of which may follow all others; pictures of 256x256
#   task_bounds_test.sh BIN MADE_ROBOT longest-plan    one action; plans of 64; pictures of 32x32
set -uo pipefail
bin=$1 robot=$2 bound=$3
. "$(dirname "$0")/support/expect.sh"
export PATH="$bin:$PATH" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
work=$(mktemp -d)
export XDG_RUNTIME_DIR=$work PROSPECT_DATA=$work
trap 'jobs -p | xargs -r kill 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
fault() { faults=$((faults + 1)); echo "FAULT $*"; }

case $bound in
  most-actions)
    length=2 weights=scripted
    objects=$(seq -f 'thing_%03g' -s ', ' 255)
    cat >task.yaml <<YAML
name: bounds
picture: {width: 256, height: 256}
actions: {kinds: [touch], objects: [$objects]}
first: any
follows: {any: any_other}
plan_length: 2
tick_seconds: 0.1
action_time_limit: 5
YAML
    ;;
  longest-plan)  # of networks, since what is scripted does not do the same again
    length=64 weights=run/bounds.safetensors
    cat >task.yaml <<YAML
name: bounds
picture: {width: 32, height: 32}
actions: [go]
first: go
follows: {go: go}
repeats_allowed: true
plan_length: 64
tick_seconds: 0.1
action_time_limit: 5
YAML
    "$robot" task.yaml --trials 12 trials.h5 || fault 'no trials'
    prospect-train train --task task.yaml --data trials.h5 --out run --iterations 1 --threads 1 --quiet >train.log 2>&1 &
    training=$!
    ;;
esac

"$robot" task.yaml >robot.log 2>&1 &
said=$(timeout 60 prospect-bus check-robot 2>&1)
code=$?
checks=$((checks + 1))
[ "$code" = 0 ] || fault "check-robot ends with $code:"$'\n'"$said"

[ -z "${training:-}" ] || wait "$training" || fault "does not train: $(tail -n 3 train.log)"
prospect-model-server --weights "$weights" --task task.yaml >model.log 2>&1 &
prospect-worker >worker.log 2>&1 &
timeout 60 prospect-executive --explain-only --no-reset --task task.yaml --samples 16 --seed 1 --novelty 0 --refusal-threshold 0 \
  --json plan.json >search.log 2>&1
code=$?
checks=$((checks + 1))
steps=$(grep -c '"step":' plan.json)
[ "$code" = 0 ] && [ "$steps" = "$length" ] ||
  fault "a search ends with $code and a plan of $steps:"$'\n'"$(tail -n 5 search.log)"
finish
