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
(cd "$work" && cmake --install "$build" --component development --prefix prefix >/dev/null)   # a relative prefix works, too
libs=$(dirname "$(find "$work/prefix" -name 'libtactus.so.*' | head -n 1)")

# No header may need more than Eigen and the standard library, and none may name a file that is not installed.
if grep -rlE '#include <(nlohmann|juce|hidapi|framework|host)' "$work/prefix/include"; then
    echo "an installed header includes what is not installed" >&2
    exit 1
fi
tests/install/headers.sh "$work/prefix/include"

# Links of the installed pages.
cmake --install "$build" --component program --prefix "$work/prefix" >/dev/null
tests/install/pages.py "$work/prefix" "$source"

# Programs that were built against an older version rely on these names.
nm -D --defined-only "$libs/libtactus.so" | awk '$3 ~ /^tactus_/ { sub (/@.*/, "", $3); print $3 }' | sort -u >"$work/symbols"
diff tests/install/c_symbols.txt "$work/symbols"
echo "the shared library exports the $(wc -l <"$work/symbols") functions of the C API"

examples=$work/examples
cp -r docs/examples "$examples"
for example in embed embed_c own_node pictures_c steps; do
    cmake -S "$examples/$example" -B "$work/$example" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
    cmake --build "$work/$example" >/dev/null
    "$work/$example/$example" "$source/graphs/dry_wood.json" >"$work/$example.txt"
    echo "docs/examples/$example: built against the shared library, $(wc -l <"$work/$example.txt") lines printed"
done

# A loop in C, without a warning, and its log.
cmake -S "$examples/loop_c" -B "$work/loop_c" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" \
    -DCMAKE_C_FLAGS="-std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror" >/dev/null
cmake --build "$work/loop_c" >/dev/null
"$work/loop_c/loop_c" "$source/graphs/dry_wood.json" "$work/loop.jsonl" >"$work/loop_c.txt"
"$build/bin/tactus" render --replay "$work/loop.jsonl" --out "$work/loop.csv" 2>/dev/null
echo "docs/examples/loop_c: $(cat "$work/loop_c.txt"); its log replays $(($(wc -l <"$work/loop.csv") - 1)) ticks"

cmake -S "$examples/embed_c" -B "$work/static" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" -DTactus_USE_STATIC_LIBS=ON >/dev/null
cmake --build "$work/static" >/dev/null
"$work/static/embed_c" graphs/dry_wood.json >"$work/static.txt"
cmp "$work/static.txt" "$work/embed_c.txt"
if ldd "$work/static/embed_c" | grep libtactus; then exit 1; fi
echo "the static libraries give the same bits"

# Beside code that uses Eigen with flags of its own: no flag of ours reaches it, values of Eigen's types pass between libraries with and
# without Tactus, and functions of the program do not take the place of those of the library and of nodes.
if nm --defined-only "$libs"/libtactus_*.a 2>/dev/null | grep " W "; then
    echo "a static library has functions that those of a program may replace" >&2
    exit 1
fi
"$build/bin/tactus" render tests/install/beside/turned.json --duration 1 --record motor.force,turned.out --out "$work/turned.csv" 2>/dev/null
for static in OFF ON; do   # in one folder: the second time, it only links
    cmake -S tests/install/beside -B "$work/beside" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS=-march=native -DCMAKE_PREFIX_PATH="$work/prefix" \
        -DTactus_USE_STATIC_LIBS=$static -DNODES="$examples/own_node/nodes" >/dev/null
    cmake --build "$work/beside" >"$work/beside.txt" || { cat "$work/beside.txt"; exit 1; }
    "$work/beside/beside"
    "$work/beside/own_flags" tests/install/beside/turned.json 4000 motor.force turned.out >"$work/own_flags.csv"
    python3 tests/install/same_bits.py "$work/turned.csv" "$work/own_flags.csv"
done

# A plugin from the example, and one that `tactus new-node` writes, builds and tests.
cmake -S "$examples/node_plugin" -B "$work/node_plugin" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/node_plugin" >/dev/null
nm -D --defined-only "$work/node_plugin/ice.tactus" | awk '{ print $3 }' | diff - <(echo tactus_plugin_entry)
"$build/bin/tactus" nodes my.ice --plugins "$work/node_plugin" | grep "Plugin: .*ice.tactus" >/dev/null
CMAKE_PREFIX_PATH=$work/prefix "$build/bin/tactus" new-node mylab rough_wood "$work/rough_wood" >"$work/new_node.txt"
"$build/bin/tactus" nodes --plugins "$work/rough_wood/build" | grep "mylab.rough_wood" >/dev/null
for plugin in "$work/node_plugin/ice.tactus" "$work/rough_wood/build/rough_wood.tactus"; do
    "$build/bin/tactus" check-plugin "$plugin" --strict 3 >"$work/checked.txt" || { cat "$work/checked.txt"; exit 1; }
