#!/usr/bin/env bash
# Runs a command on a bus of its own, so that tests disturb nobody and run side by side:
#   with_bus.sh COMMAND [ARGUMENT...]
# In a private network namespace with a multicast route on loopback where the host allows one; otherwise on a random
# port of the host's own bus, by LCM_DEFAULT_URL. PROSPECT_PRIVATE_BUS tells the command which: "namespace" or "port".
# The exit status is the command's.
set -euo pipefail

if [[ $# -eq 0 ]]; then
  echo "usage: with_bus.sh COMMAND [ARGUMENT...]" >&2
  exit 2
fi
unset PROSPECT_DEPLOYMENT

# ip may live in /usr/sbin, which is not on every user's PATH.
export PATH="$PATH:/usr/sbin:/sbin"
set_up_loopback='ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo'

for flags in "-rn" "-n"; do
  if unshare $flags bash -c "$set_up_loopback" >/dev/null 2>&1; then
    export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304'
    export PROSPECT_PRIVATE_BUS=namespace
    exec unshare $flags bash -c "$set_up_loopback"' && exec "$@"' with_bus "$@"
  fi
done

port=$((20000 + (RANDOM * 32768 + RANDOM) % 30000))
export LCM_DEFAULT_URL="udpm://239.255.76.67:$port?ttl=0&recv_buf_size=4194304"
export PROSPECT_PRIVATE_BUS=port
exec "$@"
