# Shared by ./check and ./reproduce: installs what is missing, configures, builds. Sourced, not run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build_packages="g++ cmake ninja-build libeigen3-dev libsuitesparse-dev libmumps-seq-dev liblapack-dev libopenblas-dev libboost-dev libboost-program-options-dev nlohmann-json3-dev python3 gnuplot-nox"

# Tests at a time. Asked for before the next line, by which nproc goes.
cores=$(env -u OMP_NUM_THREADS nproc)

# One thread: the systems are small, and fixed threads give fixed bits.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1

say() { printf '== %s\n' "$*"; }
fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# install PACKAGE...: those that are not there, by apt, as root or through sudo.
install() {
  command -v dpkg-query >/dev/null || fail "this system has no dpkg; install by hand: $*"
  local missing=() package
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  say "installing ${missing[*]}"
  local as_root=()
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || fail "needs root or sudo to install: ${missing[*]}"
    as_root=(sudo)
  fi
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update && "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1 </dev/null; then
    tail -n 5 "$log" >&2
    fail "apt-get could not install: ${missing[*]}"
  fi
  rm -f "$log"
}

# build DIRECTORY [cmake options]: configures in Release and builds, only the targets that $build_target lists, if any.
build() {
  local directory=$1
  shift
  mkdir -p "$(dirname "$directory")"
  say "building in $directory"
  cmake -S . -B "$directory" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTICKSLIP_WERROR=ON "$@" >"$directory.log" 2>&1 || {
    tail -n 20 "$directory.log" >&2
    fail "cmake could not configure; all it said is in $directory.log"
  }
  # shellcheck disable=SC2086
  cmake --build "$directory" ${build_target:+--target $build_target} >>"$directory.log" 2>&1 || {
    grep -E 'error|FAILED' "$directory.log" | head -n 20 >&2
    fail "the build failed; all it said is in $directory.log"
  }
}
