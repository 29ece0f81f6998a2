# A deployment: the processes that one `up` started on one bus. prospect-supervisor starts them, keeps them and knows, by a lock in
# the deployment's state folder, whether it lives; here it is only asked.

DEFAULT_BUS='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304'
PATH=$PATH:/usr/sbin:/sbin  # where ip lives
LOGS= JOINS= FOREGROUND= PRIVATE_STATE= UP_TASK= UP_WORKERS=

# Whether a multicast route for the bus exists; LCM's own failure without one is a null pointer and a long message.
has_multicast_route() {
  local host=${BUS#*://}
  host=${host%%[:/?]*}
  case "$BUS" in udpm://*) ip route get "$host" >/dev/null 2>&1 ;; *) true ;; esac
}

# deployment COMMAND...: asks about or of the deployment on $BUS, or of this command's own.
deployment() { "$BIN/prospect-supervisor" "$1" --bus "$BUS" ${PRIVATE_STATE:+--state "$PRIVATE_STATE"} "${@:2}"; }

# join_deployment [WISH...]: what is started from here on belongs to the deployment of ours that is up, and has its key. UP_TASK and
# UP_WORKERS say what it is. Fails when none is up; ends the command when it is not as wished for or not to be trusted.
join_deployment() {
  local said code name value
  said=$(deployment join "$@" 2>&1)
  code=$?
  case "$code" in
    0) ;;
    15 | 126 | 127) return 1 ;;  # none is up, or nothing is built
    *) die "$code" "${said#error: }" ;;
  esac
  unset PROSPECT_KEY_FILE
  while IFS='=' read -r name value; do
    case "$name" in
      deployment) export PROSPECT_DEPLOYMENT=$value ;;
      key) [ -z "$value" ] || export PROSPECT_KEY_FILE=$value ;;
      task) UP_TASK=$value ;;
      workers) UP_WORKERS=$value ;;
      logs) LOGS=$value ;;
    esac
  done <<<"$said"
}

# start_deployment TASK WORKERS WEIGHTS [simulator arguments]: a supervisor, which starts every service and keeps it running.
# With FOREGROUND=1 it takes this shell's place and Ctrl-C stops everything.
start_deployment() {
  local start=("$BIN/prospect-supervisor" --bus "$BUS" --chaos "${CHAOS:-}" --task "$1" --workers "$2" --weights "$3"
    ${PRIVATE_STATE:+--state "$PRIVATE_STATE" --lives-with "$$"} ${LOGS:+--logs "$LOGS"} ${NO_SIMULATOR:-} ${PLAYER:-} ${OPEN:-})
  shift 3
  [ -z "$FOREGROUND" ] || exec "${start[@]}" -- "$@"
  "${start[@]}" --background -- "$@" || exit
  join_deployment || die 15 "what was just started has ended: see supervisor.log in ${LOGS:-$(deployment folder)/logs}"
}

# Stops every process: politely first, then not.
stop_deployment() {
  deployment stop >/dev/null 2>&1
  [ -z "$PRIVATE_STATE" ] || rm -rf -- "$PRIVATE_STATE"
}

# After an episode that missed a service: names the services that the supervisor gave up, with their last words, and returns the
# first one's exit status (0: none was given up).
dead_service_status() { deployment given-up; }

# end_process PID SECONDS: a child of this shell ends, by SIGKILL when it does not by SIGTERM.
end_process() {
  local turns=$(($2 * 20))
  kill -TERM "$1" 2>/dev/null
  while kill -0 "$1" 2>/dev/null && [ "$turns" -gt 0 ]; do
    sleep 0.05
    turns=$((turns - 1))
  done
  kill -KILL "$1" 2>/dev/null
  wait "$1" 2>/dev/null
}

# own_bus COMMAND ARGUMENT...: from here on the command has a bus and a state folder that are nobody else's: a network namespace,
# into which it is started anew, or where none is allowed a port that nobody uses. A bus that --bus names is taken as it is.
own_bus() {
  unset PROSPECT_DEPLOYMENT
  PRIVATE_STATE=${PROSPECT_PRIVATE:-}
  [ -z "$PRIVATE_STATE" ] || return 0  # the second time, in the namespace
  PRIVATE_STATE=$("$BIN/prospect-supervisor" folder --private) || exit
  trap 'rm -rf -- "$PRIVATE_STATE"' EXIT
  [ -n "$OWN_BUS" ] || { need_bus; return; }
  BUS=$DEFAULT_BUS
  local flags loopback='ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo'
  for flags in -n -rn; do
    unshare $flags bash -c "$loopback" >/dev/null 2>&1 || continue
    PROSPECT_PRIVATE=$PRIVATE_STATE PROSPECT_BUILD=${BIN%/bin} LCM_DEFAULT_URL=$BUS \
      exec unshare $flags bash -c "$loopback"' && exec "$@"' - "$0" "$@"
  done
  need_bus
  BUS=${BUS/:7667/:$(free_port)}
}

# A UDP port that no socket of this host is bound to, below those that the kernel gives out.
free_port() {
  local port
  while :; do
    port=$((20000 + (RANDOM * 32768 + RANDOM) % 12000))
    grep -q "^ *[0-9]*: [0-9A-F]*:$(printf '%04X' "$port") " /proc/net/udp || break
  done
  printf '%s' "$port"
}
