#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Checks who finds the build tree: a plugin that names it, and no program, even if the programs of the build are in PATH.
#   tests/install/build_tree.sh BUILD
set -euo pipefail
build=$(realpath "${1:-build/release}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required (VERSION 3.22)
project (Finds CXX)
find_package (Tactus 0.2 QUIET)
file (WRITE ${CMAKE_BINARY_DIR}/found.txt "${Tactus_DIR}\n")
if (TARGET tactus::plugin_kit AND NOT COMMAND tactus_add_plugin)
    message (FATAL_ERROR "there is no tactus_add_plugin")
endif ()
CMAKE
PATH=$build/bin:$PATH cmake -S "$work" -B "$work/in_path" >/dev/null
if grep "^$build" "$work/in_path/found.txt"; then
    echo "find_package (Tactus) finds the build tree, because its programs are in PATH" >&2
    exit 1
fi
cmake -S "$work" -B "$work/named" "-DCMAKE_PREFIX_PATH=$build/plugin_kit" >/dev/null
grep -q "^$build/plugin_kit" "$work/named/found.txt"
echo "the build tree is found by who names it, and not through PATH"
