#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs ./test.sh [MODE] in a folder that outlives the checkout, so that it builds and tests only what changed: kept.sh [MODE]
#
# The folder is $TACTUS_CI_KEEP, by default tactus/ci below $XDG_CACHE_HOME. If that is empty, or the folder cannot be made or is in use, the run
# works in the checkout, from nothing if that is fresh. Why it is right: docs/decisions/time_of_a_run.md.
set -euo pipefail
checkout=$(cd "$(dirname "$0")/.." && pwd)
cache=${XDG_CACHE_HOME:-${HOME:+$HOME/.cache}}
keep=${TACTUS_CI_KEEP-${cache:+$cache/tactus/ci}}

in_checkout () { echo "== Without a kept folder: $1"; exec "$checkout/test.sh" "${@:2}"; }

[ -n "$keep" ] || in_checkout "\$TACTUS_CI_KEEP is empty, or there is no home folder" "$@"
mkdir -p -m 700 "$keep/tactus" 2>/dev/null || in_checkout "$keep cannot be made" "$@"
[ -O "$keep" ] && [ -O "$keep/tactus" ] || in_checkout "$keep belongs to another user, who could have built anything" "$@"
chmod go-w "$keep" "$keep/tactus"
"$checkout/test.sh" --install   # before the versions of all packages are compared below

# All that a run starts inherits the lock, so it is free only when none of it is left, even after kill -9: a compiler may still be writing.
exec 9>"$keep/lock"
flock --timeout "${TACTUS_CI_WAIT:-120}" 9 || in_checkout "another run uses $keep" "$@"

# What else decides about an object than its source and its command: the compilers, what the environment passes to CMake, and the packages. More
# packages than before change nothing that was built. A clock that was set back would let old objects look new.
flags ()
{
    awk '/packages\+?=\(/ { on = 1 } on { print } /\)/ { on = 0 }' "$checkout/.ci/setup.sh" "$checkout/test.sh"   # the list of packages
    env | grep -E '^(CC|CXX|[A-Z]*FLAGS|CMAKE_[A-Z_]*|CPATH|[A-Z_]*INCLUDE_PATH|LIBRARY_PATH|PKG_CONFIG_PATH|CCACHE_[A-Z]*)=' | LC_ALL=C sort || true
    nproc   # decides how tests are joined
    for tool in cc c++ clang++-14 cmake ninja ld; do command -v "$tool" && "$tool" --version; done 2>/dev/null || true
}
packages () { dpkg-query -W -f '${Package}:${Architecture} ${Version} ${db:Status-Abbrev}\n' 2>/dev/null | LC_ALL=C sort || true; }

empty ()
{
    echo "== What was built is deleted: $1"
    rm -rf "$keep/tactus/build"
}

flags >"$keep/flags.new"
packages >"$keep/packages.new"
if [ ! -f "$keep/flags" ] || [ ! -f "$keep/packages" ]; then
    rm -rf "$keep/tactus/build"
elif [ "$keep/flags" -nt "$keep/flags.new" ]; then
    empty "the clock was set back"
elif ! changed=$(diff "$keep/flags" "$keep/flags.new"); then
    empty "the compilers, the flags or the list of packages changed: $changed"
elif ! changed=$(LC_ALL=C comm -23 "$keep/packages" "$keep/packages.new") || [ -n "$changed" ]; then
    empty "these packages changed or are gone: $(head -n 5 <<<"$changed")"
fi
mv "$keep/flags.new" "$keep/flags"
mv "$keep/packages.new" "$keep/packages"

# By content: a file that is unchanged keeps its time, one that changed gets that of the copy, and a deleted one goes. Git sees the commits of the
# checkout, but writes nothing there.
rsync --recursive --links --perms --checksum --delete --exclude=/.git --exclude=/build --exclude=/out "$checkout/" "$keep/tactus/"
rm -rf "$keep/tactus/.git" "$keep/shared"
if git=$(git -c safe.directory='*' -C "$checkout" rev-parse --absolute-git-dir 2>/dev/null); then echo "gitdir: $git" >"$keep/tactus/.git"; fi
[ -d "$checkout/../shared" ] && ln -s "$(cd "$checkout/../shared" && pwd)" "$keep/shared"
export GIT_OPTIONAL_LOCKS=0

echo "== In the kept folder $keep/tactus"
exec "$keep/tactus/test.sh" "$@"
