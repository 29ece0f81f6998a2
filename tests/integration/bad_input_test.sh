#!/usr/bin/env bash
# Bad input on command lines: unknown tasks and options, weights and data files that are missing, damaged or of another kind,
# buses that cannot be. Each ends with its exit code (docs/architecture.md) and one line that names the culprit.
# In a network namespace of its own; ends with 77 (skipped) where none is allowed.
#   bad_input_test.sh BIN
set -uo pipefail
if [ -z "${IN_NAMESPACE:-}" ]; then
  unshare -rn true 2>/dev/null || { echo 'skipped: no network namespace is allowed here'; exit 77; }
  IN_NAMESPACE=1 exec unshare -rn "$0" "$@"
fi
here=$(cd "$(dirname "$0")" && pwd)
root=${here%/tests/integration}
bin=$1
. "$here/support/expect.sh"
export PATH="$bin:$PATH:/usr/sbin:/sbin" PROSPECT_BUILD=${bin%/bin} OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
# So small a buffer is allowed everywhere.
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=65536'
unset PROSPECT_DEPLOYMENT PROSPECT_CHAOS PROSPECT_WEIGHTS PROSPECT_TASK
folder=$(mktemp -d)
trap 'jobs -p | xargs -r kill 2>/dev/null; rm -rf "$folder"' EXIT
export XDG_RUNTIME_DIR=$folder  # a deployment of this user's is another bus's
cd "$folder" || exit 1
absent=$folder/absent

# What the cases need: three trials, weights, and both damaged in several ways.
prospect-data collect --task navigation --trials 3 --seed 0 --jobs 1 --out good.h5 >/dev/null 2>&1 || exit 1
good=$root/model/weights/navigation.safetensors
: >empty
echo 'no data of ours, a line of text' >text
head -c $(($(stat -c %s good.h5) / 2)) good.h5 >cut.h5
{ head -c 100 good.h5; tail -c +1000 good.h5; } >short.h5
head -c 3000000 "$good" >cut.safetensors
LC_ALL=C sed 's/"shape":\[32,8,1,1\]/"shape":[8,32,1,1]/' "$good" >shape.safetensors
LC_ALL=C sed 's/\\"task\\":\\"navigation\\"/\\"task\\":\\"stackingxx\\"/' "$good" >task.safetensors

# --- Unknown options and tasks, values out of range.
expect 2 'not expected: --nonsense' prospect-worker --nonsense
expect 2 "unknown option '--nonsense'" prospect-executive --nonsense
for program in "bus check-robot" "bus status" "world oracle" "bench sim" "bench picks"; do
  expect 2 "unknown option '--nonsense'" prospect-$program --nonsense
done
expect 2 'prospect-world: give one of oracle, ceiling, takes, view' prospect-world nonsense
expect 2 'not expected: --nonsense' prospect-model-server --weights scripted --nonsense
expect 2 'not expected: --nonsense' prospect-simulator --nonsense
expect 2 "unknown option '--nonsense'" prospect-data collect --task navigation --out x.h5 --nonsense
expect 2 "unknown option '--nonsense'" prospect-train train --task navigation --nonsense
expect 2 "unknown option '--nonsense'" prospect-evaluate run --task navigation --weights "$good" --nonsense
expect 2 "unknown option '--nonsense'" prospect-data info good.h5 --nonsense
expect 2 "unknown option '--nonsense'" prospect-data from-log text --out x.h5 --nonsense
expect 2 'not expected: --nonsense' prospect-supervisor --task navigation --weights scripted --state . --logs . --nonsense
expect 2 "unknown option '--nonsense'" prospect-world view --nonsense --out x.png
expect 2 'give one of status, check' prospect-bus nonsense
expect 2 "unknown command 'nonsense'.*--help" "$root/prospect" nonsense
for command in demo up run; do
  expect 2 "unknown option '--nonsense'.*--help" "$root/prospect" $command --nonsense
  expect 2 "unknown task 'juggling'; known: navigation" "$root/prospect" $command --task juggling
  expect 2 '--workers wants a whole number' "$root/prospect" $command --workers many
done
for goal in 'on(red' 'on(r*,blue)' 'red under blue' 'red on blue' ''; do
  expect 2 'is no goal.*on\(red,blue\)' prospect-executive --goal "$goal"
  expect 2 'is no goal.*on\(red,blue\)' prospect-evaluate run --task navigation --weights "$good" --goal "$goal"
