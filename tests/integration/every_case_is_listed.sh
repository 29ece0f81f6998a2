#!/usr/bin/env bash
# A case that ctest does not know of would never run: the cases of a test program are those of the list.
#   every_case_is_listed.sh PROGRAM LIST
set -euo pipefail
diff <(sort "$2") <("$1" --gtest_list_tests | awk '/^[^ ]+\.$/ {suite = $1} /^  / {print suite $1}' | sort)
