#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Adds Tactus to another project, in which it builds only its libraries and changes none of the project's settings:
#   tests/install/parent.sh [--build]
# With --build, also builds them, file by file and optimised, which takes 10 minutes of a processor. A warning that no batch of files shows
# is an error there.
set -euo pipefail
cd "$(dirname "$0")/../.."
source=$PWD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/CMakeLists.txt" <<CMAKE
cmake_minimum_required (VERSION 3.25)
project (Parent CXX)
set (before "\${CMAKE_CXX_FLAGS}|\${CMAKE_CXX_STANDARD}|\${CMAKE_BUILD_TYPE}|\${CMAKE_RUNTIME_OUTPUT_DIRECTORY}|\${CMAKE_POSITION_INDEPENDENT_CODE}")
add_subdirectory ("$source" tactus)
add_executable (plain plain.cpp)
get_directory_property (options COMPILE_OPTIONS)
get_directory_property (link_options LINK_OPTIONS)
set (after "\${CMAKE_CXX_FLAGS}|\${CMAKE_CXX_STANDARD}|\${CMAKE_BUILD_TYPE}|\${CMAKE_RUNTIME_OUTPUT_DIRECTORY}|\${CMAKE_POSITION_INDEPENDENT_CODE}")
if (NOT before STREQUAL after OR options OR link_options)
    message (FATAL_ERROR "Tactus changed the settings of the project that contains it: \${before} -> \${after}, \${options} \${link_options}")
endif ()
foreach (target tactus tactus-host tactus_framework_tests)
    if (TARGET \${target})
        message (FATAL_ERROR "\${target} is built, but only the libraries should be")
    endif ()
endforeach ()
if (NOT TARGET tactus::framework OR NOT TARGET tactus::nodes OR NOT TARGET tactus::run)
    message (FATAL_ERROR "a library is missing")
endif ()
CMAKE
echo 'int main() {}' >"$work/plain.cpp"
cmake -S "$work" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-Werror >/dev/null
echo "add_subdirectory: nothing of the parent is changed"
cmake -S docs/examples/fetch -B "$work/fetch" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTACTUS_SOURCE="$source" >/dev/null
grep -q "^build embed: " "$work/fetch/build.ninja"
echo "FetchContent: docs/examples/fetch is configured"
if [ "${1:-}" = --build ]; then
    cmake --build "$work/build"
    echo "add_subdirectory: built"
    cmake --build "$work/fetch" --target embed
    "$work/fetch/embed" graphs/dry_wood.json >"$work/fetch.txt"
    echo "FetchContent: docs/examples/fetch is built, and prints $(wc -l <"$work/fetch.txt") lines"
fi