done
expect 2 'is no goal.*on\(red,blue\)' "$root/prospect" run --goal 'on(red'
expect 3 "there is no 'unicorn' in this task; there are: .*barrel" prospect-evaluate run --task navigation --weights "$good" --goal 'visited(unicorn)'
expect 3 "this task has no goal 'on'" prospect-evaluate run --task navigation --weights "$good" --goal 'on(barrel,pylon)'
expect 2 "unknown option '--solvable'" prospect-evaluate calibrate --task navigation --weights "$good" --solvable 5
expect 2 '--scenes wants a whole number from 1 to 10000' prospect-evaluate calibrate --task navigation --weights "$good" --scenes 20000
expect 2 'calibration scenes are 1500000 to 1999999' prospect-evaluate calibrate --weights "$good" --seed 1999990 --scenes 20
expect 2 'leave --refuse-at-most and --fail-at-most out' prospect-evaluate run --weights "$good" --threshold 0.1 --refuse-at-most 0.05
expect 2 'wants a share between 0 and 1' prospect-evaluate run --weights "$good" --refuse-at-most 1.5
expect 14 'is no report of ./prospect evaluate' prospect-evaluate refusals --report "$good"
expect 2 'wants a share between 0 and 1' "$root/prospect" run --fail-at-most 5
expect 2 "unknown task 'juggling'; known: navigation" prospect-world oracle --task juggling
expect 2 "wants one of navigation.* not 'juggling'" prospect-bench sim --task juggling
expect 2 "unknown task 'juggling'; known: navigation" prospect-data collect --task juggling --out x.h5
expect 2 "unknown task 'juggling'; known: navigation" prospect-world view --task juggling --out x.png
expect 2 "unknown task 'juggling'; known: navigation" prospect-evaluate run --task juggling --weights "$good" --scenes 1
expect 2 "unknown task 'juggling'; known: navigation" prospect-train train --task juggling --data good.h5 --out out
expect 2 'objects.* 4 to 7' prospect-simulator --objects 9
expect 2 'objects wants one of 4, 5, 6, 7, mixed' prospect-data collect --task navigation --objects 9 --out x.h5
expect 2 'objects wants a whole number from 4 to 7' prospect-evaluate run --task navigation --weights "$good" --objects 9 --scenes 1
expect 2 'collection takes 0 to 999,999' prospect-data collect --task navigation --seed 1000000 --trials 1 --out x.h5
expect 2 'seed' prospect-evaluate run --task navigation --weights "$good" --seed 5 --scenes 1
expect 2 "unknown row 'best'; known: planner" prospect-evaluate run --task navigation --weights "$good" --rows best --scenes 1
expect 2 "--rule wants one of paper, .*not 'best'" prospect-evaluate run --task navigation --weights "$good" --rule best --scenes 1
expect 2 "unknown policy 'best'; known: search" prospect-executive --policy best
expect 2 'give action indices, as in plan:0,2,1' prospect-executive --policy plan:x
expect 2 'wants a share from 0 to 1' prospect-worker --chaos drop=2
expect 2 'say A,B' prospect-model-server --weights scripted --fixed-cost 1
expect 2 '--scene-file: File does not exist|cannot be read as YAML' prospect-world view --task stacking --scene-file "$absent" --out x.png
expect 2 'is not JSON' prospect-train train --task navigation --data good.h5 --out out --config text
expect 2 "stage 'best': known are" prospect-train train --task navigation --data good.h5 --out out --stage best --iterations 1

# --- Weights: missing, a folder, empty, not weights, cut off, of another shape, of another task.
weights() {  # weights FILE TEXT: to everyone who loads weights
  expect 10 "$2" prospect-model-server --check --weights "$1"
  expect 10 "$2" prospect-evaluate run --task navigation --weights "$1" --scenes 1 --rows planner --jobs 2
}
weights "$absent" 'absent: cannot be opened; is the path right'
weights "$folder" 'is a folder; name the file|navigation.safetensors: cannot be opened'
weights empty 'empty: is too short.*truncated'
weights text 'text: its header is longer than the file; truncated, or not a safetensors'
weights cut.safetensors 'cut.safetensors: .*truncated'
weights shape.safetensors 'another shape|was made for other weights'
expect 10 "was trained for task 'stackingxx', not for 'navigation'" prospect-evaluate run --task navigation --weights task.safetensors --scenes 1
expect 10 "for task 'navigation', not for 'stacking'" prospect-evaluate run --task stacking --weights "$good" --scenes 1
expect 10 "no weights at $absent: ./prospect train makes them" "$root/prospect" up --weights "$absent"
expect 10 'absent' prospect-model-server --check --weights "replay:$absent"
expect 10 'text is no recording' prospect-model-server --check --weights replay:text

# --- Data sets: missing, a folder, empty, not HDF5, cut off, with bytes missing inside.
for file in "$absent" "$folder" empty text cut.h5 short.h5; do
  damage='(does not open as an HDF5 file.*collect or pack it again|damaged)'
  expect 14 "$file: .*$damage" prospect-data info "$file"
  expect 14 "$file: .*$damage" prospect-data sheet "$file" --out x.png
  expect 14 "$file: .*$damage" prospect-train train --task navigation --data "$file" --out out --iterations 1
  [ "$file" = "$folder" ] || expect 14 "$file: .*$damage" prospect-data pack "$file" --out x.h5
