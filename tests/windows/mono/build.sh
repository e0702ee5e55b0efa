#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds Mono for Windows from Debian's sources, to try Tactus.cs in wine: build.sh [BUILD], default build/windows. Debian has no Mono for Windows, only its
# sources. Takes a quarter of an hour and 2 GB while it runs, once. Classes are those that Debian compiled for Linux: system_native.c has what they call of
# Linux.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
source=$PWD/tests/windows/mono
mkdir -p "${1:-build/windows}/mono/bin"
cd "${1:-build/windows}/mono"

[ ! -f bin/mono.exe ] || exit 0
file=mono_6.8.0.105+dfsg.orig.tar.xz
sha256=6cde75aefc19c55c4dcdae7f22a1f67bdc30f47e41079054bebafeaee3c4d900
[ -f $file ] || /usr/lib/apt/apt-helper download-file http://deb.debian.org/debian/pool/main/m/mono/$file $file SHA256:$sha256
echo "$sha256  $file" | sha256sum --check --quiet
[ -d mono-6.8.0.105+dfsg ] || tar xf $file

mkdir -p build
compiler=x86_64-w64-mingw32
(
    cd build
    [ -f Makefile ] || ../mono-6.8.0.105+dfsg/configure --host=$compiler CC=$compiler-gcc-posix CXX=$compiler-g++-posix --disable-boehm --disable-mcs-build \
        --disable-support-build --disable-btls --with-mcs-docs=no --disable-nls --enable-static --disable-shared >configure.txt 2>&1
    make -C mono >make.txt 2>&1
)
$compiler-gcc-posix -O2 -Wall -Wextra -shared -static "$source/system_native.c" -o bin/System.Native.dll
mkdir -p lib
ln -sfn /usr/lib/mono lib/mono   # where mono.exe looks for them
$compiler-strip -o bin/mono.exe build/mono/mini/mono-sgen.exe
rm -rf build mono-6.8.0.105+dfsg
