# Sourced by demo and test: goes to the top of the checkout, hands the work to the checkout's owner
# where the script was started through sudo, and lets no two builds run at once.
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# become_owner SCRIPT [ARGUMENT…]: files made in somebody's checkout are to be theirs, not root's.
become_owner() {
  local owner
  owner=$(stat --format=%U .)
  if [[ $EUID -eq 0 && "$owner" != root && "$owner" != UNKNOWN ]]; then
    exec runuser --user "$owner" -- "$@"
  fi
}

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
