#!/usr/bin/env bash
# Builds docker/Dockerfile and runs an episode with it where no Docker daemon runs (as root): buildah builds, on a base that
# debootstrap makes from the mirror in this machine's apt sources, and namespaces run it as compose.yaml would.
#   docker/without-daemon.sh                    build (what is unchanged is not built again), then an episode, whose exit code it ends with
#   docker/without-daemon.sh build|episode      one of the two; episode takes further options of prospect-executive
#   docker/without-daemon.sh clean              removes images and caches
# Its storage is $PROSPECT_DATA/docker (default ~/.cache/prospect/docker): 10 GB, and 14 GB while it builds.
set -uo pipefail
ROOT=$(cd "$(dirname "$(readlink -f "$0")")/.." && pwd)
STORE=${PROSPECT_DATA:-$HOME/.cache/prospect}/docker
RELEASE=bookworm

say() { printf '%s\n' "$*" >&2; }
die() { local code=$1; shift; say "without-daemon: $*"; exit "$code"; }

. "$ROOT/scripts/packages.sh"

b() {
  local command=$1
  shift
  TMPDIR=$STORE/tmp buildah --root "$STORE/storage" --runroot "$STORE/run" --storage-driver vfs "$command" "$@"
}

have_image() { b inspect --type image "$1" >/dev/null 2>&1; }

# This machine's Debian package sources, one a line as sources.list writes them; leaves out whatever else it has.
debian_sources() {
  apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' 'Origin: Debian' |
    grep -E "^deb [^ ]+ $RELEASE(-[a-z-]+)? "
}

# How this machine's apt reaches them: proxies and what it does not check.
apt_ways() { apt-config dump | grep -E '^Acquire::((http|https|ftp)::Proxy|Check-Valid-Until|Check-Date)'; }

