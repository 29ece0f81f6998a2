# Configures and builds a preset. The release preset builds its tests only once a test run has asked for them.
# With PROSPECT_BUILD=FOLDER the programs of that build folder are used as they are.

# build PRESET [tests [TARGET]]
build() {
  local preset=$1 tests=${2:-} target=${3:-} dir="$ROOT/build/$1" log="$ROOT/build/$1.log" configure=()
  [ -n "${PROSPECT_BUILD:-}" ] && return 0
  mkdir -p "$ROOT/build"
  [ -n "$tests" ] && configure=(-DPROSPECT_TESTS=ON)
  [ ! -f "$dir/CMakeCache.txt" ] && [ -z "$tests" ] && configure=(-DPROSPECT_TESTS=OFF)
  if [ ${#configure[@]} -gt 0 ] || [ ! -f "$dir/build.ninja" ]; then
    (cd "$ROOT" && cmake --preset "$preset" "${configure[@]}") >"$log" 2>&1 ||
      { tail -n 30 "$log" >&2; die 2 "The build could not be configured; the whole log: $log"; }
  fi
  if [ "$(cd "$dir" && ninja -n $target 2>/dev/null | head -n 1)" = "ninja: no work to do." ]; then return 0; fi
  say "Building ($preset); log: ${log#"$ROOT"/}"
  if [ -t 2 ]; then
    (cd "$dir" && ninja $target) 2>&1 | tee "$log" | awk '/^\[/ { printf "\r%-79.79s", $0 > "/dev/stderr" } END { printf "\r%79s\r", "" > "/dev/stderr" }'
    [ "${PIPESTATUS[0]}" = 0 ]
  else
    (cd "$dir" && ninja $target) >"$log" 2>&1
  fi || { grep -E 'error|FAILED' -A 8 "$log" | head -n 60 >&2; die 2 "The build failed; the whole log: $log"; }
}
