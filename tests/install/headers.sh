#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compiles the installed headers with many warnings, as errors, and with no flag of ours:
#   tests/install/headers.sh INCLUDE_FOLDER [--each]
# All of them together, and those that pages name on their own; with --each, every header on its own, which takes 20 minutes of a processor.
set -euo pipefail
include=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check NAME HEADER…: compiles code that includes these headers, with all compilers
check ()
{
    local name=$1 compiler
    shift
    printf '#include <tactus/%s>\n' "$@" >"$work/code.cpp"
    for compiler in g++ clang++-14; do
        "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I"$include" -isystem /usr/include/eigen3 "$work/code.cpp" ||
            { echo "$name: does not compile with $compiler" >&2; exit 1; }
    done
}

mapfile -t headers < <(cd "$include/tactus" && find . -name '*.h' -o -name '*.hpp' | sed 's|^\./||' | sort)
[ "${#headers[@]}" -gt 300 ]
check "all headers" "${headers[@]}"
each=(tactus.h tactus_plugin.h tactus_device.h node/node.hpp node/catalogue.hpp plan/compile.hpp file/graph_file.hpp run/run.hpp plugin/node_plugin.hpp nodes/deform/plane.hpp)
[ "${2:-}" = --each ] && each=("${headers[@]}")
for header in "${each[@]}"; do check "$header" "$header"; done
for header in tactus.h tactus_plugin.h tactus_device.h; do
    for compiler in gcc clang-14; do
        echo "#include <tactus/$header>" | "$compiler" -x c -std=c99 -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I"$include" -
    done
done
echo "${#headers[@]} headers compile together, and ${#each[@]} on their own, with g++ and clang++ and without warnings"
