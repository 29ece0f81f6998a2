#!/usr/bin/env bash
# What ./prospect builds, when, and what it says meanwhile. In the places of cmake, ninja and Debian's package list are scripts
# that write down what they were asked for.
#   building_test.sh ROOT PROSPECT     PROSPECT: bin/prospect, which is not built anew
set -uo pipefail
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
place=$work/place calls=$work/calls
mkdir -p "$work/tools" "$place"
cp -r "$1"/{prospect,scripts,packages.txt,config,tasks} "$place"
unset PROSPECT_BUILD TESTS
export CALLS=$calls SAYS=$work/says REAL=$2 PATH=$work/tools:$PATH

tool() { cat >"$work/tools/$1" && chmod +x "$work/tools/$1"; }
tool dpkg-query <<'SH'
#!/bin/sh
echo 'install ok installed'
SH
tool ctest <<'SH'
#!/bin/sh
echo "ctest $*" >>"$CALLS"
SH
tool cmake <<'SH'
#!/bin/bash
echo "cmake $*" >>"$CALLS"
mkdir -p build/release/bin
printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\nPROSPECT_TESTS:BOOL=%s\nPROSPECT_TRAINING:BOOL=%s\n' "$PWD" "${3#*=}" "${4#*=}" >build/release/CMakeCache.txt
for target in all quick_tests prospect prospect-{supervisor,simulator,model-server,worker,executive,bus,video,world,verify,data,train,evaluate}; do
  echo "build $target: phony some/where"
done >build/release/build.ninja
SH
# Builds programs that tell that they were started.
tool ninja <<'SH'
#!/bin/bash
echo "ninja $*" >>"$CALLS"
echo '[0/2] Re-checking globbed directories...'
if [ -f "$SAYS" ]; then . "$SAYS"; else echo 'ninja: no work to do.'; fi || exit
for target; do
  [ "$target" != prospect ] || cp "$REAL" bin/prospect
  [[ $target = prospect-* ]] || continue
  printf '#!/bin/sh\necho "started %s $*"\n' "$target" >"bin/$target" && chmod +x "bin/$target"
done
SH

fail() { printf '%s\nIt said:\n%s\nIt called:\n%s\n' "$*" "$said" "$(cat "$calls" 2>/dev/null)"; exit 1; }
# asked CODE ARGUMENT...: runs ./prospect in $place; what it says is in $said.
asked() {
  local code=$1 got=0
  shift
  rm -f "$calls"
  said=$(timeout 60 "$place/prospect" "$@" 2>&1 </dev/null) || got=$?
  [ "$got" = "$code" ] || fail "prospect $*: exit code $got instead of $code"
}
says() { grep -qE -- "$1" <<<"$said" || fail "no line with '$1'"; }
is_silent_about() { ! grep -qE -- "$1" <<<"$said" || fail "a line with '$1'"; }
called() { grep -qxE -- "$1" "$calls" 2>/dev/null || fail "no call of '$1'"; }
did_not_call() { ! grep -qE -- "$1" "$calls" 2>/dev/null || fail "a call of '$1'"; }

# A program is built when it is first asked for, alone, and used as it is from then on; before all others bin/prospect, which
# knows what a command needs.
asked 0 view --seed 3 --out x.png
called 'cmake --preset release -DPROSPECT_TESTS=OFF -DPROSPECT_TRAINING=OFF'
called 'ninja prospect'
called 'ninja prospect-world'
says '^started prospect-world view --seed 3 --out x.png$'
asked 0 view --seed 3 --out x.png
did_not_call 'cmake|ninja'

# When its sources are newer, and only then, bin/prospect is built again.
mkdir "$place/cli"
touch "$place/cli/table.cpp"
asked 0 run --help
called 'ninja prospect'
asked 0 run --help
did_not_call .

# Where nothing is to be built, nothing is said of building, and CMake is left alone.
echo 'exit 1' >"$work/stop"
cp "$work/stop" "$SAYS"
asked 2 demo --weights scripted
did_not_call cmake
called 'ninja prospect-supervisor prospect-simulator prospect-model-server prospect-worker prospect-executive prospect-bus'
is_silent_about '^Building'

asked 2 demo --task suturing --weights scripted
called 'ninja .* prospect-video'

