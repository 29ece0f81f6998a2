#!/usr/bin/env bash
# A deployment as ./prospect handles it: whose state it trusts, whom it stops, what run may ask of it, how commands without
# services keep to themselves. Scripted weights; in a network namespace of its own; ends with 77 (skipped) where none is allowed.
#   deployment_test.sh PROSPECT BIN
set -uo pipefail
if [ -z "${IN_NAMESPACE:-}" ]; then
  unshare -rn true 2>/dev/null || { echo 'skipped: no network namespace is allowed here'; exit 77; }
  IN_NAMESPACE=1 exec unshare -rn "$0" "$@"
fi
here=$(cd "$(dirname "$0")" && pwd)
. "$here/support/expect.sh"
prospect=$1 bin=$2
folder=$(mktemp -d)
export PATH="$bin:$PATH:/usr/sbin:/sbin" PROSPECT_BUILD=${bin%/bin} XDG_RUNTIME_DIR=$folder/run OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
# So small a buffer is allowed everywhere.
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=65536'
unset PROSPECT_DEPLOYMENT PROSPECT_CHAOS PROSPECT_WEIGHTS PROSPECT_TASK PROSPECT_KEY_FILE
trap 'prospect-supervisor stop >/dev/null 2>&1; jobs -p | xargs -r kill 2>/dev/null; rm -rf "$folder"' EXIT
mkdir "$XDG_RUNTIME_DIR"
cd "$folder" || exit 1
ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo || exit 1
state=$(prospect-supervisor folder)

fault() { echo "FAULT $*"; faults=$((faults + 1)); }
check() { checks=$((checks + 1)); "$@" || fault "not so: $*"; }

# says CODE TEXT COMMAND...: the command ends with CODE, and some line of what it says on stderr matches TEXT.
says() {
  local code=$1 text=$2 said got
  shift 2
  checks=$((checks + 1))
  said=$(timeout "${PROSPECT_TEST_SECONDS:-60}" "$@" 2>&1 >/dev/null </dev/null)
  got=$?
  [ "$got" = "$code" ] && grep -qE -- "$text" <<<"$said" || fault "$* ended with $got (not $code), or said no \"$text\": $said"
}

# soon COMMAND...: it succeeds within ten seconds.
soon() {
  local turn
  checks=$((checks + 1))
  for turn in $(seq 200); do
    "$@" >/dev/null 2>&1 && return
    sleep 0.05
  done
  fault "not in ten seconds: $*"
}

lives() { kill -0 "$1" 2>/dev/null && [ "$(ps -o stat= -p "$1" | cut -c1)" != Z ]; }
gone() { local pid; for pid in "$@"; do ! lives "$pid" || return 1; done; }
of_state() { grep -o "\"$1\": [0-9]*" "$state/services.json" | grep -o '[0-9]*$'; }
up() { "$prospect" up --task navigation --weights scripted --workers 1 "$@" >up.log 2>&1; }

# --- Nothing is up: said soon, and with a line before it is believed.
began=$EPOCHSECONDS
says 15 'nothing is up on udpm://.*: ./prospect up' "$prospect" run
[ $((EPOCHSECONDS - began)) -le 8 ] || fault "run with nothing up took $((EPOCHSECONDS - began)) s"
says 15 'waiting for somebody' "$prospect" run
says 15 'nothing is up on udpm://.*: ./prospect up' "$prospect" scale workers=2
says 0 'nothing is up' "$prospect" down

# --- Numbers are decimal, and refused in the first line.
expect 2 '--seed wants a whole number.*0x10' "$prospect" run --seed 0x10
expect 2 '--tower wants a whole number from 2 to 4' "$prospect" run --tower 5
expect 2 '--legs is not for stacking, which takes --tower' "$prospect" run --task stacking --legs 4
expect 2 '--workers wants a whole number from 1 to 1024' "$prospect" up --workers 00
expect 2 '--retries wants' "$prospect" run --retries ''

