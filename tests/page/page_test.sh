#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs shipped scenarios and examples, and checks their pages in headless Chromium with page_test.py.
#
#   page_test.sh TAGFIELD SOURCE_DIR
set -euo pipefail
tagfield=$(realpath "$1")
source_dir=$(realpath "$2")
runs=$(mktemp --directory --tmpdir page_test-XXXXXX)
trap 'rm -rf "$runs"' EXIT
log="$runs/log"

# make NAME ARGUMENT…: creates one run folder; quiet unless it fails.
make() {
  local name=$1
  shift
  "$tagfield" "$@" --out "$runs/$name" >"$log" 2>&1 || {
    cat "$log"
    echo "tagfield $* failed"
    exit 1
  }
}
scenarios=$source_dir/scenarios
own_csv=$source_dir/examples/03_own_csv
make paper_warehouse run "$scenarios/paper_warehouse.yaml"
make noisy run "$scenarios/paper_warehouse.yaml" --seeds 5 --set pose.source=noisy \
  --set pose.sigma_m=0.01 --set pose.yaw_sigma_deg=0.5
make z_axis run "$scenarios/z_axis.yaml"
make two_antennas run "$scenarios/two_antennas.yaml"
make moving_tags run "$scenarios/moving_tags.yaml"
make spawn run "$scenarios/spawn.yaml"
make own_world run "$source_dir/examples/02_own_world/workshop.yaml"
make slam run "$scenarios/paper_warehouse_slam.yaml"
make own_csv localize "$own_csv/reads.csv" --poses "$own_csv/poses.csv" --tag-height 0.8

code=0
/usr/bin/python3 -B "$source_dir/tests/page/page_test.py" \
  "$runs"/{paper_warehouse,noisy,z_axis,two_antennas,moving_tags,spawn,own_world,own_csv,slam} ||
  code=$?
exit "$code"
