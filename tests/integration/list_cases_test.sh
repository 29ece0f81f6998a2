#!/usr/bin/env bash
# Cases of a gtest program are ctest's without any list (cmake/list_cases.cmake), with a program that only says that it has
# some. usage: list_cases_test.sh LIST_CASES.CMAKE CTEST
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/program" <<'SH'
#!/usr/bin/env bash
if [[ $1 == --gtest_list_tests ]]; then
  printf '%s\n' 'Running main() from gtest_main.cc' 'Search.' '  Ends' '  Fails' 'By/Reach.' '  Hears/lo  # GetParam() = "lo; x"'
  exit
fi
echo "ran $1 on $BUS"
[[ $1 != *Search.Fails ]]
SH
printf '#!/usr/bin/env bash\nBUS=its-own exec "$@"\n' >"$work/launcher"
chmod +x "$work/program" "$work/launcher"

# entry PROGRAM: what prospect_cases writes for it
entry() {
  cat >"$work/CTestTestfile.cmake" <<CMAKE
set(program "$1")
set(name search_test)
set(prefix faults)
set(launcher "$work/launcher")
set(labels "faults;slow")
set(timeout 7)
include("$list_cases")
CMAKE
}
list_cases=$1 ctest=$2
expect() {
  grep -qF -- "$1" "$work/log" || { echo "nothing of '$1' in:"; cat "$work/log"; exit 1; }
}

entry "$work/program"
code=0
"$ctest" --test-dir "$work" -V -L slow >"$work/log" 2>&1 || code=$?
[[ $code != 0 ]] || { echo "a case that failed was not noticed"; exit 1; }
expect 'ran --gtest_filter=Search.Ends on its-own'
expect 'ran --gtest_filter=By/Reach.Hears/lo on its-own'
expect 'faults.Search.Fails (Failed)'
expect '67% tests passed, 1 tests failed out of 3'
expect 'Test timeout computed to be: 7'

# A program that was not built fails, under the labels of its cases only.
entry "$work/nothing"
code=0
"$ctest" --test-dir "$work" -L slow >"$work/log" 2>&1 || code=$?
[[ $code != 0 ]] || { echo "a program that is not there was not noticed"; exit 1; }
expect 'faults.search_test_LISTS_NO_CASES'
"$ctest" --test-dir "$work" -L quick >"$work/log" 2>&1 || { echo "it was asked for in a quick run"; exit 1; }

# So does one that says nothing.
printf '#!/usr/bin/env bash\n' >"$work/program"
entry "$work/program"
code=0
"$ctest" --test-dir "$work" >"$work/log" 2>&1 || code=$?
[[ $code != 0 ]] || { echo "a program without cases was not noticed"; exit 1; }
