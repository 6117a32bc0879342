#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages into a bare Debian 12 and uses them there. It installs 2 GB, so it runs only where
# TAGFIELD_PACKAGES_ROOT names the folder of one, or of one to be made (root, network, debootstrap).
#
#   packages_test.sh SOURCE_DIR
set -euo pipefail
cd "$1"
root=${TAGFIELD_PACKAGES_ROOT:-}
if [[ -z "$root" ]]; then
  echo "skipped: TAGFIELD_PACKAGES_ROOT names no folder for a bare Debian 12"
  exit 77
fi
if [[ ! -x "$root/usr/bin/apt-get" ]]; then
  PATH=$PATH:/usr/sbin debootstrap --variant=minbase bookworm "$root"
fi
scripts/package
scripts/package --try "$root"