done
echo "docs/examples/node_plugin and a new node: built as plugins, loaded and checked"

cmake -S "$examples/device_plugin" -B "$work/device_plugin" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/device_plugin" >/dev/null
nm -D --defined-only "$work/device_plugin/serial_arm.tactus-device" | awk '{ print $3 }' | diff - <(echo tactus_device_entry)
"$build/bin/tactus" check-plugin "$work/device_plugin/serial_arm.tactus-device" >"$work/checked.txt" || { cat "$work/checked.txt"; exit 1; }
echo "docs/examples/device_plugin: built as a driver, loaded and checked"

# The same bits as the program, except for the spelling of numbers.
"$build/bin/tactus" render graphs/dry_wood.json --duration 1 --out "$work/render.csv" 2>/dev/null
python3 tests/install/same_bits.py "$work/render.csv" "$work/embed_c.txt"

# Every preset, with its tables and meshes, and with a picture that the example supplies.
cp -r graphs "$work/graphs"
rm "$work/graphs/assets/leather.png"
python3 -B tests/install/png_to_pgm.py graphs/assets/leather.png "$work/graphs/assets/leather.pgm"
for preset in graphs/*.json; do
    "$build/bin/tactus" render "$preset" --duration 2 --out "$work/render.csv" 2>/dev/null
    "$work/pictures_c/pictures_c" "$work/$preset" 2 >"$work/preset.csv"
    python3 tests/install/same_bits.py "$work/render.csv" "$work/preset.csv" $(($(wc -l <"$work/render.csv") - 1)) >"$work/same.txt"
done
echo "all $(find graphs -maxdepth 1 -name '*.json' | wc -l) presets, read by the library: the bits of \`tactus render\`"
mv "$work/graphs/assets/liver.obj" "$work/graphs/assets/gone.obj"
if "$work/pictures_c/pictures_c" "$work/graphs/liver.json" 2>"$work/missing.txt"; then exit 1; fi
grep "liver.obj: there is no such file" "$work/missing.txt" >/dev/null

# The Python package, from its installed files alone.
if cmake --install "$build" --component python --prefix "$work/prefix" >/dev/null && [ -d "$work/prefix/lib/python3/dist-packages/tactus" ]; then
    for example in own_node own_device; do
        (cd graphs && PYTHONPATH=$work/prefix/lib/python3/dist-packages /usr/bin/python3 -B "$examples/python/$example.py") >"$work/python.txt"
        echo "docs/examples/python/$example.py: $(wc -l <"$work/python.txt") lines printed"
    done
else
    echo "docs/examples/python: skipped, because the Python package is not built"
fi

# Sessions on devices, here on a gesture. The library finds the guardian and the presets where they are installed.
cmake --install "$build" --component live --prefix "$work/prefix" >/dev/null
cmake -S "$examples/live_c" -B "$work/live_c" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/live_c" >/dev/null
"$work/live_c/live_c" "$source/graphs/dry_wood.json" stylus=gesture:stroke 0.5 >"$work/live_c.txt"
flags=$(PKG_CONFIG_PATH=$libs/pkgconfig pkg-config --cflags --libs tactus-live)
eval "cc -Wall -Wextra -Werror \"\$examples/live_c/main.c\" $flags -o \"\$work/live_by_pkg_config\""
LD_LIBRARY_PATH=$libs "$work/live_by_pkg_config" "$source/graphs/dry_wood.json" stylus=gesture:stroke 0.5 >/dev/null
echo "docs/examples/live_c: built by CMake and by pkg-config; $(cat "$work/live_c.txt")"
if [ -d "$work/prefix/lib/python3/dist-packages/tactus" ]; then   # the package finds the library of its own prefix
    PYTHONPATH=$work/prefix/lib/python3/dist-packages /usr/bin/python3 -B -c 'import tactus; tactus.check("dry_wood")'
fi

if PKG_CONFIG_PATH=$libs/pkgconfig pkg-config --cflags tactus tactus-live | tr ' ' '\n' | grep -vE '^(-I.*)?$'; then
    echo "pkg-config passes on more than folders of headers" >&2
    exit 1
fi
flags=$(PKG_CONFIG_PATH=$libs/pkgconfig pkg-config --cflags --libs tactus)
eval "cc -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror \"\$examples/embed_c/main.c\" $flags -o \"\$work/c99\""
LD_LIBRARY_PATH=$libs "$work/c99" graphs/dry_wood.json | cmp - "$work/embed_c.txt"
eval "c++ -std=c++20 \"\$examples/embed/main.cpp\" $flags -o \"\$work/by_pkg_config\""   # pkg-config quotes folders for the shell
LD_LIBRARY_PATH=$libs "$work/by_pkg_config" graphs/dry_wood.json | cmp - "$work/embed.txt"
echo "pkg-config: C99 and C++ built, same output"

tests/install/build_tree.sh "$build"
tests/install/parent.sh
