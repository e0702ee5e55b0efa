#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compiles the installed headers with many warnings, as errors, and with no flag of ours:
#   tests/install/headers.sh INCLUDE_FOLDER [--each]
# All of them together, with g++ and clang++; and those that pages name on their own, with the one or the other; with --each, every header on
# its own, which takes 10 minutes of a processor.
set -euo pipefail
include=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check COMPILER NAME HEADER…: compiles code that includes these headers
check ()
{
    local compiler=$1 name=$2
    shift 2
    printf '#include <tactus/%s>\n' "$@" >"$work/code.cpp"
    "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I"$include" -isystem /usr/include/eigen3 "$work/code.cpp" ||
        { echo "$name: does not compile with $compiler" >&2; exit 1; }
}

mapfile -t headers < <(cd "$include/tactus" && find . -name '*.h' -o -name '*.hpp' | sed 's|^\./||' | sort)
[ "${#headers[@]}" -gt 300 ]
compilers=(g++ clang++-14)
for compiler in "${compilers[@]}"; do check "$compiler" "all headers" "${headers[@]}"; done
each=(tactus.h tactus_plugin.h tactus_device.h node/node.hpp node/catalogue.hpp plan/compile.hpp file/graph_file.hpp run/run.hpp plugin/node_plugin.hpp nodes/deform/plane.hpp)
[ "${2:-}" = --each ] && each=("${headers[@]}")
for i in "${!each[@]}"; do check "${compilers[i % 2]}" "${each[i]}" "${each[i]}"; done
for header in tactus.h tactus_plugin.h tactus_device.h; do
    for compiler in gcc clang-14; do
        echo "#include <tactus/$header>" | "$compiler" -x c -std=c99 -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I"$include" -
    done
done
echo "${#headers[@]} headers compile together, and ${#each[@]} on their own, without warnings"
