#!/usr/bin/env bash
# A run whose shares are done by several processes, put together by merge: what one process writes. And parts that do not belong
# together.
#   shards_test.sh PROSPECT ROOT
set -uo pipefail
prospect=$1 root=$2
. "$(dirname "$0")/support/expect.sh"
work=$(mktemp -d)
export PROSPECT_DATA=$work/data
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

fault() {
  faults=$((faults + 1))
  echo "FAULT $*"
}
does() {  # does COMMAND...: it ends with 0
  checks=$((checks + 1))
  local said
  said=$("$@" 2>&1 </dev/null) || fault "$* ends with $?: $said"
}
# The same reports, but for times that were measured.
same_reports() {  # same_reports A B
  checks=$((checks + 1))
  python3 - "$1" "$2" <<'PYTHON' || fault "$1 and $2 differ"
import json, sys

def untimed(value):
    if isinstance(value, dict):
        return {k: untimed(v) for k, v in value.items() if "seconds" not in k and "real_time" not in k}
    return [untimed(v) for v in value] if isinstance(value, list) else value

one, other = (untimed(json.load(open(name))) for name in sys.argv[1:])
differing = [k for k in one.keys() | other.keys() if one.get(k) != other.get(k)]
sys.exit(f"differing: {differing}" if differing or not one else 0)
PYTHON
}

# Data sets, byte for byte.
collect=("$prospect" collect --task navigation --objects mixed --trials 8 --seed 40)
does "${collect[@]}" --jobs 2 --out whole.h5
for i in 1 2 3; do does "${collect[@]}" --jobs 1 --shard "$i/3" --out "part$i.h5"; done
does "$prospect" merge part2.h5 part3.h5 part1.h5 --out merged.h5
checks=$((checks + 1))
cmp whole.h5 merged.h5 || fault 'the merged data set is another one'
checks=$((checks + 1))
grep -q '^part  *2 of 3' <<<"$("$prospect" dataset info part2.h5)" || fault 'dataset info does not tell a part'
grep -q '^part' <<<"$("$prospect" dataset info merged.h5)" && fault 'a merged data set is told as a part'
does "${collect[@]}" --foresight 0.5 --shard 3/3 --out other.h5
head -c 100000 part3.h5 >short.h5
expect 14 'part 3 of 3 is missing' "$prospect" merge part1.h5 part2.h5 --out x.h5
expect 14 'part2.h5: is part 2 of 3, and so is part2.h5' "$prospect" merge part1.h5 part2.h5 part2.h5 --out x.h5
expect 14 'other.h5: is not of the run of part1.h5: .*--foresight=0.5' "$prospect" merge part1.h5 part2.h5 other.h5 --out x.h5
expect 14 'short.h5: does not open' "$prospect" merge part1.h5 part2.h5 short.h5 --out x.h5
expect 14 'whole.h5: is no part' "$prospect" merge whole.h5 part1.h5 --out x.h5
expect 14 'none.h5: .*missing' "$prospect" merge none.h5 --out x.h5
expect 2 'more parts than the 8' "${collect[@]}" --shard 9/9 --out x.h5
expect 2 '--shard wants a part and their number.*9/3' "${collect[@]}" --shard 9/3 --out x.h5

# Reports, figure for figure.
alike() {  # alike NAME SHARDS COMMAND...
  local name=$1 shards=$2 i
  shift 2
  does "$@" --json "$name-whole.json"
  for i in $(seq "$shards"); do does "$@" --shard "$i/$shards" --json "$name-$i.json"; done
  does "$prospect" merge $(seq -f "$name-%g.json" "$shards" -1 1) --out "$name-merged.json"
  same_reports "$name-whole.json" "$name-merged.json"
}
alike oracle 3 "$prospect" oracle --task navigation --scenes 5 --cache oracle
alike ceiling 2 "$prospect" ceiling --task navigation --trials 4 --runs 2
alike evaluate 3 "$prospect" evaluate --task navigation --scenes 5 --samples 20 --rows random,nothing
alike plans 2 "$prospect" evaluate plans --task navigation --scenes 2 --runs 1 --most-plans 4
expect 14 'part 2 of 3 is missing from the run of evaluate-1.json' "$prospect" merge evaluate-1.json evaluate-3.json --out x.json
expect 14 'plans-1.json: is not of the run of evaluate-1.json: it is of evaluate plans' \
  "$prospect" merge evaluate-1.json plans-1.json --out x.json
expect 14 'oracle-whole.json: is no part' "$prospect" merge oracle-whole.json --out x.json
expect 2 'with --shard give --scenes' "$prospect" evaluate --task navigation --solvable 3 --shard 1/2 --json x.json
expect 2 '--shard writes a part' "$prospect" evaluate --task navigation --shard 1/2

# Calibration: what is stored in the weights, too.
cp "$root/model/weights/navigation.safetensors" one.safetensors
cp one.safetensors other.safetensors
calibrate=("$prospect" evaluate calibrate --task navigation --scenes 6 --samples 20)
does "${calibrate[@]}" --weights one.safetensors --json calibrate-whole.json
for i in 1 2; do does "${calibrate[@]}" --weights other.safetensors --shard "$i/2" --json "calibrate-$i.json"; done
checks=$((checks + 1))
cmp -s "$root/model/weights/navigation.safetensors" other.safetensors || fault 'a part is stored in the weights'
does "$prospect" merge calibrate-1.json calibrate-2.json --out calibrate-merged.json
same_reports calibrate-whole.json calibrate-merged.json
checks=$((checks + 1))
cmp one.safetensors other.safetensors || fault 'another calibration is stored'

# Weights that have changed since.
does "$prospect" evaluate --task navigation --weights other.safetensors --scenes 2 --samples 5 --rows nothing --shard 1/1 --json changed.json
does "${calibrate[@]}" --scenes 4 --weights other.safetensors
expect 14 'the parts were made with weights' "$prospect" merge changed.json --out x.json
[ ! -e x.json ] && [ ! -e x.h5 ] || fault 'what was refused is written'
finish
