#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests that scripts/setup skips optional packages that a system does not have, reports them, and installs all others;
# with stubs for the programs of apt and dpkg, which install nothing.
#
#   setup_test.sh SOURCE_DIR
set -euo pipefail
cd "$1"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
export FOLDER=$folder

program() { cat >"$folder/bin/$1" && chmod 755 "$folder/bin/$1"; }
# Installed packages are those listed in the file `installed`; with `all` in it, all are.
program dpkg-query <<'END'
#!/bin/sh
for package; do :; done
grep -qxF -e "$package" -e all "$FOLDER/installed" && printf installed
END
# Package lists exist once there is a file `lists`, which names the packages that they lack.
program apt-cache <<'END'
#!/bin/sh
[ -e "$FOLDER/lists" ] || exit 0
shift
for package; do
  grep -qxF -- "$package" "$FOLDER/lists" || echo "$package | 1.0 | archive Packages"
done
END
program apt-get <<'END'
#!/bin/sh
echo "$*" >>"$FOLDER/calls"
case " $* " in
  *" update "*) cp "$FOLDER/archive" "$FOLDER/lists" ;;
  *" libassimp-dev "*)
    if grep -qxF libassimp-dev "$FOLDER/lists"; then echo "E: Unable to locate package libassimp-dev" >&2; exit 100; fi ;;
esac
END
printf '#!/bin/sh\nexec "$@"\n' | program sudo
export PATH="$folder/bin:$PATH"

# setup INSTALLED ARCHIVE_LACKS LISTS [OPTION…]: runs scripts/setup; sets `code` to its exit code and `said` to its
# output.
setup() {
  rm -f "$folder/lists" "$folder/calls"
  tr ' ' '\n' <<<"$1" >"$folder/installed"
  tr ' ' '\n' <<<"$2" >"$folder/archive"
  [[ "$3" == none ]] || cp "$folder/archive" "$folder/lists"
  touch "$folder/calls"
  shift 3
  code=0
  said=$(scripts/setup "$@" 2>&1) || code=$?
}
fail() {
  echo "$1: exit code $code; said '$said'; apt-get was called with '$(cat "$folder/calls")'"
  exit 1
}
installs() { grep ' install ' "$folder/calls" | grep -qF -- " $1"; }
ros1="libnav-msgs-dev librosbag-storage-dev libtf2-dev python3-gencpp ros-geometry-msgs ros-std-msgs"

setup all "" known --ros
[[ $code -eq 0 && -z "$said" && ! -s "$folder/calls" ]] || fail "all is there"

for lists in known none; do
  setup nothing "" "$lists" --ros
  { [[ $code -eq 0 && "$said" != *"no package"* ]] && installs g++ && installs ros-std-msgs; } ||
    fail "all can be had, lists $lists"

  setup nothing "$ros1" "$lists" --ros
  { [[ $code -eq 0 && "$said" == *"has no package $ros1; left out without: ROS 1"* ]] && installs g++ &&
    ! installs ros-std-msgs && installs cyclonedds-dev; } || fail "no ROS 1, lists $lists"

  setup nothing libassimp-dev "$lists"
  [[ $code -eq 100 && "$said" == *"Unable to locate package libassimp-dev"* ]] || fail "no Assimp, lists $lists"
done

# If no missing package is available, that is reported, and the network is not used.
everything=$(sed -nE '/^packages=\(/,/^\)/{s/#.*//;s/^packages=\(|^\)//;p}' scripts/setup | xargs)
[[ "$everything" == *libassimp-dev* ]] || fail "the packages are not where they were"
setup "${everything/coinor-libcbc-dev /}" coinor-libcbc-dev known
[[ $code -eq 0 && "$said" == *"coinor-libcbc-dev; left out without: exact plans of antennas" && ! -s "$folder/calls" ]] ||
  fail "nothing that is missing can be had"
setup "${everything/coinor-libcbc-dev /}" coinor-libcbc-dev known --check
[[ $code -eq 1 && ! -s "$folder/calls" ]] || fail "--check"
