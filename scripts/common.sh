# SPDX-License-Identifier: Apache-2.0
# Sourced by the other scripts: changes to the top of the checkout; its functions run a script as the
# owner of the checkout if it was started with sudo, and prevent concurrent builds.
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# is_for_owner: whether root runs the script in another user's checkout.
is_for_owner() {
  local owner
  owner=$(stat --format=%U .)
  [[ $EUID -eq 0 && "$owner" != root && "$owner" != UNKNOWN ]]
}

# become_owner SCRIPT [ARGUMENT…]: reruns the script as the owner of the checkout, so that files created
# in it belong to that user, not to root.
become_owner() {
  if is_for_owner; then exec runuser --user "$(stat --format=%U .)" -- "$@"; fi
}

# Options of build/release; with_tests wherever tests are built in it. Always the same set, as another one
# would rebuild everything.
with_ros=(-DTAGFIELD_ROS1=ON -DTAGFIELD_ROS2=ON)
without_ros=(-DTAGFIELD_ROS1=OFF -DTAGFIELD_ROS2=OFF)
with_tests=("${with_ros[@]}" -DTAGFIELD_TESTS=ON -DTAGFIELD_BENCHMARKS=ON -DTAGFIELD_GZ=ON)

# build [TARGET…]: configures build/release if necessary, and builds targets in it.
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

# build_gazebo FOLDER TARGETS [OPTION…]: configures build/FOLDER if necessary and builds plugins in it, with
# the compiler of the system that Gazebo 11 is installed on (whose CMake may be too old for presets).
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
