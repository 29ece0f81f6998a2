#!/usr/bin/env bash
# What is written, and what is in use. Nodes that are no plain files stay what they are and are written to; folders in use are
# refused with 13 and the name of their holder; what is stopped tells and writes what it has and ends with 130.
#   files_test.sh BIN
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=${here%/tests/integration}
bin=$1
. "$here/support/expect.sh"
export PATH="$bin:$PATH:/usr/sbin:/sbin" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
unset PROSPECT_DEPLOYMENT PROSPECT_CHAOS PROSPECT_WEIGHTS PROSPECT_TASK
folder=$(mktemp -d)
trap 'jobs -p | xargs -r kill -KILL 2>/dev/null; wait 2>/dev/null; rm -rf "$folder"' EXIT
cd "$folder" || exit 1
export PROSPECT_DATA=$folder/data
fault() { echo "FAULT $*"; faults=$((faults + 1)); }
# until SECONDS COMMAND...: until it holds, at most so long.
until_true() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    [ "$SECONDS" -lt "$end" ] || { fault "waited in vain for: $*"; return 1; }
    sleep 0.05
  done
}

prospect-data collect --task navigation --trials 3 --seed 0 --jobs 1 --out good.h5 >/dev/null 2>&1 || exit 1
prospect-data collect --task navigation --trials 30 --seed 0 --jobs 2 --out thirty.h5 >/dev/null 2>&1 || exit 1
weights=$root/model/weights/navigation.safetensors

# --- Nodes. written COMMAND... NAME: the command ends with 0, where NAME is a pipe (with a reader), a link, a link to nothing, and,
# where such may be made, devices.
device=yes
mknod null c 1 3 2>/dev/null || device=
[ -z "$device" ] || mknod full c 1 7
written() {
  local name=${*: -1} first
  local command=("${@:1:$#-1}")
  checks=$((checks + 1))
  rm -rf node target elsewhere && mkdir elsewhere
  mkfifo node
  cat node >heard &
  local reader=$!
  timeout 60 "${command[@]}" node >/dev/null 2>&1 || fault "${command[*]}: into a pipe: exit code $?"
  until_true 20 test -s heard || kill "$reader"
  wait "$reader" 2>/dev/null
  [ -p node ] || fault "${command[*]} replaced a pipe"
  rm node
  echo old >target
  ln -s target node
  timeout 60 "${command[@]}" node >/dev/null 2>&1 || fault "${command[*]}: through a link: exit code $?"
  { [ -L node ] && [ "$(cat target | head -c 3)" != old ]; } || fault "${command[*]} replaced a link, or wrote elsewhere"
  first=$(stat -c %s target)
  rm node target
  ln -s elsewhere/target node
  timeout 60 "${command[@]}" node >/dev/null 2>&1 || fault "${command[*]}: through a link to nothing: exit code $?"
  { [ -L node ] && [ "$(stat -c %s elsewhere/target)" -gt $((first / 2)) ]; } || fault "${command[*]} replaced a link to nothing"
  [ "$(ls -A elsewhere)" = target ] || fault "${command[*]} left $(ls -A elsewhere)"
  [ -z "$device" ] && return
  timeout 60 "${command[@]}" null >/dev/null 2>&1 || fault "${command[*]}: into a device: exit code $?"
  [ -c null ] || { fault "${command[*]} replaced a device"; rm -f null; mknod null c 1 3; }
  expect 13 'full: .*(No space left on device|disk full)' "${command[@]}" full
  [ -c full ] || { fault "${command[*]} replaced a full device"; rm -f full; mknod full c 1 7; }
}
written prospect-data info good.h5 --json NAME
written prospect-data sheet good.h5 --rows 2 --out NAME
written prospect-data pack good.h5 --out NAME
written prospect-world oracle --task navigation --scenes 1 --seed 1000000 --jobs 1 --json NAME
written prospect-world view --task navigation --seed 1 --size 64x48 --out NAME
[ -x "$bin/prospect-train" ] &&
  written prospect-train train --task navigation --data thirty.h5 --out scored --score "$weights" --threads 1 --json NAME
# Behind what the program printed, not over it.
prospect-data info good.h5 --json /dev/stdout >both 2>/dev/null
{ grep -q '^task  *navigation' both && grep -q '"trials": 3' both; } || fault 'the figures took the place of the printed words'

grep -q '^ *investigate(barrel) ' both || fault 'actions of a task that is installed have no names'

# --- In use. The first one goes on; its lock dies with it.
prospect-data collect --task navigation --trials 1000000 --seed 0 --jobs 2 --out many.h5 >/dev/null 2>&1 &
first=$!
until_true 60 compgen -G 'many.h5.parts/trial_*.h5'
expect 13 "many.h5.parts: is in use by prospect-data collect --task navigation --trials 1000000 .*\(pid $first\)" \
  prospect-data collect --task navigation --trials 2 --seed 0 --jobs 1 --resume --out many.h5
kill -0 "$first" || fault 'the first collector was disturbed'
kill -KILL "$first"
wait "$first" 2>/dev/null
resumes() { prospect-data collect --task navigation --trials 2 --seed 0 --jobs 1 --resume --out many.h5; }
until_true 20 resumes  # its processes die with it
[ -e many.h5 ] || fault 'a killed collector is not gone on with'

