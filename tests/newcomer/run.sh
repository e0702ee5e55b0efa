#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A newcomer drops one header and one test into the tree and touches nothing else: the node builds, is listed, and is
# held to what every node promises. Both files are taken away again.
set -euo pipefail
cd "$(dirname "$0")/../.."

header=nodes/texture/washboard.hpp
test=tests/nodes/texture/washboard_test.cpp
clean () { rm -f "$header" "$test"; }
trap 'clean; cmake --build --preset release --target tactus tactus_tests >/dev/null' EXIT

cp tests/newcomer/washboard.hpp.txt "$header"
cp tests/newcomer/washboard_test.cpp.txt "$test"
others=$(git status --porcelain 2>/dev/null | grep -vE "washboard" || true)

cmake --build --preset release --target tactus tactus_tests

# grep reads all of it: one that stops at the first match (-q) may end the writer by SIGPIPE, and so the check by chance
build/release/bin/tactus nodes | grep 'texture\.washboard' >/dev/null
build/release/bin/tactus nodes texture.washboard | grep 'ridge height' >/dev/null
build/release/bin/tactus_tests 'washboard*'
build/release/bin/tactus_tests 'every node*' -c texture.washboard
[ "$others" = "$(git status --porcelain 2>/dev/null | grep -vE "washboard" || true)" ]
echo "texture.washboard: built, listed, held to the contract; no other file was touched"
