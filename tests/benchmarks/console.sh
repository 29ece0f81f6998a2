#!/usr/bin/env bash
# What an open page costs a search: pairs of searches of SAMPLES rollouts by WORKERS workers with the real networks, one without
# and one with the page open in Chromium (or, STALLED=1, with a viewer that never reads), in turns. Prints the median ratio of
# rollouts a second, asked at least 0.95 (0.99 where stalled), and the console's share of a core while nothing moves, asked
# below 5 %. PAIRS (default 12), SAMPLES (1000), WORKERS (8), SEED (2000100) by environment. Exit status 5 when a bound is missed.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
export PYTHONPATH=$ROOT/tests/integration/console PYTHONDONTWRITEBYTECODE=1 PROSPECT_TEST_BIN=${PROSPECT_TEST_BIN:-$ROOT/build/release/bin}
exec "$ROOT/tests/integration/with_bus.sh" /usr/bin/python3 "$ROOT/tests/benchmarks/console.py" "$ROOT"