mkdir used
flock --no-fork used sleep 1000 &
holder=$!
until_true 20 bash -c '! flock -n used true'
in_use="used: is in use by sleep 1000 \(pid $holder\)"
[ -x "$bin/prospect-train" ] &&
  expect 13 "$in_use" prospect-train train --task navigation --data good.h5 --out used --iterations 1
[ -x "$bin/prospect-train" ] &&
  expect 13 "$in_use" prospect-train tables --task navigation --data good.h5 --weights "$weights" --out used
[ -x "$bin/prospect-figures" ] && expect 13 "$in_use" prospect-figures --task navigation --weights "$weights" --data good.h5 --out used
[ -x "$bin/prospect-evaluate" ] &&
  expect 13 "$in_use" prospect-evaluate shifts --task navigation --weights "$weights" --scenes 1 --out used
[ -x "$bin/prospect-executive" ] && expect 13 "$in_use" prospect-executive --log-level off --out used
[ -z "$(ls -A used)" ] || fault "something was written into a folder in use: $(ls -A used)"
kill "$holder"
wait "$holder" 2>/dev/null

# --- Stopped. stopped SIGNAL CONDITION LOG COMMAND...: once the condition holds.
stopped() {
  local signal=$1 condition=$2 code
  shift 2
  rm -f report.json
  checks=$((checks + 1))
  "$@" --json report.json >said 2>&1 &
  local pid=$!
  until_true 120 bash -c "$condition"
  kill -"$signal" "$pid"
  until_true 60 bash -c "! kill -0 $pid"
  wait "$pid"
  code=$?
  [ "$code" = 130 ] || fault "$* ends with $code: $(tail -3 said)"
  grep -qE 'stopped after [1-9][0-9]* of 1000 (scenes|trials)' said || fault "$* does not say how far it came: $(tail -3 said)"
  { grep -q '"stopped": true' report.json && grep -q '"wanted": 1000' report.json; } || fault "$* writes no report of what it has"
}
lines='[ "$(cat data/oracle/*.jsonl 2>/dev/null | wc -l)" -ge 3 ]'
for signal in INT TERM; do
  rm -rf data
  stopped "$signal" "$lines" prospect-world oracle --task navigation --scenes 1000 --seed 1000000 --jobs 2
done
grep -qvE '^\{.*\}$' data/oracle/*.jsonl && fault 'a line of the cache was cut'
if [ -x "$bin/prospect-evaluate" ]; then
  rm -rf data
  stopped TERM "$lines" prospect-evaluate run --task navigation --weights "$weights" --scenes 1000 --rows planner,nothing --jobs 2
  grep -q 'planner, solvable: solved' said || fault 'evaluate prints no table of what it has'
fi
# Beside the file's own first line: of three scenes by two processes one has been handed over.
if [ -x "$bin/prospect-evaluate" ]; then
  rm -rf data
  stopped INT '[ "$(cat data/plans/*.jsonl 2>/dev/null | wc -l)" -ge 4 ]' \
    prospect-evaluate plans --task navigation --weights "$weights" --scenes 1000 --runs 1 --jobs 2
fi
checks=$((checks + 1))
prospect-data collect --task navigation --trials 1000 --seed 0 --jobs 2 --out stopped.h5 >said 2>&1 &
first=$!
until_true 60 compgen -G 'stopped.h5.parts/trial_*.h5'
kill -INT "$first"
wait "$first"
code=$?
{ [ "$code" = 130 ] && grep -qE 'stopped after [0-9]+ of 1000 trials; --resume goes on' said; } || fault "collect ends with $code: $(cat said)"

# --- A key twice: which one counts would be chance.
echo '{"heads": {"batch": 4, "batch": 8}}' >twice.json
[ -x "$bin/prospect-train" ] && expect 2 "twice.json: names 'heads.batch' twice" prospect-train train --task navigation --config twice.json --print-config
cp "$root/config/scenes/stacking.yaml" twice.yaml
sed -i 's/^\(  force:.*\)$/\1\n\1/' twice.yaml
expect 2 "twice.yaml: names 'gripper.force' twice" prospect-world view --task stacking --scene-file twice.yaml --out x.png

# --- The cache of pictures is known by its checksum.
if [ -x "$bin/prospect-train" ]; then
  train=(prospect-train train --task navigation --data thirty.h5 --out run --threads 1 --iterations 1 --stage classifier)
  "${train[@]}" >said 2>&1 || fault "does not train: $(tail -1 said)"
  cache=$(ls run/cache/pictures-*)
  sum=$(sha256sum <"$cache")
  dd if=/dev/zero of="$cache" bs=100k count=1 conv=notrunc status=none  # black pictures, as after two that wrote at once
  "${train[@]}" >said 2>&1
  grep -q 'pictures-.*: is damaged (its checksum does not fit); it is made anew' said || fault 'a damaged cache was taken'
  [ "$(sha256sum <"$cache")" = "$sum" ] || fault 'a damaged cache was not made anew'
  "${train[@]}" >said 2>&1
  grep -q 'damaged' said && fault 'a sound cache was made anew'
fi
finish