# The image that stands for debian:bookworm-slim.
make_base() {
  have_image prospect-base && return
  local sources mirror container root log=$STORE/debootstrap.log
  sources=$(debian_sources)
  [ -n "$sources" ] || die 2 "apt knows no Debian $RELEASE package lists here: apt-get update"
  say "Making the base by debootstrap; log: $log"
  container=$(b from scratch) && root=$(b mount "$container") || die 13 "no container could be made in $STORE"
  mirror=$(awk -v release="$RELEASE" '$3 == release { print $2; exit }' <<<"$sources")
  debootstrap --variant=minbase --include=ca-certificates "$RELEASE" "$root" "$mirror" >"$log" 2>&1 ||
    { tail -n 5 "$log" >&2; b rm "$container" >/dev/null; die 2 "debootstrap failed; the whole log: $log"; }
  printf '%s\n' "$sources" >"$root/etc/apt/sources.list"
  apt_ways >"$root/etc/apt/apt.conf.d/90host"
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"  # as Debian's own image has it: nothing here outlives a power cut
  rm -rf "$root"/var/cache/apt/archives/*.deb "$root"/var/lib/apt/lists/*
  b commit --quiet --rm "$container" prospect-base >/dev/null || die 13 "the base could not be stored in $STORE"
}

# build_image NAME [OPTION...]: a stage of the Dockerfile; steps whose input is unchanged come from the storage.
build_image() {
  local name=$1 log=$STORE/$1.log
  shift
  say "Building $name; log: $log"
  b build --isolation chroot --format docker --layers \
    --pull-never --build-arg BASE=localhost/prospect-base "$@" --tag "$name" --file "$ROOT/docker/Dockerfile" "$ROOT" >"$log" 2>&1 ||
    { tail -n 30 "$log" >&2; die 2 "$name could not be built; the whole log: $log"; }
}

# A hash of all that the image is made of.
fingerprint() {
  (cd "$ROOT" && { sed -n 's/^!//p' .dockerignore | xargs -I{} find {} -type f; echo .dockerignore; echo docker/Dockerfile; } |
    sort | tr '\n' '\0' | xargs -0 sha256sum) | sha256sum
}

build() {
  local inputs
  inputs=$(fingerprint)
  have_image prospect && [ "$(cat "$STORE/inputs" 2>/dev/null)" = "$inputs" ] && return
  make_base
  # The tag keeps the first stage's steps, which the final image does not hold.
  build_image prospect-build --target build
  build_image prospect
  b rmi --prune >/dev/null 2>&1  # what an earlier source left
  printf '%s\n' "$inputs" >"$STORE/inputs"
}

# of_image TEMPLATE: a field of the image's configuration.
of_image() { b inspect --type image --format "{{$1}}" prospect; }

# Sets CONTAINER to what, before a command, runs it as `docker run --network host --read-only --tmpfs /tmp --cap-drop ALL` would:
# with processes and mounts of its own, as the image's user and in its environment.
prepare_container() {
  CONTAINER=(unshare --mount --pid --uts --ipc --fork --kill-child bash -c '
    image=$1 user=$2
    shift 2
    mount --bind "$image" "$image" && mount -o remount,bind,ro "$image" &&
      mount -t proc proc "$image/proc" && mount --rbind /dev "$image/dev" &&
      mount -t tmpfs tmpfs "$image/tmp" && mount -t tmpfs -o "uid=${user%:*},gid=${user#*:}" tmpfs "$image/results" &&
      exec chroot "$image" setpriv --reuid "${user%:*}" --regid "${user#*:}" --clear-groups --no-new-privs \
        --bounding-set -all --inh-caps -all env -i -C /results "$@"' container "$1" "$USER_OF_IMAGE" "${ENV_OF_IMAGE[@]}")
}

# start NAME COMMAND...: a service in a container of its own, in the background.
start() {
  local name=$1
  shift
  "${CONTAINER[@]}" "$@" >"$LOGS/$name.log" 2>&1 &
  SERVICE[$name]=$!
}

# The process that is number 1 in a service's container; none when it has ended.
first_process() { pgrep -P "${SERVICE[$1]}"; }

# Runs the image's own health check inside a service's container, as the Docker daemon would.
health() {
  local first
  first=$(first_process "$1") || return 1
  nsenter --target "$first" --mount --pid --uts --ipc --root --wd setpriv --reuid "${USER_OF_IMAGE%:*}" --regid "${USER_OF_IMAGE#*:}" \
    --clear-groups --no-new-privs env -i "${ENV_OF_IMAGE[@]}" sh -c "$HEALTH_CHECK" 2>&1
}

# Waits until a service's health check passes; says what it said.
wait_healthy() {
  local end=$((SECONDS + 60)) said
  until said=$(health "$1"); do
    first_process "$1" >/dev/null || { tail -n 3 "$LOGS/$1.log" >&2; die 15 "$1 ended; its log: $LOGS/$1.log"; }
    [ "$SECONDS" -lt "$end" ] || die 15 "$1 is not healthy: $said"
    sleep 0.5
  done
  printf 'healthy  %-12s %s\n' "$1" "$said"
}

# Inside the private network: services from the image, their health checks, and an episode.
run_episode() {
  declare -A SERVICE
  prepare_container "$1"
  shift
  ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo || die 11 "no loopback in a network namespace"
  start simulator prospect-simulator
  start model prospect-model-server
  start worker-1 prospect-worker
  start worker-2 prospect-worker
  local name
  for name in simulator model worker-1 worker-2; do wait_healthy "$name"; done
  # A container whose service stands still must not pass for healthy because its twin works.
  kill -STOP "$(first_process worker-2)"
  health worker-2 >/dev/null && die 4 "the health check of a stopped worker passes"
  kill -CONT "$(first_process worker-2)"
  wait_healthy worker-2
  "${CONTAINER[@]}" prospect-executive --workers 2 --objects 4 --legs 3 --seed 2000000 "$@"
  local code=$?
  for name in simulator model worker-1 worker-2; do
    kill -TERM "$(first_process "$name")" && wait "${SERVICE[$name]}" ||
      die 4 "$name did not stop as it should: $(tail -n 1 "$LOGS/$name.log")"
  done
  return "$code"
}

episode() {
  have_image prospect || die 2 "there is no image yet: docker/without-daemon.sh build"
  local container
  container=$(b from --pull-never prospect) || die 13 "no container could be made in $STORE"
  trap 'b rm '"$container"' >/dev/null' EXIT
  USER_OF_IMAGE=$(of_image .Docker.Config.User) HEALTH_CHECK=$(of_image 'index .Docker.Config.Healthcheck.Test 1')
  mapfile -t ENV_OF_IMAGE < <(of_image 'range .Docker.Config.Env}}{{println .}}{{end' | grep .)
  LOGS=$STORE/logs
  mkdir -p "$LOGS"
  export USER_OF_IMAGE HEALTH_CHECK LOGS
  # With the first process of this namespace all others end, whatever happens.
  unshare --net --mount --pid --fork --kill-child --mount-proc "$0" --inside "${#ENV_OF_IMAGE[@]}" "${ENV_OF_IMAGE[@]}" \
    "$(b mount "$container")" "$@"
}

clean() {
  [ -d "$STORE" ] || return 0
  b rm --all >/dev/null
  b rmi --all --force >/dev/null
  rm -rf "$STORE"
}

main() {
  local command=${1:-all}
  [ $# -gt 0 ] && shift
  if [ "$command" = --inside ]; then
    ENV_OF_IMAGE=("${@:2:$1}")
    shift $(($1 + 1))
    run_episode "$@"
    exit
  fi
  case "$command" in
    all | build | episode | clean) ;;
    *) die 2 "unknown command '$command'; known: build, episode, clean" ;;
  esac
  [ "$(id -u)" = 0 ] || die 2 "namespaces and chroot need root: sudo $0"
  mkdir -p "$STORE/tmp" || die 13 "cannot write to $STORE"
  install_packages docker
  case "$command" in
    all) build && episode ;;
    *) "$command" "$@" ;;
  esac
}
main "$@"
