# SPDX-License-Identifier: Apache-2.0
# Sourced by scripts that run commands in another Debian or Ubuntu, which is installed in a folder: its root.

# All mounts are made in a private namespace and vanish with it, whatever happens.
in_private_mounts() { unshare --mount -- "$@"; }

# in_root ROOT COMMAND…: runs a command as root in the root, with no more of this environment than proxies, their
# certificates for Node.js, and npm's settings.
in_root() {
  local kept
  mapfile -t kept < <(env | grep --extended-regexp '^((https?|no)_proxy|NODE_EXTRA_CA_CERTS|npm_config_[a-z_]+)=')
  PATH=$PATH:/usr/sbin:/sbin in_private_mounts bash -c '
    set -e
    root=$1; shift
    for folder in proc dev sys; do mount --rbind "/$folder" "$root/$folder"; done
    exec chroot "$root" /usr/bin/env -i "$@"' in_root "$1" "${kept[@]}" \
    PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 HOME=/root DEBIAN_FRONTEND=noninteractive "${@:2}"
}

# require_debian_in SCRIPT ROOT: ends with exit code 77 unless commands can be run in the root.
require_debian_in() {
  local what
  [[ $EUID -eq 0 ]] || what="needs root"
  [[ -x "$2/usr/bin/apt-get" ]] ||
    what="$2 has no Debian or Ubuntu in it; make one: debootstrap --variant=minbase bookworm $2"
  [[ -n "${what:-}" ]] || in_private_mounts true 2>/dev/null || what="mounting in a namespace of its own is not allowed here"
  [[ -n "${what:-}" ]] || return 0
  echo "$1: $what" >&2
  exit 77
}

# use_network_of_host ROOT: lets programs in the root resolve names.
use_network_of_host() {
  local file
  for file in hosts resolv.conf; do
    if [[ -e "/etc/$file" ]]; then cp --dereference "/etc/$file" "$1/etc/"; fi
  done
}
