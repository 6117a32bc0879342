# SPDX-License-Identifier: Apache-2.0
# Sourced by the scripts for Gazebo 11; changes nothing by itself. Debian 12 has no Gazebo 11, so there
# it is installed in a folder with a complete Debian 11, the root.
tagfield_top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
gazebo_root=$(realpath --canonicalize-missing "${TAGFIELD_GAZEBO_ROOT:-$tagfield_top/build/gazebo-root}")

# The list of packages in a complete root.
gazebo_root_stamp=etc/tagfield-packages

# Exit code for "not available on this machine", which tests count as skipped.
exit_skip=77

# skip MESSAGE: prints one line that names what is missing, and exits.
skip() {
  echo "$(basename "$0"): $*" >&2
  exit "$exit_skip"
}

# Whether Gazebo 11 is installed on this machine itself.
gazebo_is_native() {
  # Not by a pipe to grep --quiet, which would end gzserver by a signal while it prints the rest.
  command -v gzserver >/dev/null && [[ "$(gzserver --version 2>/dev/null)" == *"version 11."* ]]
}

# require_root WHAT: sets `as_root` to the command prefix that runs a command as root, or skips. Asks
# for a password only on a terminal.
require_root() {
  as_root=()
  [[ $EUID -eq 0 ]] && return
  command -v sudo >/dev/null || skip "$1 needs root, and there is no sudo"
  if [[ -t 0 && -t 2 ]] || sudo -n true 2>/dev/null; then
    as_root=(sudo)
  else
    skip "$1 needs root, and sudo needs a password"
  fi
}
