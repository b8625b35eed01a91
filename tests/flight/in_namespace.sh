#!/usr/bin/env bash
# Runs a command in a network namespace of its own: only `lo`, with a multicast route for LCM on it, so
# that no packet leaves the machine and tests do not meet.
#   tests/flight/in_namespace.sh [--without-route] COMMAND…
# Ends with 77 where namespaces are not allowed.
set -euo pipefail

route=yes
if [ "${1:-}" = --without-route ]; then
  route=no
  shift
fi
user=()
[ "$(id -u)" -eq 0 ] || user=(--map-root-user)
if ! unshare --net "${user[@]}" true 2>/dev/null; then
  echo "in_namespace.sh: network namespaces are not allowed here" >&2
  exit 77
fi
exec unshare --net "${user[@]}" bash -c '
  set -euo pipefail
  ip link set lo up
  ip link set lo multicast on
  [ "$0" = no ] || ip route add 239.255.76.67/32 dev lo
  SAKER_NAMESPACE=$0 exec "$@"' "$route" "$@"
