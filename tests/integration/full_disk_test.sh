#!/usr/bin/env bash
# A full disk: whoever writes ends with 13 and one line that names the file, leaves no half file under its real name, and
# harms nothing that was there. On a disk of 64 kB of our own; ends with 77 (skipped) where such a one is not allowed.
#   full_disk_test.sh BIN
set -uo pipefail
if [ -z "${IN_NAMESPACE:-}" ]; then
  unshare -rmn true 2>/dev/null || { echo 'skipped: no mount namespace is allowed here'; exit 77; }
  IN_NAMESPACE=1 exec unshare -rmn "$0" "$@"
fi
here=$(cd "$(dirname "$0")" && pwd)
root=${here%/tests/integration}
bin=$1
. "$here/support/expect.sh"
export PATH="$bin:$PATH:/usr/sbin:/sbin" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=65536'
unset PROSPECT_DEPLOYMENT PROSPECT_CHAOS PROSPECT_WEIGHTS PROSPECT_TASK
folder=$(mktemp -d)
disk=$folder/disk
trap 'jobs -p | xargs -r kill 2>/dev/null; wait; umount "$disk" 2>/dev/null; rm -rf "$folder"' EXIT
mkdir "$disk"
mount -t tmpfs -o size=64k,mode=700 none "$disk" 2>/dev/null || { echo 'skipped: no small disk can be mounted here'; exit 77; }
cd "$folder" || exit 1
ip link set lo up
ip route add 224.0.0.0/4 dev lo
prospect-data collect --task navigation --trials 6 --seed 0 --jobs 1 --out good.h5 >/dev/null 2>&1 || exit 1

