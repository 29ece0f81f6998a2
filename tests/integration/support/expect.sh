# For tests of command lines: what a program says and how it ends. Sourced.
#
#   expect CODE TEXT COMMAND...   The command ends with CODE and its stderr is one line that matches TEXT (an extended
#                                 regular expression). A usage error of the option parser may add its own second line,
#                                 "Run with --help for more information."; lines of progress before it do not count.
#                                 PROSPECT_TEST_SECONDS: how long a command may take (60).
#   finish                        Says what was wrong and ends with 1, or ends with 0.

checks=0
faults=0

# Lines of progress end before the line that says what is wrong.
without_progress() { grep -vE '^[0-9]+ of [0-9]+ .*[0-9]:[0-9]{2} left|^reading labels|^[a-z-]+ +[0-9]+/[0-9]+ ' || true; }

expect() {
  local code=$1 text=$2 got said lines
  shift 2
  checks=$((checks + 1))
  said=$(timeout "${PROSPECT_TEST_SECONDS:-60}" "$@" 2>&1 >/dev/null </dev/null | tr '\r' '\n' | without_progress; exit "${PIPESTATUS[0]}")
  got=$?
  lines=$(grep -cvE '^Run with --help for more information\.$' <<<"$said")
  [ "$got" = "$code" ] && [ "$lines" = 1 ] && grep -qE -- "$text" <<<"$said" && return
  faults=$((faults + 1))
  printf 'FAULT %s\n  exit code %s (not %s), or not one line with "%s":\n%s\n' "$*" "$got" "$code" "$text" "$said"
}

finish() {
  echo "$checks checks, $faults faults"
  [ "$faults" = 0 ]
  exit
}
