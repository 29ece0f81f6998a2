# ./prospect record: lcm-logger with the exit codes of the other commands.

# record_bus URL [OPTION...] FILE. Ctrl-C or SIGTERM closes the file; 13 when it cannot be written.
record_bus() {
  local url=$1 said code=0
  shift
  case "${1:-}" in -h | --help) lcm-logger -h 2>&1 | grep -v "^lcm-logger: "; return 0 ;; esac
  said=$(mktemp) || die 13 "no room for a temporary file in ${TMPDIR:-/tmp}"
  lcm-logger --lcm-url="$url" "$@" 2>"$said" &
  local logger=$!
  trap 'kill -INT $logger 2>/dev/null' INT TERM
  # A signal ends the first wait; the second one waits for the file to be closed.
  wait "$logger" || wait "$logger" || code=$?
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