fault() { echo "FAULT $*"; faults=$((faults + 1)); }
fill() { rm -rf "${disk:?}"/*; head -c 200000 /dev/zero >"$disk/fill" 2>/dev/null; }
room() { rm -rf "${disk:?}"/*; }
absent() { local file; for file in "$@"; do [ ! -e "$disk/$file" ] || fault "$file was left behind"; done; }

# --- Data sets: what fits is kept and gone on with, the rest ends clearly.
for jobs in 1 2; do
  room
  expect 13 'disk/trials.h5.parts/trial_[0-9]+.h5: cannot be written.*space on the disk' \
    prospect-data collect --task navigation --trials 6 --seed 0 --jobs $jobs --out "$disk/trials.h5"
  absent trials.h5
  compgen -G "$disk/trials.h5.parts/.*.part*" >/dev/null && fault 'a half trial was left behind'
done
mount -o remount,size=8m "$disk" || exit 1
prospect-data collect --task navigation --trials 6 --seed 0 --jobs 1 --resume --out "$disk/trials.h5" >/dev/null 2>&1 ||
  fault 'collect --resume does not go on where there is room again'
room
mount -o remount,size=64k "$disk" || exit 1
expect 13 'disk/packed.h5: needs up to .* MB.*make room' prospect-data pack good.h5 --out "$disk/packed.h5"
[ -z "$(ls "$disk")" ] || fault "pack left $(ls "$disk")"
expect 13 'out.* cannot be|out.*needs .* MB' prospect-train train --task navigation --data good.h5 --out "$disk/out" --iterations 1

# --- Figures, pictures, videos.
for program in "prospect-data info good.h5" "prospect-data collect --task navigation --trials 1 --jobs 1 --out one.h5" \
  "prospect-world oracle --task navigation --scenes 1 --seed 1000000" "prospect-bench sim --task navigation" "prospect-bus status"; do
  fill
  expect 13 'disk/figures.json.*cannot be written.*space' $program --json "$disk/figures.json"
  absent figures.json
done
fill
expect 13 'disk/sheet.png' prospect-data sheet good.h5 --out "$disk/sheet.png"
fill
expect 13 'disk/scene.png' prospect-world view --task navigation --seed 1 --out "$disk/scene.png"
room
head -c 57000 /dev/zero >"$disk/fill"
expect 13 'disk/scene.mp4.*disk full' prospect-world view --task navigation --seed 1 --actions 0,1 --size 640x480 --video "$disk/scene.mp4"

# --- A deployment whose disk fills up while it runs goes on: what is killed is started again.
room
mkdir logs
prospect-supervisor --open --task navigation --weights scripted --workers 1 --state "$disk" --logs logs >supervisor.log 2>&1 &
supervisor=$!
prospect-bus wait --services simulator=1,model=1,worker=1 --seconds 20 >/dev/null 2>&1 || fault 'the deployment did not come up'
head -c 200000 /dev/zero >"$disk/fill" 2>/dev/null
worker() {
  local pid
  for pid in $(cat "/proc/$supervisor/task/$supervisor/children"); do
    [ "$(cat "/proc/$pid/comm" 2>/dev/null)" = prospect-worker ] && echo "$pid"
  done
}
first=$(worker)
kill -KILL "$first"
for _ in $(seq 100); do
  now=$(worker)
  [ -n "$now" ] && [ "$now" != "$first" ] && grep -q 'the services go on' supervisor.log && break
  sleep 0.1
done
[ -n "$now" ] && [ "$now" != "$first" ] || fault "the worker was not started again: $(tail -2 supervisor.log)"
grep -q 'services.json: cannot be written.*the services go on' supervisor.log || fault 'the full disk was not told'
kill "$supervisor"
wait "$supervisor" 2>/dev/null

# --- What runs: an executive keeps its answer on the screen, a worker without its journal stops, a supervisor does not start.
prospect-simulator >simulator.log 2>&1 &
prospect-model-server --weights scripted:7 >model.log 2>&1 &
prospect-worker >worker.log 2>&1 &
prospect-bus wait --services simulator=1,model=1,worker=1 --seconds 20 >/dev/null 2>&1 || exit 1
episode=(prospect-executive --seed 1500000 --policy plan:0 --log-level off --scene-timeout-ms 60000)
fill
expect 13 'disk/out' "${episode[@]}" --out "$disk/out"
room
mkdir "$disk/out"
echo '"of an earlier episode"' >"$disk/out/result.json"
head -c 200000 /dev/zero >"$disk/fill" 2>/dev/null
expect 13 'disk/out/result.json: cannot be written.*space' "${episode[@]}" --out "$disk/out"
[ "$(cat "$disk/out/result.json")" = '"of an earlier episode"' ] || fault 'an earlier result was harmed'
compgen -G "$disk/out/.*.part*" >/dev/null && fault 'half a result was left behind'
room
expect 13 'disk/out/(plan.png|episode.mp4): ' "${episode[@]}" --out "$disk/out"
grep -q '"outcome": "' "$disk/out/result.json" || fault 'what fits should be written'
room
expect 13 'the recording has ended: .*No space left' "$root/prospect" record -q "$disk/run.lcmlog"
lcm-logger -q -f run.lcmlog >/dev/null 2>&1 &
logger=$!
prospect-executive --seed 4711 --policy collect --scene-timeout-ms 60000 >collect.log 2>&1
kill -INT "$logger" && wait "$logger" 2>/dev/null
fill
expect 13 'disk/trials.h5' prospect-data from-log run.lcmlog --out "$disk/trials.h5"
absent trials.h5
fill
while :; do prospect-executive --refusal-threshold 1 --seed 1500000 >search.log 2>&1; done &
searches=$!
expect 13 'cannot write the journal .*disk/journal: is the disk full' prospect-worker --log-level off --journal "$disk/journal"
kill "$searches"
wait "$searches" 2>/dev/null
fill
expect 13 'disk/state' \
  prospect-supervisor --task navigation --weights scripted --log-level off --state "$disk/state" --logs "$disk/logs"
expect 13 'disk/key cannot be written.*space' \
  prospect-supervisor --task navigation --weights scripted --log-level off --state "$disk" --logs "$disk"
finish
