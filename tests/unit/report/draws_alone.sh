#!/usr/bin/env bash
# OpenCV is named in report/ and in the root CMakeLists.txt, which finds it; no header of report/ includes it.
#   draws_alone.sh ROOT
cd "$1" || exit 1
# naming FIND_WORD...: the files of these names that use it; build folders hold copies.
naming() {
  find . \( -name .git -o -path ./build \) -prune -o -type f \( "$@" \) -exec grep -lE 'opencv|OpenCV_|cv::' {} +
}
faults=$(naming -name '*.cpp' -o -name '*.h' -o -name CMakeLists.txt -o -name '*.cmake' | grep -vE '^\./(report/|CMakeLists\.txt$)'
  naming -name '*.h' | grep '^\./report/')
[ -z "$faults" ] || { printf 'OpenCV is named outside the .cpp files of report/:\n%s\n' "$faults"; exit 1; }
# A pattern that matches nothing would hold, too.
grep -q '^\./report/canvas.cpp$' <<<"$(naming -name '*.cpp')" || { echo 'report/canvas.cpp does not name it: is the pattern wrong?'; exit 1; }
