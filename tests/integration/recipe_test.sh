#!/usr/bin/env bash
# train --recipe with a recipe of two runs, some steps each: stopped in the second, it goes on there, and what ended before stays as
# it was.
#   recipe_test.sh BIN
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=${here%/tests/integration}
bin=$1
. "$here/support/expect.sh"
export PATH="$bin:$PATH" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
fault() { echo "FAULT $*"; faults=$((faults + 1)); }

# Both runs of navigation's recipe, each stage cut to two iterations.
python3 - "$root/recipes/navigation.json" <<'PY' || exit 1
import json, sys
recipe = json.load(open(sys.argv[1]))
for run in recipe["runs"]:
    for stage in ("classifier", "encoder_decoder", "transform_hidden", "transform_image", "heads"):
        run["config"][stage].update(iterations=2, batch=2)
json.dump(recipe, open("tiny.json", "w"))
PY
prospect-data collect --task navigation --trials 30 --seed 0 --jobs 1 --out some.h5 >/dev/null 2>&1 || exit 1
train=(prospect-train train --recipe tiny.json --data some.h5 --out run --threads 1)
first=run/first/navigation.safetensors last=run/longer/navigation.safetensors

expect 2 'recipe.*(excludes|not.*from)|from.*recipe' "${train[@]}" --from "$root/model/weights/navigation.safetensors"
expect 2 'absent.json: cannot be read' prospect-train train --recipe absent.json --data some.h5 --out run

# Stopped as soon as the first run has ended.
"${train[@]}" >log 2>&1 &
pid=$!
for _ in $(seq 1200); do [ -e "$first" ] || ! kill -0 "$pid" 2>/dev/null && break; sleep 0.1; done
kill -9 "$pid" 2>/dev/null
wait "$pid" 2>/dev/null
[ -e "$first" ] || fault "the first run does not end: $(tail -n 3 log)"
[ ! -e "$last" ] || echo "the second run had ended already: only going on after the end is tested"
before=$(sha256sum "$first"; stat -c %Y.%i "$first")

"${train[@]}" >log 2>&1 || fault "it does not go on: $(tail -n 3 log)"
[ -e "$last" ] || fault 'the second run left no weights'
[ "$(sha256sum "$first"; stat -c %Y.%i "$first")" = "$before" ] || fault 'the first run was written again'
grep -q "run 'first'" log && fault 'the first run was trained again'
grep -q "^Next: ./prospect evaluate calibrate --task navigation --weights $last" log || fault "what comes next is not told: $(tail -n 5 log)"
python3 - "$last" <<'PY' || fault 'the last weights do not tell of the first run'
import json, struct, sys
with open(sys.argv[1], "rb") as file:
    header = json.loads(file.read(struct.unpack("<Q", file.read(8))[0]))
history = json.loads(header["__metadata__"]["prospect"])["history"]
assert len(history) == 1 and not history[0]["train"]["network"]["transform_mask"], history
PY
finish
