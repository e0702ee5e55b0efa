#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the libraries into a temporary folder, and builds and runs docs/examples against them, as a user would:
#   tests/install/run.sh BUILD
set -euo pipefail
cd "$(dirname "$0")/../.."
source=$PWD
build=$(realpath "${1:-build/release}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --component library --prefix "$work/prefix" >/dev/null
cmake --install "$build" --component development --prefix "$work/prefix" >/dev/null
libs=$(dirname "$(find "$work/prefix" -name 'libtactus.so.*' | head -n 1)")

# No header may need more than Eigen and the standard library, and none may name a file that is not installed.
if grep -rlE '#include <(nlohmann|juce|hidapi|framework|host)' "$work/prefix/include"; then
    echo "an installed header includes what is not installed" >&2
    exit 1
fi

# Programs that were built against an older version rely on these names.
nm -D --defined-only "$libs/libtactus.so" | awk '$3 ~ /^tactus_/ { sub (/@.*/, "", $3); print $3 }' | sort -u >"$work/symbols"
diff tests/install/c_symbols.txt "$work/symbols"
echo "the shared library exports the $(wc -l <"$work/symbols") functions of the C API"

examples=$work/examples
cp -r docs/examples "$examples"
for example in embed embed_c own_node; do
    cmake -S "$examples/$example" -B "$work/$example" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
    cmake --build "$work/$example" >/dev/null
    "$work/$example/$example" "$source/graphs/dry_wood.json" >"$work/$example.txt"
    echo "docs/examples/$example: built against the shared library, $(wc -l <"$work/$example.txt") lines printed"
done

cmake -S "$examples/embed_c" -B "$work/static" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" -DTactus_USE_STATIC_LIBS=ON >/dev/null
cmake --build "$work/static" >/dev/null
"$work/static/embed_c" graphs/dry_wood.json >"$work/static.txt"
cmp "$work/static.txt" "$work/embed_c.txt"
if ldd "$work/static/embed_c" | grep libtactus; then exit 1; fi
echo "the static libraries give the same bits"

# The same bits as the program, except for the spelling of numbers.
"$build/bin/tactus" render graphs/dry_wood.json --duration 1 --out "$work/render.csv" 2>/dev/null
python3 - "$work/render.csv" "$work/embed_c.txt" <<'PYTHON'
import csv, sys
a, b = ([row for row in csv.reader(open(name))] for name in sys.argv[1:])
assert a[0] == b[0], (a[0], b[0])
assert len(a) == len(b) == 4001, (len(a), len(b))
for x, y in zip(a[1:], b[1:]):
    assert [float(v) for v in x[1:]] == [float(v) for v in y[1:]], (x, y)
print("4000 ticks from C equal `tactus render`, bit for bit")
PYTHON

flags=$(PKG_CONFIG_PATH=$libs/pkgconfig pkg-config --cflags --libs tactus)
# shellcheck disable=SC2086
c++ "$examples/embed/main.cpp" $flags -o "$work/by_pkg_config"
LD_LIBRARY_PATH=$libs "$work/by_pkg_config" graphs/dry_wood.json | cmp - "$work/embed.txt"
echo "pkg-config: built, same output"

# As part of another project, Tactus builds only its libraries and changes none of the project's settings.
mkdir "$work/parent"
cat >"$work/parent/CMakeLists.txt" <<CMAKE
cmake_minimum_required (VERSION 3.25)
project (Parent CXX)
set (before "\${CMAKE_CXX_FLAGS}|\${CMAKE_CXX_STANDARD}|\${CMAKE_BUILD_TYPE}|\${CMAKE_RUNTIME_OUTPUT_DIRECTORY}|\${CMAKE_POSITION_INDEPENDENT_CODE}")
add_subdirectory ($source tactus)
add_executable (plain plain.cpp)
get_directory_property (options COMPILE_OPTIONS)
get_directory_property (link_options LINK_OPTIONS)
set (after "\${CMAKE_CXX_FLAGS}|\${CMAKE_CXX_STANDARD}|\${CMAKE_BUILD_TYPE}|\${CMAKE_RUNTIME_OUTPUT_DIRECTORY}|\${CMAKE_POSITION_INDEPENDENT_CODE}")
if (NOT before STREQUAL after OR options OR link_options)
    message (FATAL_ERROR "Tactus changed the settings of the project that contains it: \${before} -> \${after}, \${options} \${link_options}")
endif ()
foreach (target tactus tactus-host tactus_tests)
    if (TARGET \${target})
        message (FATAL_ERROR "\${target} is built, but only the libraries should be")
    endif ()
endforeach ()
if (NOT TARGET tactus::framework OR NOT TARGET tactus::nodes OR NOT TARGET tactus::run)
    message (FATAL_ERROR "a library is missing")
endif ()
CMAKE
echo 'int main() {}' >"$work/parent/plain.cpp"
cmake -S "$work/parent" -B "$work/parent/build" -G Ninja >/dev/null
echo "add_subdirectory: nothing of the parent is changed"
