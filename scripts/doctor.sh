# `doctor`: what a deployment needs of this machine, one line each, with the command that mends what is wrong.

DOCTOR_FAULT=0  # exit code of the first fault that was not mended

ok() { printf 'ok     %-15s %s\n' "$1" "$2"; }

# fault NAME CODE WHAT CHECK COMMAND...: says what is wrong and the command that mends it; runs that on consent and checks again.
# An empty COMMAND: nothing that a command could mend.
fault() {
  local name=$1 code=$2 what=$3 check=$4
  shift 4
  printf 'FAULT  %-15s %s\n' "$name" "$what"
  if [ -n "${MENDING:-}" ]; then
    printf '       %-15s still so after: %s\n' '' "$*"
  elif [ $# -gt 0 ]; then
    printf '       %-15s mend it with: %s\n' '' "$*"
    if consents && MENDING=1 bash -c "$*" && MENDING=1 "$check"; then return; fi
  fi
  [ "$DOCTOR_FAULT" = 0 ] && DOCTOR_FAULT=$code
  return 1
}

# Whether to run the command just shown: --yes, or a person says so.
consents() {
  [ -n "${DOCTOR_YES:-}" ] && return 0
  [ -t 0 ] && [ -t 1 ] || return 1
  local answer
  read -r -p '       Run it now? [y/N] ' answer
  [ "$answer" = y ] || [ "$answer" = Y ]
}

root_prefix() { [ "$(id -u)" = 0 ] || printf 'sudo '; }

check_packages() {
  local missing
  missing=$(missing_packages $(packages_of build run) | tr '\n' ' ')
  [ -z "$missing" ] && { ok packages "all of packages.txt"; return; }
  fault packages 2 "missing: $missing" check_packages "$(root_prefix)apt-get install --no-install-recommends -y $missing"
}

check_programs() {
  [ -x "$BIN/prospect-executive" ] && [ -x "$BIN/prospect-supervisor" ] && { ok programs "$BIN"; return; }
  fault programs 2 "not built in $BIN" check_programs "$ROOT/prospect setup"
}

check_route() {
  has_multicast_route && { ok route "there is one for $BUS"; return; }
  fault route 11 "no multicast route for $BUS: LCM cannot send" check_route \
    "$(root_prefix)ip link set lo up && $(root_prefix)ip route add 224.0.0.0/4 dev lo"
}

# LCM asks the kernel for the buffer in its URL and gets at most rmem_max; with less, bursts are lost.
check_receive_buffer() {
  local want have
  want=$(printf '%s' "$BUS" | sed -n 's/.*recv_buf_size=\([0-9]*\).*/\1/p')
  want=${want:-4194304}
  have=$(cat /proc/sys/net/core/rmem_max 2>/dev/null) || { ok 'receive buffer' "not to be seen in this namespace"; return; }
  [ "$have" -ge "$want" ] && { ok 'receive buffer' "$have bytes allowed, $want asked for"; return; }
  fault 'receive buffer' 11 "the kernel allows $have bytes, $want are asked for: bursts will be lost" check_receive_buffer \
    "$(root_prefix)sysctl -w net.core.rmem_max=$want"
}

# Sends a message to itself and listens for others.
check_bus() {
  local said
  [ -x "$BIN/prospect-bus" ] && has_multicast_route || return 0
  said=$("$BIN/prospect-bus" probe --bus "$BUS" --deployment "${PROSPECT_DEPLOYMENT:-1}" 2>&1)
  local code=$?
  said=$(printf '%s' "$said" | tail -n 1)
  [ "$code" = 0 ] && { ok bus "$said"; return; }
  fault bus "$code" "${said#error: }" check_bus
}

# Times in logs and recordings come from the clock; one that was never set is older than the source.
check_clock() {
  local newest
  newest=$(stat -c %Y "$ROOT/packages.txt")
  [ "$(date +%s)" -ge "$newest" ] && { ok clock "$(date --rfc-3339=seconds)"; return; }
  fault clock 2 "$(date --rfc-3339=seconds) is before these files were made" check_clock "$(root_prefix)timedatectl set-ntp true"
}

check_java() {
  command -v java >/dev/null && { ok java "$(java -version 2>&1 | head -n 1)"; return; }
  fault java 2 "no java: all works but spy" check_java "$(root_prefix)apt-get install --no-install-recommends -y default-jre"
}

check_jar() {
  local jar
  jar=$(ls -t "$BIN"/../share/prospect_types.jar "$ROOT"/build/*/share/prospect_types.jar 2>/dev/null | head -n 1)
  [ -n "$jar" ] && { ok jar "$jar"; return; }
  fault jar 2 "lcm-spy has no types of ours: not built" check_jar "$ROOT/prospect setup"
}

check_weights() {
  local file said
  for file in "$ROOT"/model/weights/*.safetensors; do
    [[ $file = *-classifiers.safetensors ]] && continue  # they read labels when scores are made; nothing serves them
    [ -x "$BIN/prospect-model-server" ] || return 0
    said=$("$BIN/prospect-model-server" --check --weights "$file" 2>&1) && { ok weights "$said"; continue; }
    fault weights 10 "${said#error: }" check_weights "git -C $ROOT checkout -- model/weights"
  done
}

cmd_doctor() {
  DOCTOR_YES=
  BUS=${LCM_DEFAULT_URL:-$DEFAULT_BUS}
  while [ $# -gt 0 ]; do
    case "$1" in
      --yes) DOCTOR_YES=1 ;;
      --bus) [ $# -ge 2 ] || die 2 "--bus needs a value"; BUS=$2; shift ;;
      -h | --help) say "usage: ./prospect doctor [--yes] [--bus URL]: what this machine lacks, and mends it on consent"; exit 0 ;;
      *) die 2 "unknown option '$1' of doctor; known: --yes, --bus" ;;
    esac
    shift
  done
  join_deployment
  local check
  for check in packages programs route receive_buffer bus clock java jar weights; do "check_$check"; done
  exit "$DOCTOR_FAULT"
}
