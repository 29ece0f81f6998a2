#!/usr/bin/env bash
# Back-to-back searches with a bad network at every process, and what each process holds after each third of the time:
#   tests/benchmarks/soak.sh [SECONDS] [BUILD_FOLDER]      (default 1200, build/release)
# Fails when resident memory, open files or caches of any process grow.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "${2:-$root/build/release}" && pwd)
PROSPECT_SOAK_SECONDS=${1:-1200} exec "$root/tests/integration/with_bus.sh" "$build/tests/faults_soak_test"
