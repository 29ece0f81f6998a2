#!/usr/bin/env bash
# How long a decision takes through all processes: simulator, model server, two planner workers and executive on a bus of their
# own, one episode a scene, stacking with 10 rollouts a search. Prints the quantiles of all searches' times, from SEARCH_ROOT to
# the agreed plan or refusal; the bound is 0.5 s for the 95th percentile. SCENES (default 40), SEED (default 2000400, never
# trained on) and SAMPLES (default 10) by environment. Exit status 5 when the bound is missed. Needs idle cores.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
export OUT=${OUT:-$(mktemp -d)} SCENES=${SCENES:-40} SEED=${SEED:-2000400} SAMPLES=${SAMPLES:-10}
mkdir -p "$OUT"
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1

episodes() {
  ./prospect up --task stacking >"$OUT/up.log" 2>&1 || { cat "$OUT/up.log" >&2; exit 1; }
  trap './prospect down >/dev/null' EXIT
  for ((seed = SEED; seed < SEED + SCENES; ++seed)); do
    # A scene that is refused or fails ends with an exit code of its own; its searches count like the others.
    ./prospect run --seed "$seed" --samples "$SAMPLES" --out "$OUT/$seed" >"$OUT/$seed.log" 2>&1 || true
  done
}
export -f episodes
cd "$ROOT"
tests/integration/with_bus.sh bash -c 'set -euo pipefail; episodes'

python3 - "$OUT" <<'PY'
import collections, glob, json, sys
files = sorted(glob.glob(sys.argv[1] + "/*/result.json"))
episodes = [json.load(open(file)) for file in files]
seconds = sorted(search["seconds"] for episode in episodes for search in episode["searches"])
if not seconds:
    sys.exit("no search ended; see " + sys.argv[1])
at = lambda share: seconds[min(len(seconds) - 1, int(share * len(seconds)))]
print(f"{len(seconds)} searches in {len(files)} episodes:", dict(collections.Counter(e["outcome"] for e in episodes)))
print("seconds a decision: " + ", ".join(f"{name} {at(share):.3f}" for name, share in
      (("least", 0), ("median", 0.5), ("75 %", 0.75), ("90 %", 0.9), ("95 %", 0.95), ("99 %", 0.99), ("most", 1))))
good = at(0.95) <= 0.5
print(f"{'ok  ' if good else 'MISS'} 95th percentile {at(0.95):.3f} s (at most 0.5); over 0.5 s: {sum(s > 0.5 for s in seconds)}")
sys.exit(0 if good else 5)
PY
