#!/usr/bin/env bash
# Processes killed in the middle of a search: how fast it goes on, as ratios and times beside their bars:
#   tests/benchmarks/deaths.sh [REPEATS] [BUILD_FOLDER]      (default 5, build/release; 40 s a repeat)
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "${2:-$root/build/release}" && pwd)
exec "$root/tests/integration/with_bus.sh" "$build/tests/deaths_bench" "${1:-5}"
