#!/usr/bin/env bash
# Prospect as cmake --install leaves it, used from another folder by somebody who may not write to it and sees no sources: commands,
# a demo, and robots of their own that are built against it.
#   installed_test.sh BUILD
set -uo pipefail
build=$1
tests=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d)
chmod 755 "$folder"
trap 'chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
prefix=$folder/usr home=$folder/home
cmake --install "$build" --prefix "$prefix" >"$folder/install.log" 2>&1 || { tail -n 5 "$folder/install.log"; exit 1; }
mkdir -p "$home"/{run,here}
cp "$tests/integration/with_bus.sh" "$tests/installed/rover.cpp" "$home"
head -c 32 /dev/urandom | od -An -tx1 | tr -d ' \n' >"$home/key"
chmod 600 "$home/key"
chmod -R a-w "$prefix"
touch "$folder/installed"  # a time

# somebody COMMAND...: as a user without rights, in an environment that knows neither build nor sources.
cd "$home/here" || exit 1
user=()
if [ "$(id -u)" = 0 ]; then
  user=(setpriv --reuid 65534 --regid 65534 --clear-groups)
  chown -R 65534:65534 "$home"
fi
chmod 700 "$home" "$home/run"
somebody() {
  "${user[@]}" env -i "HOME=$home" "XDG_RUNTIME_DIR=$home/run" "PATH=$prefix/bin:/usr/bin:/bin" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "$@"
}

checks=0 faults=0
fault() { faults=$((faults + 1)); echo "FAULT $*"; }
# says CODE TEXT COMMAND...: it ends with CODE, and some line that it prints matches TEXT.
says() {
  local code=$1 text=$2 said got
  shift 2
  checks=$((checks + 1))
  said=$(somebody "$@" 2>&1 </dev/null)
  got=$?
  [ "$got" = "$code" ] && grep -qE -- "$text" <<<"$said" || fault "$*: exit code $got (not $code), or no \"$text\": $(tail -n 8 <<<"$said")"
}
check() { checks=$((checks + 1)); "$@" || fault "not so: $*"; }
is() { [ "$1" = "$2" ] || { diff <(echo "$1") <(echo "$2"); false; }; }

# What lies where; nothing else in folders that other packages use.
check is "$(cd "$prefix" && ls bin lib share | grep -v '^$')" \
  "$(printf '%s\n' bin: prospect lib: cmake libprospect_codec.a libprospect_robot.a prospect share: bash-completion doc prospect)"
check is "$(ls "$prefix/include" "$prefix/lib/cmake")" "$(printf '%s\n' "$prefix/include:" prospect '' "$prefix/lib/cmake:" Prospect)"
check is "$(ls "$prefix/lib/prospect" | grep -v '^schema_gen$')" "$(ls "$build/bin" | grep '^prospect-' | sort)"
check is "$(find "$prefix" -name '*classifiers*' -o -name '*.cpp' -path '*/share/prospect/*')" ''

# Commands.
says 0 '^usage: prospect COMMAND' prospect --help
says 0 '^prospect [0-9.]+ \(.+\)' prospect version
says 0 'observation_t' prospect messages
says 0 '' prospect --dry-run demo
says 2 "'test' is for a checkout" prospect test
says 15 'nothing is up on .*: prospect up$' prospect scale workers=2
says 0 '' bash -n "$prefix/share/bash-completion/completions/prospect"
check is "$(somebody prospect completion bash | grep complete\ )" "$(grep complete\  "$prefix/share/bash-completion/completions/prospect")"
check is "$(ldd "$prefix"/lib/prospect/* | grep 'not found')" ''

# Without what trains: no libtorch, and who wants to train is told what is missing.
small=$folder/small
cmake --install "$build" --prefix "$small" --component prospect >"$folder/install.log" 2>&1
check is "$(comm -13 <(ls "$small/lib/prospect") <(ls "$prefix/lib/prospect"))" prospect-train
check is "$(ldd "$small"/bin/* "$small"/lib/prospect/* | grep -E 'not found|torch')" ''
says 127 'package prospect-train$' "$small/bin/prospect" train --task stacking --data none.h5 --out none

# A demo: its results lie where it was called.
says 0 '' prospect demo --policy plan:0,1,2 --seed 2000000 --task navigation
check test -s "$home/here/out/navigation-2000000/result.json"

# A robot's own project: the example as it is, and the lines of the docs.
doc=$prefix/share/doc/prospect
build_robot() {  # build_robot FOLDER TARGET
  says 0 'Configuring done' cmake -S "$1" -B "$1/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release
  says 0 "Built target $2" cmake --build "$1/build"
}
somebody cp -r "$doc/examples/robots/cpp" "$home/robot" && somebody chmod -R u+w "$home/robot"
build_robot "$home/robot" example-robot
somebody mkdir "$home/rover" && somebody mv "$home/rover.cpp" "$home/rover"
sed -n '/^```cmake$/,/^```$/{/^```/!p}' "$doc/docs/robots.md" | somebody tee "$home/rover/CMakeLists.txt" >/dev/null
build_robot "$home/rover" rover
says 0 '' "$home/rover/build/rover" "$home/key"
says 0 '^0 of [0-9]+ rules broken' "$home/with_bus.sh" bash -c '
  "$HOME/robot/build/example-robot" --key "$HOME/key" & robot=$!
  prospect check-robot --key "$HOME/key"; code=$?
  kill $robot; exit $code'

check is "$(find "$prefix" -newer "$folder/installed")" ''
echo "$checks checks, $faults faults"
[ "$faults" = 0 ]
