#!/usr/bin/env bash
# What `./prospect doctor` finds in a network namespace without a route, mends on consent, and says of a bus that is taken.
#   doctor_test.sh PROSPECT BIN
set -uo pipefail
if [ -z "${IN_NAMESPACE:-}" ]; then
  IN_NAMESPACE=1 exec unshare -rn "$0" "$@"
fi
prospect=$1 bin=$2
export PROSPECT_BUILD=${bin%/bin}
# So small a buffer is allowed everywhere.
bus='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=65536'
export LCM_DEFAULT_URL=$bus
XDG_RUNTIME_DIR=$(mktemp -d)  # a deployment of this user's is another bus's
export XDG_RUNTIME_DIR
trap 'rm -rf "$XDG_RUNTIME_DIR"' EXIT

expect() {  # expect CODE TEXT ARGS...: exit code and a line of the answer
  local code=$1 text=$2 said
  shift 2
  said=$("$prospect" doctor "$@" 2>&1 </dev/null)
  local got=$?
  [ "$got" = "$code" ] && grep -qE "$text" <<<"$said" && return
  printf 'doctor %s: exit code %s instead of %s, or no line with "%s":\n%s\n' "$*" "$got" "$code" "$text" "$said"
  exit 1
}

expect 11 '^FAULT  route .*no multicast route'
expect 11 'ip route add 224.0.0.0/4 dev lo'
expect 0 '^ok     route ' --yes
expect 0 '^ok     bus .*came back'
expect 0 '^ok     weights .*navigation, 7 actions'
expect 2 "unknown option '--nonsense'" --nonsense

# Somebody else's deployment is on the bus.
"$bin/prospect-worker" --deployment 4711 --bus "$bus" >/dev/null 2>&1 &
trap 'kill %1; rm -rf "$XDG_RUNTIME_DIR"' EXIT
"$bin/prospect-bus" wait --bus "$bus" --services worker=1 --seconds 20 || exit 1
expect 12 '^FAULT  bus .*in use by another deployment'