# What is built is told with its steps and, once that can be told, the time that is left.
cat >"$SAYS" <<'SH'
echo '[1/2] Re-running CMake...'
for i in $(seq 1 10); do echo "[$i/20] Building CXX object $i.o"; done
sleep 2.5
for i in $(seq 11 20); do echo "[$i/20] Building CXX object $i.o"; done
false
SH
TELL_EVERY=1 asked 2 demo --weights scripted
says '^Building \(release\), 20 steps; log: build/release.log$'
says '^building 10 of 20, less than a minute left$'
grep -q '20/20' "$place/build/release.log" || fail 'the log lacks what ninja said'

# What the compiler complained about is shown.
printf 'echo "[1/9] Building CXX object a.o"; echo "a.cpp:3: error: nonsense"; false' >"$SAYS"
asked 2 demo --weights scripted
says 'a.cpp:3: error: nonsense'

# What trains, and only that, takes libtorch: it is installed and configured when it is first asked for.
mv "$work/tools/dpkg-query" "$work/all-installed"
tool dpkg-query <<'SH'
#!/bin/sh
for name; do :; done
[ "$name" = libtorch-dev ] || echo 'install ok installed'
SH
tool apt-get <<'SH'
#!/bin/sh
echo "apt-get $*" >>"$CALLS"
SH
tool sudo <<'SH'
#!/bin/sh
exec "$@"
SH
asked 0 view --seed 3 --out x.png
asked 2 demo --weights scripted
did_not_call 'apt-get|cmake'
rm "$SAYS"
asked 0 train --task stacking --data x.h5 --out x
called 'apt-get .* libtorch-dev'
called 'cmake --preset release -DPROSPECT_TESTS=OFF -DPROSPECT_TRAINING=ON'
says '^started prospect-train train '
mv "$work/all-installed" "$work/tools/dpkg-query"
rm "$work/tools/apt-get"

# Tests are built when they are asked for, and are not forgotten then.
asked 0 test --quick
called 'cmake --preset release -DPROSPECT_TESTS=ON -DPROSPECT_TRAINING=ON'
called 'ninja quick_tests'
called 'ctest .*-L quick'
asked 0 test
did_not_call cmake
called 'ninja all'

# A checkout that was moved or copied with its build is configured anew, tests and all.
cp -r "$place" "$work/copy"
place=$work/copy
cp "$work/stop" "$SAYS"
asked 2 demo --weights scripted
says "^build/release was made for $work/place: configuring it anew for $work/copy$"
called 'cmake --preset release -DPROSPECT_TESTS=ON -DPROSPECT_TRAINING=ON'
asked 2 demo --weights scripted
did_not_call cmake
is_silent_about anew
rm "$SAYS"

# Programs that run others bring them along.
asked 0 verify
called 'ninja (prospect-verify|prospect-data|prospect-evaluate|prospect-train| )+'
says '^started prospect-verify '

# Two builds do not write into one folder.
flock "$place/build/release.lock" sleep 1 &
sleep 0.3
asked 0 test
says '^Waiting for another build'
wait

# With a build folder named, nothing is built.
rm "$place/build/release/bin/prospect-world"
PROSPECT_BUILD=$work/none asked 127 view
did_not_call 'cmake|ninja'

# Every command has a help of its own, and does nothing else.
for command in demo explain up run down scale test setup; do
  asked 0 "$command" --help
  did_not_call .
  says "^usage: ./prospect $command"
done
asked 0 demo --seed 3 --help
says '^  --seed N'
is_silent_about '--no-simulator|--what-if'
asked 0 up --help
says '^  --no-simulator'
is_silent_about '--seed|--samples'
asked 0 spy --help
asked 0 --help
says '^  train '

# What is mistyped ends before anything is built.
asked 2 demo --goal 'on(red'
did_not_call .
asked 2 explain --what-if 'align(green'
did_not_call .
asked 2 evaluat
says "did you mean evaluate"

# Without packages there is no bin/prospect: who only asks is told which, and nothing is installed.
rm "$place/build/release/bin/prospect"
tool dpkg-query <<'SH'
#!/bin/sh
SH
tool apt-get <<'SH'
#!/bin/sh
echo "apt-get $*" >>"$CALLS"
SH
for command in --help doctor; do
  asked 2 $command
  says 'packages are missing.*./prospect setup'
  did_not_call .
done