# --- A number in a file is not a process of ours: of an older version's file, and of services.json.
sleep 1000 &
stranger=$!
old=$XDG_RUNTIME_DIR/prospect-$(id -u)/udpm___239.255.76.67_7667_ttl_0_recv_buf_size_65536
mkdir -p "$old" "$state"
chmod 700 "$(dirname "$state")" "$state"
for planted in "$old" "$state"; do echo "$stranger" >"$planted/supervisor.pid"; done
echo "{\"supervisor_pid\": $stranger, \"deployment\": 5, \"services\": []}" >"$state/services.json"
echo 1 >"$old/deployment"
says 0 'nothing is up' "$prospect" down
check [ -e "$state/services.json" ]  # no supervisor was ever there: it is not ours to remove
touch "$state/prospect-supervisor.lock"
says 15 'nothing is up' "$prospect" scale workers=1
says 0 'nothing is up.*had crashed.*removed' "$prospect" down
check lives "$stranger"
check [ ! -e "$state/services.json" ]

# --- A state folder that somebody else could have planted.
mkdir "$folder/theirs"
echo precious >"$folder/theirs/services.json"
rm -rf "$state"
ln -s "$folder/theirs" "$state"
expect 13 'state folder.*it is a link' "$prospect" up --task navigation --weights scripted
expect 13 'state folder.*it is a link' "$prospect" down
expect 13 'state folder.*it is a link' "$prospect" run
rm "$state"
rm -rf "$(dirname "$state")"
ln -s "$folder/theirs" "$(dirname "$state")"
expect 13 'state folder.*it is a link' "$prospect" up --task navigation --weights scripted
rm "$(dirname "$state")"
mkdir -p "$state"
chmod 777 "$state"
expect 13 'state folder.*others may write' "$prospect" up --task navigation --weights scripted
[ "$(ls -A "$folder/theirs")" = services.json ] && [ "$(cat "$folder/theirs/services.json")" = precious ] ||
  fault "the folder behind the link was touched: $(ls -A "$folder/theirs")"
rm -rf "$state"

# --- Two at the same moment: one is up and can be reached, the other ends with 12 and touches nothing.
for round in 1 2 3; do
  for each in 1 2; do
    { "$prospect" up --task navigation --weights scripted --workers 1 >"up-$each.log" 2>&1; echo $? >"code-$each"; } &
    pids[each]=$!
  done
  wait "${pids[1]}" "${pids[2]}"
  [ "$(sort code-1 code-2 | tr '\n' ' ')" = '0 12 ' ] || fault "two up at once end with $(cat code-1 code-2): $(cat up-1.log up-2.log)"
  says 0 '2 workers' "$prospect" scale workers=02
  services=$(of_state pid)
  says 0 '^Down' "$prospect" down
  check gone $services
  check [ ! -e "$state/services.json" ]
done

# --- The key: made, shut, handed on, said; gone with the deployment. --open: said, and none.
up
grep -q -- "--key $state/key" up.log || fault "up does not say where the key is: $(cat up.log)"
check [ "$(stat -c %a "$state/key") $(stat -c %a "$state")" = '600 700' ]
check grep -qE '^[0-9a-f]{64}$' "$state/key"
for pid in $(of_state pid); do
  grep -zqx "PROSPECT_KEY_FILE=$state/key" "/proc/$pid/environ" || fault "process $pid has no key"
done
says 12 'already up on this bus' "$prospect" up --task navigation --weights scripted

# --- What run asks must not contradict what is up; without contradiction it says where its files are.
expect 2 '--task stacking, but navigation is up' "$prospect" run --task stacking
expect 2 '--weights .*stacking.safetensors, but .*scripted' "$prospect" run --weights "${prospect%/*}/model/weights/stacking.safetensors"
expect 2 '--workers 4, but 1 are up.*scale workers=4' "$prospect" run --workers 4
expect 2 "unknown option '--factor'; ./prospect up has it" "$prospect" run --factor light --strength 2
expect 2 "unknown option '--open'; ./prospect up has it" "$prospect" run --open
expect 2 '--no-reset takes the scene as it is' "$prospect" run --no-reset --objects 5
says 4 '^Files in site: .*result.json' "$prospect" run --task navigation --policy plan:0 --out site
says 2 'but navigation is up' prospect-executive --key "$state/key" --task stacking --policy plan:0

