#!/usr/bin/env bash
# prospect-train with data, weights, devices and disks that it cannot use: exit code, one line that names the culprit, and
# what was trained before stays as it was.
#   train_bad_input_test.sh BIN
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=${here%/tests/integration}
bin=$1
. "$here/support/expect.sh"
export PATH="$bin:$PATH" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
weights=$root/model/weights/navigation.safetensors
fault() { echo "FAULT $*"; faults=$((faults + 1)); }
sums() { (cd "$1" && find . -type f -exec sha256sum {} + | sort); }

prospect-data collect --task navigation --trials 30 --seed 0 --jobs 1 --out good.h5 >/dev/null 2>&1 || exit 1
echo '{"checkpoint_seconds": 0, "classifier": {"iterations": 26, "batch": 2, "learning_rate": 0.001}}' >few.json
train=(prospect-train train --task navigation --config few.json --out run --threads 1)

# --- Data sets: of another task, without a success, with damaged frames.
expect 14 "good.h5: holds trials of 'navigation', not of 'stacking'" prospect-train train --task stacking --data good.h5 --out run
for seed in $(seq 0 50); do
  prospect-data collect --task navigation --trials 1 --seed "$seed" --jobs 1 --out one.h5 --json one.json >/dev/null 2>&1 || exit 1
  grep -q '"successes": 0' one.json && [ "$(prospect-data info one.h5 | grep -c '1 train')" = 1 ] && break
done
expect 14 'one.h5: none of the 1 trials in its train part succeeded.*add trials that succeed' \
  "${train[@]}" --data one.h5 --stage heads
expect 14 'one.h5: none of its 1 trials is in the (train|valid|test) part' "${train[@]}" --data one.h5
# A stretch in the middle of a trial's file is in its pictures; other bytes would be refused as well.
size=$(stat -c %s one.h5)
cp one.h5 holes.h5
head -c $((size / 3)) /dev/zero | tr '\0' '\125' | dd of=holes.h5 bs=1M seek=$((size / 3)) oflag=seek_bytes conv=notrunc status=none
expect 14 'holes.h5: .*(damaged|not a data set of ours)' "${train[@]}" --data holes.h5 --stage classifier

# --- Weights to begin from: of another task, none, not weights.
expect 10 "navigation.safetensors: tensor 'transform.action.weight' has another shape" \
  prospect-train train --task stacking --data good.h5 --out run --from "$weights"
echo 'no weights' >text
expect 10 'text: .*not a safetensors' "${train[@]}" --data good.h5 --from text
expect 10 'absent: cannot be opened' "${train[@]}" --data good.h5 --from absent

# --- CUDA where there is none.
export CUDA_VISIBLE_DEVICES=
expect 2 "device 'cuda': libtorch finds no GPU here; take --device cpu" "${train[@]}" --data good.h5 --device cuda
expect 2 "device 'cuda': libtorch finds no GPU here; take --device cpu" prospect-train bench --task navigation --device cuda
expect 2 "unknown task 'juggling'; known: navigation" prospect-train bench --task juggling
expect 2 "unknown option '--nonsense'" prospect-train bench --task navigation --nonsense
[ -z "$(find run -type f 2>/dev/null)" ] || fault "something was trained: $(find run -type f)"

# --- The disk is full in the middle of a stage: what is there stays, and with room again it goes on.
cat >limited <<'SH'
# No file may grow beyond so many kB: as on a full disk.
trap '' XFSZ
ulimit -f "$1"
exec "${@:2}"
SH
"${train[@]}" --data good.h5 --stage classifier >/dev/null 2>&1 || fault 'the first stage does not train'
before=$(sums run/stages)
expect 13 'run/stages/second-classifier-[0-9a-f]+/stage-second-classifier.checkpoint: .*space on the disk' \
  bash limited 20000 "${train[@]}" --data good.h5 --stage second-classifier
after=$(sums run/stages)
[ "$(grep -F -x -f <(printf '%s\n' "$before") <<<"$after")" = "$before" ] || fault 'the first stage is no longer what it was'
compgen -G 'run/stages/*/.*.part*' >/dev/null && fault 'half a checkpoint was left behind'
"${train[@]}" --data good.h5 --stage second-classifier >/dev/null 2>&1 || fault 'with room again it does not go on'
finish
