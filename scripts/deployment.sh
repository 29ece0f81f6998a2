# A deployment: the processes that one `up` started on one bus. Its state lives in a folder per bus, so that `down`, `run` and
# `status` of a later shell find it.

DEFAULT_BUS='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304'

# State folder of the bus in $BUS.
state_dir() {
  printf '%s/prospect-%s/%s' "${XDG_RUNTIME_DIR:-/tmp}" "$(id -u)" "$(printf '%s' "$BUS" | tr -c 'A-Za-z0-9.\n' '_')"
}

# Whether a multicast route for the bus exists; LCM's own failure without one is a null pointer and a long message.
has_multicast_route() {
  local host=${BUS#*://}
  host=${host%%[:/?]*}
  case "$BUS" in udpm://*) ip route get "$host" >/dev/null 2>&1 ;; *) true ;; esac
}

# The faults in $CHAOS for the process of this number: seeds move on, so that processes do not all miss the same messages.
chaos_for() {
  local text=${CHAOS:-} rest=
  while [[ $text =~ ^(.*)seed=([0-9]+)(.*)$ ]]; do
    text=${BASH_REMATCH[1]}
    rest="seed=$((BASH_REMATCH[2] + $1))${BASH_REMATCH[3]}$rest"
  done
  printf '%s' "$text$rest"
}

# start_service NAME PROGRAM ARGS...: in the background, one log a service, its process id in the state folder.
start_service() {
  local name=$1
  shift
  setsid "$@" >"$LOGS/$name.log" 2>&1 </dev/null &
  echo "$!" >"$STATE/$name.pid"
}

# Whether any process of this deployment still lives.
deployment_alive() {
  local file
  for file in "$STATE"/*.pid; do
    [ -e "$file" ] && kill -0 "$(cat "$file")" 2>/dev/null && return 0
  done
  return 1
}

# up TASK WORKERS WEIGHTS [simulator arguments]: starts every service of a deployment.
start_deployment() {
  local task=$1 workers=$2 weights=$3 i
  shift 3
  STATE=$(state_dir) LOGS=${LOGS:-$STATE/logs}
  mkdir -p "$STATE" "$LOGS"
  deployment_alive && die 12 "A deployment of yours is already up on this bus: ./prospect down, or another port with --bus"
  rm -f "$STATE"/*.pid
  PROSPECT_DEPLOYMENT=$(od -An -N7 -tu8 /dev/urandom | tr -d ' ')
  export PROSPECT_DEPLOYMENT
  printf '%s\n' "$PROSPECT_DEPLOYMENT" >"$STATE/deployment"
  printf '%s\n' "$task" >"$STATE/task"
  start_service model "$BIN/prospect-model-server" --bus "$BUS" --chaos "$(chaos_for 1)" --weights "$weights"
  start_service simulator "$BIN/prospect-simulator" --bus "$BUS" --chaos "$(chaos_for 2)" --task "$task" "$@"
  for ((i = 1; i <= workers; ++i)); do
    start_service "worker-$i" "$BIN/prospect-worker" --bus "$BUS" --chaos "$(chaos_for $((i + 2)))"
  done
}

# After an episode that missed a service: names the services of this shell that ended on their own, with their last words, and
# returns the first one's exit status (0: none did).
dead_service_status() {
  local file name status first=0
  for file in "$STATE"/*.pid; do
    kill -0 "$(cat "$file")" 2>/dev/null && continue
    wait "$(cat "$file")"
    status=$?
    name=$(basename "$file" .pid)
    say "prospect: $name ended: $(tail -n 1 "$LOGS/$name.log")"
    [ "$first" = 0 ] && first=$status
  done
  return "$first"
}

# Stops every process: a polite signal first, a hard one after five seconds.
stop_deployment() {
  local file pid waited=0
  STATE=$(state_dir)
  for file in "$STATE"/*.pid; do
    [ -e "$file" ] && kill -TERM "$(cat "$file")" 2>/dev/null
  done
  while deployment_alive && [ "$waited" -lt 50 ]; do
    sleep 0.1
    waited=$((waited + 1))
  done
  for file in "$STATE"/*.pid; do
    [ -e "$file" ] || continue
    pid=$(cat "$file")
    kill -0 "$pid" 2>/dev/null && kill -KILL "$pid" 2>/dev/null
    rm -f "$file"
  done
  rm -f "$STATE/deployment" "$STATE/task"
}
