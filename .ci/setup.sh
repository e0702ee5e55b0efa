# SPDX-License-Identifier: MIT
# Sourced by demo.sh and test.sh: installs what a fresh Debian 12 needs, and builds.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(build-essential cmake ninja-build pkg-config clang-14
          juce-modules-source libjack-jackd2-dev libxcb1-dev libeigen3-dev libhidapi-dev libevdev-dev catch2
          libcli11-dev librapidcheck-dev libmpfr-dev
          libsamplerate0-dev libspng-dev libturbojpeg0-dev libbenchmark-dev faust
          fonts-inter fonts-dejavu-core
          libboost-dev python3-dev pybind11-dev python3-numpy)

say () { printf '\n== %s\n' "$*"; }

install_packages ()
{
    if ! command -v dpkg-query >/dev/null; then
        say "This is not Debian. Please make sure that these packages are installed: ${packages[*]}"
        return
    fi
    local missing=() package
    for package in "${packages[@]}"; do
        [ "$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    say "Installing ${missing[*]}"
    local root=()
    [ "$(id -u)" -eq 0 ] || root=(sudo)
    "${root[@]}" apt-get update
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}

# build PRESET [TARGET…]: builds these targets, or everything if none is given
build ()
{
    local preset=$1
    shift
    say "Building $preset${*:+: $*} (the first time takes some minutes)"
    [ -f "build/$preset/build.ninja" ] && grep -qx "TACTUS_BENCH:BOOL=${bench:-OFF}" "build/$preset/CMakeCache.txt" ||
        cmake --preset "$preset" -D TACTUS_BENCH="${bench:-OFF}"
    cmake --build --preset "$preset" ${*:+--target "$@"}
}
