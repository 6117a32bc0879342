# SPDX-License-Identifier: Apache-2.0
# Sourced by demo and test: goes to the top of the checkout, hands the work to the checkout's owner
# where the script was started through sudo, and lets no two builds run at once.
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# is_for_owner: whether root runs the script in somebody else's checkout.
is_for_owner() {
  local owner
  owner=$(stat --format=%U .)
  [[ $EUID -eq 0 && "$owner" != root && "$owner" != UNKNOWN ]]
}

# become_owner SCRIPT [ARGUMENT…]: files made in somebody's checkout are to be theirs, not root's.
become_owner() {
  if is_for_owner; then exec runuser --user "$(stat --format=%U .)" -- "$@"; fi
}

# What build/release is configured with wherever tests are built in it; only one set, as another would
# build everything anew.
with_ros=(-DTAGFIELD_ROS1=ON -DTAGFIELD_ROS2=ON)
without_ros=(-DTAGFIELD_ROS1=OFF -DTAGFIELD_ROS2=OFF)
with_tests=("${with_ros[@]}" -DTAGFIELD_TESTS=ON -DTAGFIELD_BENCHMARKS=ON -DTAGFIELD_GZ=ON)

# build [TARGET…]: configures if need be and builds build/release.
build() {
  mkdir -p build
  exec 9>build/.lock
  flock 9
  cmake --preset release "${configure[@]}" >build/configure.log 2>&1 || {
    cat build/configure.log >&2
    exit 1
  }
  cmake --build build/release --target "$@"
  exec 9>&-
}

# build_gazebo FOLDER TARGETS [OPTION…]: configures if need be and builds plugins in build/FOLDER, with
# the compiler of the system that Gazebo 11 is on (whose CMake may be too old for presets).
build_gazebo() {
  local folder=$1 targets
  read -ra targets <<<"$2"
  shift 2
  mkdir -p build
  exec 8>build/.gazebo-lock
  flock 8
  scripts/in-gazebo cmake -G Ninja -S . -B "build/$folder" -DCMAKE_BUILD_TYPE=Release \
    -DTAGFIELD_COMMAND=OFF -DTAGFIELD_GAZEBO=ON "$@" >"build/$folder-configure.log" 2>&1 || {
    local code=$?
    cat "build/$folder-configure.log" >&2
    exit "$code"
  }
  scripts/in-gazebo cmake --build "build/$folder" --target "${targets[@]}"
  exec 8>&-
}
