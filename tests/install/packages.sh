#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the Debian packages twice, checks them with lintian, and installs, uses and removes them in a separate root file system:
#   tests/install/packages.sh BUILD
# Needs root, for chroot. The root file system is made by mmdebstrap and kept in BUILD/packages/root.tar; the packages that it downloads
# later are kept in BUILD/packages/downloads.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$(realpath "${1:-build/release}")
made=$build/packages
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT

SECONDS=0
took () { printf '%4d s: %s\n' "$SECONDS" "$*"; SECONDS=0; }

# The same build gives the same packages, byte for byte.
SOURCE_DATE_EPOCH=$(date -u -d "$(sed -n 's/^## .*(\(.*\))$/\1/p' CHANGELOG.md | head -n 1)" +%s)
export SOURCE_DATE_EPOCH
for attempt in 1 2; do
    rm -rf "$made"/*.deb "$made/_CPack_Packages"
    (cd "$build" && cpack >"$work/cpack.txt" 2>&1) || { cat "$work/cpack.txt"; exit 1; }
    (cd "$made" && sha256sum ./*.deb) >"$work/sums.$attempt"
done
diff "$work/sums.1" "$work/sums.2"
took "$(wc -l <"$work/sums.1") packages made twice, with the same bytes"

lintian --allow-root --fail-on error "$made"/*.deb
took "lintian finds no errors"

if [ ! -f "$made/root.tar" ]; then
    mmdebstrap --quiet --variant=minbase bookworm "$made/root.new.tar"
    mv "$made/root.new.tar" "$made/root.tar"
    took "a clean Debian 12, by mmdebstrap"
fi
root=$work/root
mkdir -p "$root" "$made/downloads/partial"
tar -C "$root" -xf "$made/root.tar"
mkdir "$root/test" "$root/test/downloads"
cp "$made"/*.deb tests/install/in_root.sh tests/install/complete.zsh tests/install/same_bits.py "$root/test/"
"$build/bin/tactus" render graphs/dry_wood.json --duration 1 --out "$root/test/render.csv" 2>/dev/null
cp /etc/resolv.conf "$root/etc/"

# The mounts end with the namespace.
# shellcheck disable=SC2016
unshare --mount --pid --fork bash -euc '
    mount --bind "$1/downloads" "$2/test/downloads"
    mount --rbind /dev "$2/dev"
    mount -t proc proc "$2/proc"
    exec chroot "$2" /bin/bash /test/in_root.sh' bash "$made" "$root"
took "installed, used and removed"
