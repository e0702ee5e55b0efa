#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Adds one header and one test to the tree and changes nothing else. Checks that the node builds, is listed, and is tested
# against the contract of all nodes. Both files are removed afterwards; the next build removes them from the programs.
. "$(dirname "$0")/../../.ci/setup.sh"

header=nodes/texture/washboard.hpp
test=tests/nodes/texture/washboard_test.cpp
trap 'rm -f "$header" "$test"' EXIT

cp tests/newcomer/washboard.hpp.txt "$header"
cp tests/newcomer/washboard_test.cpp.txt "$test"
others=$(git status --porcelain 2>/dev/null | grep -vE "washboard" || true)

build release tactus tactus_node_tests

# No -q: grep must read everything. With -q it stops at the first match; SIGPIPE can then kill the writer and fail the
# check
build/release/bin/tactus nodes | grep 'texture\.washboard' >/dev/null
build/release/bin/tactus nodes texture.washboard | grep 'ridge height' >/dev/null
build/release/bin/tactus_node_tests 'washboard*'
build/release/bin/tactus_node_tests 'every node*' -c texture.washboard
[ "$others" = "$(git status --porcelain 2>/dev/null | grep -vE "washboard" || true)" ]
echo "texture.washboard: built, listed and checked against the contract; no other file was changed"
