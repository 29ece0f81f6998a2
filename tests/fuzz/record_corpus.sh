#!/usr/bin/env bash
# Records tests/fuzz/corpus anew from one real episode, for when a message type has changed:
#   tests/fuzz/record_corpus.sh [BUILD_FOLDER]        (default build/release; needs the programs and fuzz_split_log)
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "${1:-$root/build/release}" && pwd)
bin=$build/bin
work=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null; rm -rf "$work"' EXIT
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304'

if [[ -z ${PROSPECT_PRIVATE_BUS:-} ]]; then
  exec "$root/tests/integration/with_bus.sh" "$0" "$@"
fi
lcm-logger -q "$work/log" &
# Scripted weights carry no calibration; it is said in each of the first seconds.
timeout -s INT 4 "$bin/prospect-model-server" --weights "$root/model/weights/navigation.safetensors" >"$work/calibrated" 2>&1 || true
"$bin/prospect-simulator" --objects 7 >"$work/simulator" 2>&1 &
"$bin/prospect-model-server" --weights scripted:7 >"$work/model" 2>&1 &
for i in 1 2; do "$bin/prospect-worker" >"$work/worker$i" 2>&1 & done
"$bin/prospect-executive" --seed 1500000 --objects 7 --legs 3 --samples 150 --workers 2 --refusal-threshold 0 --out "$work/out" || true
kill -INT %1
wait %1 || true
rm -rf "$root/tests/fuzz/corpus"
# A simulator judges its actions itself, so nobody is asked: a person's word is made, and may be missing in the log, alone.
"$build/tests/fuzz_split_log" "$work/log" "$root/tests/fuzz/corpus" 2>"$work/missing" || true
if [[ $(<"$work/missing") != "no verdict_t in the log" ]]; then
  cat "$work/missing" >&2
  exit 14
fi
mkdir -p "$root/tests/fuzz/corpus/verdict_t"
PYTHONPATH="$build/share/python" python3 - "$root/tests/fuzz/corpus/verdict_t/1" <<'PYTHON'
import sys
from prospect import verdict_t
word = verdict_t()
word.utime, word.executive_id, word.command_id, word.episode_id, word.action, word.succeeded = 1764500000000000, 7 << 40, 3, 5 << 40, 2, True
open(sys.argv[1], "wb").write(word.encode())
PYTHON
du -sh --apparent-size "$root/tests/fuzz/corpus"
