# Builds what a command needs, when it is first asked for. The release preset builds its tests only once a test run has asked
# for them. With PROSPECT_BUILD=FOLDER the programs of that build folder are used as they are.

# Whether one of these targets trains or scores networks, which takes libtorch: neither its packages nor its build are wanted
# before.
trains() {
  local target
  for target; do case "$target" in prospect-train | all) return 0 ;; esac; done
  return 1
}

# need_packages TARGET...: installs what it takes to build and run these.
need_packages() {
  if trains "$@"; then install_packages build run train; else install_packages build run; fi
}

# build PRESET TARGET...: brings these up to date. With TESTS=1 the tests are among what can be built.
build() {
  local preset=$1 log="$ROOT/build/$1.log" TRAINING=${TESTS:-}
  shift
  ! trains "$@" || TRAINING=1
  [ -n "${PROSPECT_BUILD:-}" ] && return 0
  mkdir -p "$ROOT/build" || die 13 "cannot write to $ROOT/build"
  # One at a time in a folder: two would write the same files.
  {
    flock -n 9 || { say "Waiting for another build of $ROOT/build/$preset"; until flock -w 20 9; do say "still waiting; it is at: $(tail -n 1 "$log" 2>/dev/null | cut -c1-60)"; done; }
    configure "$preset" "$log" 9>&- && run_ninja "$preset" "$log" "$@" 9>&-
  } 9>"$ROOT/build/$preset.lock"
}

# need_build PROGRAM...: builds those that are not there.
need_build() {
  local program missing=()
  for program; do [ -x "$BIN/$program" ] || missing+=("$program"); done
  [ ${#missing[@]} = 0 ] || [ -n "${PROSPECT_BUILD:-}" ] && return 0
  need_packages "${missing[@]}" && build release "${missing[@]}"
}

cached() { sed -n "s/^$2:[A-Z]*=//p" "$1/CMakeCache.txt" 2>/dev/null; }

# configure PRESET LOG: a folder that is new, that lacks tests or training and is to have them, or that came here from elsewhere:
# CMake keeps the place of the sources, and would go on with those of the old place.
configure() {
  local preset=$1 log=$2 dir="$ROOT/build/$1" tests=OFF training=OFF home
  home=$(cached "$dir" CMAKE_HOME_DIRECTORY)
  [ -n "${TESTS:-}" ] || [ "$(cached "$dir" PROSPECT_TESTS)" = ON ] && tests=ON
  [ -n "$TRAINING" ] || [ "$(cached "$dir" PROSPECT_TRAINING)" = ON ] && training=ON
  if [ -n "$home" ] && [ ! "$home" -ef "$ROOT" ]; then
    say "build/$preset was made for $home: configuring it anew for $ROOT"
    rm -rf "$dir/CMakeCache.txt" "$dir/CMakeFiles" "$dir/build.ninja"
  fi
  [ -f "$dir/build.ninja" ] && [ "$(cached "$dir" PROSPECT_TESTS)" = "$tests" ] &&
    [ "$(cached "$dir" PROSPECT_TRAINING)" = "$training" ] && return 0
  (cd "$ROOT" && cmake --preset "$preset" "-DPROSPECT_TESTS=$tests" "-DPROSPECT_TRAINING=$training") >"$log" 2>&1 ||
    { tail -n 30 "$log" >&2; die 2 "The build could not be configured; the whole log: $log"; }
}

# Of the targets given, those that this build has: the spy's types need Java.
known_targets() {
  local dir=$1 target
  shift
  for target; do grep -q "^build $target: phony" "$dir/build.ninja" && echo "$target"; done
}

# run_ninja PRESET LOG TARGET...
run_ninja() {
  local preset=$1 log=$2 dir="$ROOT/build/$1" targets
  shift 2
  targets=$(known_targets "$dir" "$@")
  if [ "$(wc -w <<<"$targets")" -lt $# ]; then  # a program that is new in the sources?
    (cd "$dir" && ninja build.ninja) >"$log" 2>&1 || { tail -n 30 "$log" >&2; die 2 "The build could not be configured; the whole log: $log"; }
    targets=$(known_targets "$dir" "$@")
  fi
  [ -n "$targets" ] || return 0
  (cd "$dir" && NINJA_STATUS='[%f/%t] ' ninja $targets) 2>&1 | tee "$log" | tell_progress "$preset" "${log#"$ROOT"/}"
  [ "${PIPESTATUS[0]}" = 0 ] && return 0
  grep -E 'error|FAILED' -A 8 "$log" | head -n 60 >&2
  die 2 "The build failed; the whole log: $log"
}

# tell_progress PRESET LOG: reads ninja's lines and says how far it is: on a terminal in one line that is written over, elsewhere
# every 20 seconds. Nothing is said where nothing is built.
tell_progress() {
  local line at=0 total=0 begun=$SECONDS told=$SECONDS ended=
  while [ -z "$ended" ]; do
    read -r -t "${TELL_EVERY:-20}" line || { [ $? -gt 128 ] || ended=1; line=; }
    # Looking for new files and asking CMake again are no building.
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\ (.*) ]] && [[ ${BASH_REMATCH[3]} != Re-* ]]; then
      [ "$total" != 0 ] || say "Building ($1), ${BASH_REMATCH[2]} steps; log: $2"
      at=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
    fi
    [ "$total" != 0 ] || continue
    if [ -t 2 ]; then
      printf '\r%-79s' "building $at of $total$(time_left "$at" "$total" $((SECONDS - begun)))" >&2
    elif [ $((SECONDS - told)) -ge "${TELL_EVERY:-20}" ] && [ -z "$ended" ]; then
      told=$SECONDS
      say "building $at of $total$(time_left "$at" "$total" $((SECONDS - begun)))"
    fi
  done
  [ "$total" = 0 ] || [ ! -t 2 ] || printf '\r%79s\r' '' >&2
}

# time_left DONE TOTAL SECONDS: words, once enough was done to tell.
time_left() {
  [ "$1" -ge 5 ] && [ $(($1 * 20)) -ge "$2" ] || return 0
  local left=$(($3 * ($2 - $1) / $1))
  if [ "$left" -lt 60 ]; then printf ', less than a minute left'; else printf ', about %d min left' $(((left + 59) / 60)); fi
}
