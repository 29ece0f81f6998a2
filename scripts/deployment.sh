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

# Whether the supervisor of this deployment still lives.
deployment_alive() { [ -r "$STATE/supervisor.pid" ] && kill -0 "$(cat "$STATE/supervisor.pid")" 2>/dev/null; }

# start_deployment TASK WORKERS WEIGHTS [simulator arguments]: a supervisor, which starts every service and keeps it running.
# With FOREGROUND=1 it takes this shell's place and Ctrl-C stops everything.
start_deployment() {
  local task=$1 workers=$2 weights=$3
  shift 3
  STATE=$(state_dir) LOGS=${LOGS:-$STATE/logs}
  mkdir -p "$STATE" "$LOGS" || die 13 "cannot write to $STATE or $LOGS"
  deployment_alive && die 12 "A deployment of yours is already up on this bus: ./prospect down, or another port with --bus"
  rm -f "$STATE"/services.json "$STATE/workers" "$LOGS"/*.log
  PROSPECT_DEPLOYMENT=$(od -An -N7 -tu8 /dev/urandom | tr -d ' ')
  export PROSPECT_DEPLOYMENT
  printf '%s\n' "$PROSPECT_DEPLOYMENT" >"$STATE/deployment"
  printf '%s\n' "$task" >"$STATE/task"
  set -- "$BIN/prospect-supervisor" --bus "$BUS" --chaos "${CHAOS:-}" --task "$task" --weights "$weights" --workers "$workers" \
    --state "$STATE" --logs "$LOGS" ${NO_SIMULATOR:-} ${PLAYER:-} -- "$@"
  if [ -n "${FOREGROUND:-}" ]; then
    echo "$$" >"$STATE/supervisor.pid"
    exec "$@"
  fi
  setsid "$@" >"$LOGS/supervisor.log" 2>&1 </dev/null &
  echo "$!" >"$STATE/supervisor.pid"
}

# After an episode that missed a service: names the services that the supervisor gave up, with their last words, and returns the
# first one's exit status (0: none was given up).
dead_service_status() {
  local line status first=0
  while IFS=$'\t' read -r name status line; do
    say "prospect: $name ended: $line"
    [ "$first" = 0 ] && first=$status
  done < <(cat "$STATE/given_up" 2>/dev/null)
  return "$first"
}

# Stops every process: the supervisor does it, politely first, within five seconds.
stop_deployment() {
  local waited=0
  STATE=$(state_dir)
  deployment_alive && kill -TERM "$(cat "$STATE/supervisor.pid")"
  while deployment_alive && [ "$waited" -lt 80 ]; do
    sleep 0.1
    waited=$((waited + 1))
  done
  deployment_alive && kill -KILL "$(cat "$STATE/supervisor.pid")"  # its children hear of its death
  rm -f "$STATE"/{supervisor.pid,deployment,task,services.json,workers,given_up}
}