done
[ -e x.h5 ] && echo "FAULT pack left a data set behind" && faults=$((faults + 1))
# Bytes turned over, one file after the other: sound figures, or a clear refusal, and never a crash.
refused=0
size=$(stat -c %s good.h5)
for place in 0 9 40 96 140 300 700 900 1200 2000 2100 2300 3000 $((size / 4)) $((size / 2)) $((size - 700)) $((size - 90)); do
  cp good.h5 flipped.h5
  printf '\377\252\001\177' | dd of=flipped.h5 bs=1 seek="$place" conv=notrunc status=none
  said=$(prospect-data info flipped.h5 2>&1 >/dev/null)
  code=$?
  checks=$((checks + 1))
  [ "$code" = 14 ] && refused=$((refused + 1))
  if [ "$code" != 0 ] && { [ "$code" != 14 ] || [ "$(wc -l <<<"$said")" != 1 ]; }; then
    echo "FAULT bytes turned over at $place: exit code $code: $said"
    faults=$((faults + 1))
  fi
done
# A crash of libhdf5's own: the child that reads is struck while it waits for a pipe.
mkfifo stuck.h5
cat >struck <<'SH'
# Sanitizers would take the blow themselves.
export ASAN_OPTIONS=${ASAN_OPTIONS:-}:handle_segv=0 TSAN_OPTIONS=${TSAN_OPTIONS:-}:handle_segv=0
prospect-data "$@" &
until child=$(pgrep -P $!); do sleep 0.02; done
kill -SEGV "$child"
wait $!
SH
expect 14 'libhdf5 was stopped.*damaged file: leave out' bash struck info stuck.h5
[ "$refused" -gt 0 ] || { echo 'FAULT no damage was seen' && faults=$((faults + 1)); }

# --- Recordings, journals, results.
for file in "$absent" text empty; do
  expect 14 "$file" prospect-bus rebuild-bus "$file"
  expect 14 "$file" prospect-bus rebuild-journal "$file"
  expect 14 "$file" prospect-data from-log "$file" --out x.h5
  expect 14 "$file" prospect-world view --task navigation --episode "$file" --video x.mp4
done

# --- A bus that cannot be: no address, another scheme, no multicast address, nobody at the relay.
bus_users=("prospect-worker" "prospect-simulator" "prospect-model-server --weights scripted" "prospect-executive"
  "prospect-bus check-robot" "prospect-bus check" "prospect-bus wait --services worker=1")
for user in "${bus_users[@]}"; do
  expect 11 "cannot open the bus 'nonsense': the URL must be like udpm://" $user --bus nonsense
done
expect 11 "the URL must be like udpm://" prospect-worker --bus pigeon://239.255.76.67:7667
expect 11 'check address and port of the URL' prospect-worker --bus udpm://host.invalid:7667
expect 11 'check address and port of the URL' prospect-worker --bus udpm://1.2.3.4:7667
expect 11 'no relay answers there.*check host and port' prospect-worker --bus tcpq://127.0.0.1:9

# --- No multicast route, in this namespace of our own.
ip link set lo up
for user in "${bus_users[@]}"; do
  expect 11 'no multicast route.*ip route add 224.0.0.0/4 dev lo' $user
done
for command in up run status; do
  expect 11 'no multicast route.*ip route add 224.0.0.0/4 dev lo' "$root/prospect" $command
done

# --- What a simulator says once it has its bus.
ip route add 224.0.0.0/4 dev lo
expect 2 "unknown task 'juggling': the tasks are navigation" prospect-simulator --task juggling
expect 2 '--scene-file: File does not exist|cannot be read as YAML' prospect-simulator --task stacking --scene-file "$absent"
expect 2 'the scene file: must be a map' prospect-simulator --task stacking --scene-file text

# --- A folder of results in use by another demo.
mkdir -p out/logs
flock --no-fork out/logs sleep 1000 &
holder=$!
for _ in $(seq 200); do flock -n out/logs true || break; sleep 0.02; done
expect 13 "out is in use by sleep 1000 \(pid $holder\)" "$root/prospect" explain --weights scripted --out out
[ "$(ls -A out)" = logs ] || { echo "FAULT a folder in use was written to: $(ls -A out)"; faults=$((faults + 1)); }
kill "$holder"

# --- The bus in use by another deployment.
prospect-worker --deployment 4711 >/dev/null 2>&1 &
prospect-bus wait --services worker=1 --seconds 20 >/dev/null 2>&1 || exit 1
for user in "prospect-worker" "prospect-simulator" "prospect-model-server --weights scripted" "prospect-executive"; do
  expect 12 'in use by another deployment \(worker, pid [0-9]+.*--bus udpm://' $user --deployment 4712
done
finish
