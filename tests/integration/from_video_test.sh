#!/usr/bin/env bash
# Videos to networks: a folder in JIGSAWS' layout and the same trials as videos with a CSV each give data sets of the same labels,
# and both train.
#   from_video_test.sh BIN
set -uo pipefail
bin=$1
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$(dirname "$0")/support/expect.sh"
export PATH="$bin:$PATH" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
fault() { echo "FAULT $*"; faults=$((faults + 1)); }
takes() {  # takes TEXT COMMAND...: it ends with 0 and prints TEXT
  local text=$1 said
  shift
  checks=$((checks + 1))
  said=$(timeout 60 "$@" 2>&1 </dev/null) || fault "$*"$'\n'"$said"
  grep -qE -- "$text" <<<"$said" || fault "'$text' was not said by $*, but:"$'\n'"$said"
}

prospect-data collect --task suturing --trials 4 --format jigsaws --fps 5 --width 128 --height 96 --out trials >/dev/null 2>&1 || exit 1
takes '4 trials, .* 0 repaired, 0 left out' prospect-data from-video trials/Suturing --task suturing --every 2 --out jigsaws.h5

# Frames from 1 to seconds from 0.
mkdir videos
for text in trials/Suturing/transcriptions/*.txt; do
  name=$(basename "$text" .txt)
  cp "trials/Suturing/video/${name}_capture1.avi" "videos/$name.avi"
  awk 'BEGIN { print "start,end,action,succeeded" } { printf "%.3f,%.3f,%s,1\n", ($1 - 1) / 5, ($2 - 1) / 5, $3 }' "$text" >"videos/$name.csv"
done
takes '4 trials, .* 0 repaired, 0 left out' prospect-data from-video videos --task suturing --every 2 --out videos.h5
actions() { prospect-data export "$1" --segments "$1.csv" --out "$1.hdf5" >/dev/null 2>&1; cut -d, -f1,4,5 "$1.csv"; }
checks=$((checks + 1))
[ "$(actions jigsaws.h5)" = "$(actions videos.h5)" ] || fault 'a CSV and a transcription of the same trials give different actions'

# Rows that mean nothing are named.
echo '0,1,G77,1' >>"videos/$name.csv"
takes "$name: left out: videos/$name.csv: line [0-9]+: there is no action 'G77'; did you mean" \
  prospect-data from-video videos --task suturing --every 2 --out three.h5
expect 2 'is to be held out, but no trial is called so' prospect-data from-video videos --task suturing --hold-out nobody --out none.h5
expect 14 'videos/none: is no folder' prospect-data from-video videos/none --task suturing --out none.h5
[ -e none.h5 ] && fault 'something was written'

# Small pictures, and one trial of the training part that fails: every stage trains.
if command -v prospect-train >/dev/null; then
  sed -e '/^training:/,$d' -e '/^simulator:/d' -e 's/^picture: .*/picture: {width: 32, height: 32}/' "$root/tasks/suturing.yaml" >small.yaml
  sed -i '$d' "videos/$name.csv"
  sed -i '$s/,1$/,0/' "$(ls videos/*.csv | head -n 1)"
  takes '4 trials, .* 0 repaired, 0 left out' prospect-data from-video videos --task small.yaml --every 2 --out small.h5
  takes 'right' prospect-train train --task small.yaml --data small.h5 --out run --iterations 2 --threads 1
  [ -e run/suturing.safetensors ] || fault 'no weights'
fi
finish
