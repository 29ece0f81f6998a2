#!/usr/bin/env bash
# Every message type's decoder under libFuzzer with address and undefined-behaviour sanitizers:
#   tests/fuzz/libfuzzer.sh [RUNS_PER_TYPE] [BUILD_FOLDER]      (default 60000: a million over all types; build/fuzz)
# Needs clang and libclang-rt-14-dev. Refuses allocations above 64 MB. What it finds it leaves in BUILD_FOLDER.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
runs=${1:-60000}
build=${2:-$root/build/fuzz}
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang \
  -DPROSPECT_FUZZ=ON >/dev/null
ninja -C "$build" fuzzers | tail -n 1
cd "$build"
for fuzzer in bin/fuzz_decode_*; do
  type=${fuzzer#bin/fuzz_decode_}
  mkdir -p "fuzz-corpus/$type"
  "$fuzzer" -seed=1 -runs="$runs" -malloc_limit_mb=64 -max_len=20000 -verbosity=0 -print_final_stats=1 \
    "fuzz-corpus/$type" "$root/tests/fuzz/corpus/$type" >"fuzz-$type.log" 2>&1 ||
    { tail -n 40 "fuzz-$type.log"; echo "$type: FAILED, see $build/fuzz-$type.log"; exit 1; }
  printf '%-24s %s payloads, no fault\n' "$type" "$(sed -n 's/^stat::number_of_executed_units: *//p' "fuzz-$type.log")"
done
