#!/usr/bin/env bash
# Runs a command on the first of several hosts: network namespaces of their own (host1, host2, ...), each with an address and
# a multicast route on eth0, joined by veth pairs and a bridge as machines are by a switch:
#   with_hosts.sh NUMBER COMMAND [ARGUMENT...]
# Programs start on another host by: ip netns exec host2 PROGRAM. All of it is in private network and mount namespaces and
# vanishes with the command. PROSPECT_HOSTS holds the number, or, where namespaces are not allowed, 0, and
# PROSPECT_HOSTS_WHY says why not; the command runs all the same. The exit status is the command's.
set -euo pipefail

if [[ $# -lt 2 ]]; then
  echo "usage: with_hosts.sh NUMBER COMMAND [ARGUMENT...]" >&2
  exit 2
fi
unset PROSPECT_DEPLOYMENT
# ip may live in /usr/sbin, which is not on every user's PATH.
export PATH="$PATH:/usr/sbin:/sbin"
export PROSPECT_HOSTS=$1 LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304'
shift

make_hosts='
set -e
mount -t tmpfs none /run && mkdir -p /run/netns
# The bridge has a namespace with a name: one without would go, and all cables with it, when the last process leaves it.
ip netns add switch
ip -n switch link add bridge type bridge
ip -n switch link set bridge up
for ((i = 1; i <= PROSPECT_HOSTS; ++i)); do
  ip netns add host$i
  ip -n switch link add port$i type veth peer name eth0 netns host$i
  ip -n switch link set port$i master bridge up
  ip -n host$i link set lo up
  ip -n host$i address add 10.77.0.$i/24 dev eth0
  ip -n host$i link set eth0 up
  ip -n host$i route add 224.0.0.0/4 dev eth0
done
exec ip netns exec host1 "$@"
'
why=
for flags in "-nm" "-rnm"; do
  if why=$(unshare $flags bash -c "$make_hosts" hosts true 2>&1); then
    exec unshare $flags bash -c "$make_hosts" hosts "$@"
  fi
done
export PROSPECT_HOSTS=0 PROSPECT_HOSTS_WHY="no network namespaces here: ${why##*$'\n'}"
exec "$@"
