#!/usr/bin/env bash
# How soon the console's page shows what is on the bus, how long it draws a frame of a large tree, and how soon a press of *stop*
# is on the bus: in Chromium, with the scripted engine and an example robot. Exit status 5 when a bound is missed.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
BUILD=${BUILD:-$ROOT/build/release}
export PYTHONPATH=$BUILD/share/python:$ROOT/tests/integration/console PYTHONDONTWRITEBYTECODE=1 PROSPECT_TEST_BIN=$BUILD/bin
exec "$ROOT/tests/integration/with_bus.sh" /usr/bin/python3 "$ROOT/tests/benchmarks/console_page.py" "$BUILD/examples/example-robot"