# --- Beside a deployment, demos and explanations have a bus of their own: in a namespace, and where there can be none, by a port.
without_namespaces() { unshare -r bash -c 'echo 0 >/proc/sys/user/max_net_namespaces && exec "$@"' - "$@"; }
heard_before=$("$prospect" status | grep -c ready)
alone=(--task navigation --weights scripted --workers 1 --policy plan:0)
"$prospect" demo "${alone[@]}" --out demo-1 >demo-1.log 2>&1 &
first=$!
without_namespaces "$prospect" demo "${alone[@]}" --out demo-2 >demo-2.log 2>&1 &
second=$!
without_namespaces "$prospect" demo "${alone[@]}" --out demo-3 >demo-3.log 2>&1 &
third=$!
for demo in "$first" "$second" "$third"; do
  checks=$((checks + 1))
  wait "$demo" || [ $? = 4 ] || fault "a demo beside others: $(tail -n 3 demo-*.log)"
done
[ "$heard_before" = 3 ] && [ "$("$prospect" status | grep -c ready)" = 3 ] || fault 'the deployment heard a demo'
says 0 '' "$prospect" status
for demo in 1 2 3; do check [ -s demo-$demo/episode.lcmlog ]; done
check [ "$(ls "$XDG_RUNTIME_DIR/prospect")" = "$(basename "$state")" ]
says 0 '^Down' "$prospect" down
check [ ! -e "$state/key" ]
says 0 '^Files in alone: .*explain.html' "$prospect" explain --task navigation --weights scripted --workers 1 --out alone

# --- A demo that is killed leaves nobody behind.
"$prospect" demo --task navigation --weights scripted --workers 1 --chaos 'delay=2000ms' --out killed >/dev/null 2>&1 &
demo=$!
soon compgen -G "$XDG_RUNTIME_DIR/prospect/private-*/services.json"
services=$(grep -ho '"[a-z_]*pid": [0-9]*' "$XDG_RUNTIME_DIR"/prospect/private-*/services.json | grep -o '[0-9]*$')
kill -KILL "$demo"
wait "$demo" 2>/dev/null
soon gone $services
no_private_folder() { ! compgen -G "$XDG_RUNTIME_DIR/prospect/private-*"; }
soon no_private_folder

# --- A recorder that does not end does not keep a demo that is over.
mkdir deaf
printf '#!/bin/bash\ntrap "" INT TERM\nexec sleep 1000\n' >deaf/lcm-logger
chmod +x deaf/lcm-logger
PATH=$folder/deaf:$PATH says 4 '^Files in deafened' timeout 50 "$prospect" demo "${alone[@]}" --policy plan:77 --out deafened
# ... nor a recording that is to end: it is not told so by 137, after 20 s.
PATH=$folder/deaf:$PATH says 13 'the recording has ended' timeout --preserve-status -k 20 1 "$prospect" record deaf.lcmlog

# --- Services that another has up are joined by what they say, and only for their own task.
elsewhere=$XDG_RUNTIME_DIR/prospect/elsewhere
prospect-supervisor --background --open --state "$elsewhere" --task navigation --weights scripted --workers 1 2>/dev/null ||
  fault 'services elsewhere did not start'
prospect-bus wait --services simulator=1,model=1,worker=1 --seconds 20 || fault 'services elsewhere are not heard'
says 2 '--task stacking, but navigation is up' "$prospect" run --task stacking --policy plan:0 --out another
says 4 '^Files in another: ' "$prospect" run --task navigation --policy plan:0 --out another
prospect-supervisor stop --state "$elsewhere" 2>/dev/null

# --- A supervisor that crashed: its services end, the next up says so and takes over.
up
supervisor=$(of_state supervisor_pid)
services=$(of_state pid)
kill -KILL "$supervisor"
soon gone $services
says 15 'nothing is up' "$prospect" run
up --open
grep -q 'earlier deployment crashed' up.log || fault "the crash is not said: $(cat up.log)"
grep -q 'open.*can move the robot' up.log || fault "an open bus is not said: $(cat up.log)"
check [ ! -e "$state/key" ]
for pid in $(of_state pid); do
  ! grep -zq '^PROSPECT_KEY_FILE=.' "/proc/$pid/environ" || fault "process $pid has a key"
done
says 0 '^Down' "$prospect" down
check lives "$stranger"
finish
