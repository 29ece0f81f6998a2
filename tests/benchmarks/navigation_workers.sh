#!/usr/bin/env bash
# Navigation with 7 objects and 5 legs: solved share of the solvable sites against rollouts a search and workers that share it
# (in one process, tools/evaluate/crew_search.h), as a table in Markdown. SCENES (default 100) and JOBS (default all cores) by
# environment; WEIGHTS names other weights, V_FAILED (default 0.02, as everywhere; the paper's is 0.1) below which V ends a future. The oracle's verdicts are
# cached, so the first cell takes longest. Nothing is refused (THRESHOLD, default 0): the bundled threshold was calibrated on three legs,
# and scores fall with every leg.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
OUT=${OUT:-$(mktemp -d)}
for workers in 1 4; do
  for samples in 10 50 200 800; do
    "$ROOT/prospect" evaluate --task navigation --weights "${WEIGHTS:-$ROOT/model/weights/navigation.safetensors}" --objects 7 --legs 5 \
      --samples "$samples" --workers "$workers" --scenes "${SCENES:-100}" --jobs "${JOBS:-$(nproc)}" --rows planner \
      --threshold "${THRESHOLD:-0}" --v-failed "${V_FAILED:-0.02}" \
      --json "$OUT/$workers-$samples.json" >"$OUT/$workers-$samples.log"
  done
done
python3 - "$OUT" <<'PY'
import json, sys
cells = lambda w, s: json.load(open(f"{sys.argv[1]}/{w}-{s}.json"))
print("| rollouts a search | 1 worker | 4 workers |\n|---|---|---|")
for samples in (10, 50, 200, 800):
    row = [cells(w, samples) for w in (1, 4)]
    text = " | ".join("%.1f %% (%.1f to %.1f)" % (100 * r["solved_solvable"], *(100 * x for x in r["solved_solvable_interval"]))
                      for r in row)
    print(f"| {samples} | {text} |")
PY
