# ./prospect record: lcm-logger with the exit codes of the other commands.

record_usage() {
  cat <<'TEXT'
usage: ./prospect record [--bus URL] [OPTION...] FILE
Writes every message on the bus to FILE, as lcm-logger does, until Ctrl-C. A FILE that is there already is kept and
nothing recorded, unless -f (overwrite) or -a (append) is given. Further options of lcm-logger: -c CHANNELS (a regular expression), -q (quiet), ...
Play it again with ./prospect replay FILE.
TEXT
}

# record_bus [--bus URL] [OPTION...] FILE. Ctrl-C or SIGTERM closes the file; 13 when it cannot be written.
record_bus() {
  local url=${LCM_DEFAULT_URL:-$DEFAULT_BUS} said code=0 pass=()
  while [ $# -gt 0 ]; do
    case "$1" in
      -h | --help) record_usage; return 0 ;;
      --bus) [ $# -ge 2 ] || die 2 "--bus needs a value"; url=$2; shift ;;
      --bus=*) url=${1#--bus=} ;;
      *) pass+=("$1") ;;
    esac
    shift
  done
  [ ${#pass[@]} -gt 0 ] || die 2 "record needs a file: ./prospect record [--bus URL] FILE"
  said=$(mktemp) || die 13 "no room for a temporary file in ${TMPDIR:-/tmp}"
  # timeout hands TERM on, and KILL 5 s later if it has not helped.
  timeout -k 5 infinity lcm-logger --lcm-url="$url" "${pass[@]}" 2>"$said" &
  local logger=$!
  # Not INT: what a shell starts in the background ignores that one until it has its own handler.
  trap 'kill -TERM $logger 2>/dev/null' INT TERM
  # A signal ends the first wait; the second one waits for the file to be closed.
  wait "$logger" 2>/dev/null || wait "$logger" 2>/dev/null || code=$?
  local words
  words=$(cat "$said")
  rm -f "$said"
  if [ "$code" = 0 ] || grep -q '^usage:' <<<"$words"; then
    say "$words"
    return $((code == 0 ? 0 : 2))
  fi
  local last
  last=$(grep -v '^Logger exiting' <<<"$words" | tail -n 1)
  die 13 "the recording has ended: ${last:-lcm-logger: exit code $code}; make room or give a file that can be written (-f overwrites)"
}
