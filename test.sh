#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and tests everything. Works on a fresh Debian 12 and can be run repeatedly.
#
#   ./test.sh           runs the tests, normally and under ASan and UBSan (without the window, and without the laws of nodes: --sanitizers), runs
#                       the demo, adds a node as a newcomer would, builds the examples against the installed library, drives virtual HID devices
#                       in a QEMU guest, and looks for mistakes in a few of the changed files with clang-tidy. What passed before in this folder,
#                       and reads nothing that has changed, does not run again
#   ./test.sh --all     runs these tests again, too
#   ./test.sh --kept    does the same as ./test.sh in a folder that outlives the checkout (.ci/kept.sh), as .ci/run does; --kept --all and --kept
#                       --daily, too
#   ./test.sh --daily   adds to --all: builds everything again from nothing, compares each object with the one that was kept, and builds and tests
#                       everything with clang. All tests use a new seed. Includes the bench
#   ./test.sh --quick   runs only the tests
#   ./test.sh --long    adds to ./test.sh: each fuzzer for 60 s, 10 000 mutated files through the command line, each installed header
#                       compiled on its own, the tests under TSan (thread tests for 60 s each), the window under ASan and UBSan, the files that
#                       tests read compared with those that CMake names for them, the energy of elastic surfaces on 1000 long loops for each
#                       body and friction, soaks of 1.2e8 ticks and of the reports of 30 minutes on each wire, side by side, and an eighth of all
#                       files with clang-tidy. All tests use a new seed, and those with properties five more: each is printed.
#                       RC_PARAMS=seed=N ./test.sh --quick uses it again
#
# Each of these runs only one part:
#   ./test.sh --screens drives the host with mouse and keyboard on a virtual display, draws build/screens/, exports stems that sox and ffprobe open,
#                       copies a graph from one window to another, and films the first minute;
#                       with --update, also copies the film and the pictures used in the pages to docs/host/
#   ./test.sh --sound   plays a ring on a virtual sound card, strokes a board in the host with the mouse, and listens to both
#   ./test.sh --devices drives the virtual HID devices
#   ./test.sh --export  exports all presets and 500 random graphs as C++ code, compiles it with g++ and clang++, and compares the
#                       bits; does this for the presets on a Cortex-M7 in QEMU, too, in single precision on a Cortex-M4, and as WebAssembly in
#                       node; builds and loads a unit for co-simulation; runs all presets fused
#   ./test.sh --site    builds the site with all presets, and uses its playground in Chromium; --long does, too
#   ./test.sh --figures redraws docs/figures/ and recounts docs/instructions.md
#   ./test.sh --windows builds for Windows with mingw-w64, and runs what it built in wine (docs/windows.md): all presets give the same bits, files with
#                       other names and line ends, plugins, devices on serial ports and behind fake libraries, and the tests; with --sources,
#                       only compiles the sources that differ on Windows
#   ./test.sh --packages makes the Debian packages, and installs, uses and removes them in a clean Debian (needs root); before that,
#                       it builds the libraries as part of another project, and all nodes as plugins, and examines these
#   ./test.sh --format  compares every source file with .clang-format, as each run does; with --fix, also formats it
#   ./test.sh --tidy [PART/PARTS | --changed | FILE...] looks for mistakes in all files with clang-tidy, which takes an hour of a processor, or in
#                       one part of them, in a few of the changed ones, or in these files
#   ./test.sh --drivers drives the drivers of lab devices on two threads against their fakes, which fail in turn, under ASan and UBSan and under
#                       TSan, without building all tests; --sanitizers does this, too
#   ./test.sh --sanitizers runs the tests under ASan and UBSan and under TSan, and the window under ASan and UBSan
#   ./test.sh --coverage counts which lines the tests run, without the window: build/coverage/index.html
#   ./test.sh --install installs the packages that ./test.sh and ./demo.sh need
. "$(dirname "$0")/.ci/setup.sh"

if [ "${1:-}" = --kept ]; then exec .ci/kept.sh "${@:2}"; fi
mode=${1:-}
case $mode in
    ''|--all|--daily|--quick|--long|--screens|--sound|--devices|--export|--site|--figures|--windows|--packages|--format|--tidy|--drivers|--sanitizers|--coverage|--install) ;;
    *) echo "usage: ./test.sh [--kept] [--all|--daily|--quick|--long|--screens [--update]|--sound|--devices|--export|--site|--figures|--windows [--sources]|--packages|--format [--fix]|--tidy [PART/PARTS | --changed | FILE...]|--drivers|--sanitizers|--coverage|--install]" >&2; exit 2 ;;
esac

wasm_packages=(clang-22 lld-22 libc++-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc nodejs)
packages+=(rsync python3-jsonschema python3-websockets python3-distributed python3-build python3-venv python3-pip mypy python3-pandas python3-xarray python3-matplotlib xvfb xdotool openbox x11-utils)
case $mode in ''|--all|--daily|--long|--drivers|--sanitizers|--install) packages+=(libclang-rt-14-dev) ;; esac
case $mode in ''|--all|--daily|--quick|--long|--install) packages+=(valgrind) ;; esac
case $mode in ''|--all|--daily|--quick|--long|--format|--install) packages+=(clang-format-14) ;; esac
case $mode in ''|--all|--daily|--long|--tidy|--install) packages+=(clang-tidy-14) ;; esac
[ "$mode" = --long ] && [ -n "${TACTUS_ISAACLAB_HAPLY:-}" ] && packages+=(python3-torch python3-numpy)   # for IsaacLab's client of the Inverse3
[ "$mode" = --long ] && packages+=(strace)
[ "$mode" = --coverage ] && packages+=(gcovr)
[ "$mode" = --export ] && packages+=(gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib qemu-system-arm)
case $mode in --long|--export|--site) packages+=("${wasm_packages[@]}") ;; esac   # without them, the tests that need them are skipped, with a message
case $mode in --long|--site) packages+=(chromium chromium-driver python3-selenium python3-sphinx furo python3-myst-parser python3-breathe python3-nbsphinx python3-ipykernel pandoc libjs-mathjax doxygen) ;; esac
[ "$mode" = --figures ] && packages+=(valgrind)
[ "$mode" = --screens ] && packages+=(xauth imagemagick ffmpeg sox fonts-dejavu-core)
[ "$mode" = --sound ] && packages+=(xauth imagemagick jackd2 jack-capture python3-numpy)
[ "$mode" = --windows ] && packages+=(g++-mingw-w64-x86-64-posix)
[ "$mode" = --windows ] && [ "${2:-}" != --sources ] && packages+=(lld-14 wine64 xauth imagemagick mono-mcs mono-runtime)
[ "$mode" = --packages ] && packages+=(dpkg-dev lintian mmdebstrap valgrind)
install_packages

# Without these packages the guest is skipped, with a message.
case $mode in ''|--all|--daily|--long|--devices|--install) (packages=(qemu-system-x86 busybox-static cpio kmod procps) && install_packages) || true ;; esac

[ "$mode" = --install ] && exit

# Property tests use the same random inputs each time, so a commit either passes or fails. --daily and --long use new ones.
seeds () { shuf --input-range 1-2147483647 --head-count "$1"; }
case $mode in --daily|--long)
    export RC_PARAMS=${RC_PARAMS:-seed=$(seeds 1)} bench=ON
    say "Random inputs: RC_PARAMS=$RC_PARAMS"
esac
[ "$mode" = --long ] && export TACTUS_READINGS=${TACTUS_READINGS:-30000}   # of each device that is compared with a render
export RC_PARAMS=${RC_PARAMS:-seed=1}
[ "$mode" = --packages ] && bench=ON
again=()
case $mode in --all|--daily) again=(--all) ;; esac

run_tests ()
{
    local preset=$1
    shift
    /usr/bin/python3 -B .ci/remember.py tests "build/$preset" "${again[@]}" "$@"
}

# more_properties N: runs the files of tests that have properties with N new seeds
more_properties ()
{
    local files seed program
    files=$(grep -rl 'support/property.hpp' tests --include='*_test.cpp' | sed 's|.*/\(.*\)\.cpp|[#\1]~[.]|' | sort -u | paste -sd,)
    for seed in $(seeds "$1"); do
        say "Tests with properties: RC_PARAMS=seed=$seed"
        for program in build/release/bin/tactus_*_tests; do
            RC_PARAMS=seed=$seed "$program" --filenames-as-tags "$files"
        done
    done
}

sources () { find framework nodes host tests docs -name '*.[ch]' -o -name '*.[ch]pp'; }

case $mode in ''|--all|--daily|--quick|--long|--format)
    say "Formatting"
    if [ "${2:-}" = --fix ]; then sources | xargs clang-format-14 -i; else sources | xargs clang-format-14 --dry-run -Werror; fi
esac
[ "$mode" = --format ] && exit

tidy ()
{
    say "Looking for mistakes"
    cmake --preset tidy >/dev/null
    /usr/bin/python3 -B tests/structure/tidy.py build/tidy "$@"
}

if [ "$mode" = --tidy ]; then
    tidy "${@:2}"
    exit
fi

sanitize ()
{
    # Memory errors depend on the kind of input, rarely on the number of inputs.
    local percent=20 parts=()
    case $mode in
        --long|--sanitizers) build asan; build asan tactus_law_tests ;;
        *) percent=10 parts=(--label-exclude '^law$'); build asan ;;
    esac
    say "Tests under ASan and UBSan"
    RC_PARAMS="$RC_PARAMS max_success=$percent" TACTUS_ROUNDS=$percent run_tests asan "${parts[@]}"
}

sanitize_more ()
{
    build tsan
    say "Tests under TSan"
    TACTUS_LIVE_SECONDS=60 run_tests tsan --label-exclude '^law$'   # they have one thread
    build asan-window tactus_app_tests
    say "The window under ASan and UBSan"
    TACTUS_UI_ACTIONS=10000 run_tests asan-window -R '^app:'
}

if [ "$mode" = --sanitizers ]; then
    sanitize
    sanitize_more
    exit
fi

if [ "$mode" = --drivers ]; then
    for preset in asan tsan; do
        build "$preset" exercise_drivers
        say "Drivers and their fakes: $preset"
        "build/$preset/bin/exercise_drivers"
    done
    exit
fi

if [ "$mode" = --coverage ]; then
    build coverage
    say "Tests"
    RC_PARAMS="$RC_PARAMS max_success=20" TACTUS_ROUNDS=20 run_tests coverage --label-exclude whole || true   # what fails here fails in ./test.sh
    say "Lines that they run"
    gcovr --root . --filter 'framework/|nodes/|host/' --object-directory build/coverage --gcov-ignore-parse-errors -j "$(nproc)" \
        --print-summary --html-details build/coverage/index.html | tail -3
    exit
fi

if [ "$mode" = --devices ]; then
    build release tactus guest_device
    say "Devices"
    tests/guest/test_devices.sh build/release || [ $? -eq 77 ]   # skipped
    exit
fi

if [ "$mode" = --screens ]; then
    build release tactus-host
    say "Walking through the host"
    rm -rf build/screens
    /usr/bin/python3 tests/host/app/screens/walk.py build/release/bin/tactus-host build/screens
    say "Composing with the keyboard, and copying between two windows"
    /usr/bin/python3 -B tests/host/app/screens/compose.py build/release/bin/tactus-host build/screens
    say "Filming the first minute"
    /usr/bin/python3 -B tests/host/app/screens/film.py build/release/bin/tactus-host build/screens
    if [ "${2:-}" = --update ]; then
        cp build/screens/first_minute.{webm,png} docs/host/
        grep -oh 'host/[0-9a-z-]*\.png' README.md docs/*.md | sort -u | while read -r picture; do
            cp "build/screens/${picture#host/}" docs/host/
        done
    fi
    exit
fi

if [ "$mode" = --sound ]; then
    build release tactus-host tactus
    say "Listening to a ring on a sound card"
    /usr/bin/python3 -B tests/audio/ring.py build/release/bin/tactus out/listen
    say "Listening to strokes"
    /usr/bin/python3 -B tests/host/app/screens/listen.py build/release/bin/tactus-host out/listen
    exit
fi

if [ "$mode" = --export ]; then
    build release tactus tactus_tool_tests
    say "Exported graphs"
    jobs=()
    for compiler in g++ clang++-14; do
        TACTUS_EXPORT_GRAPHS=500 TACTUS_EXPORT_COMPILERS=$compiler build/release/bin/tactus_tool_tests "[export_all]" &
        jobs+=($!)
    done
    for job in "${jobs[@]}"; do wait "$job"; done
    build/release/bin/tactus_tool_tests "[export],[export_targets]"
    say "Fused graphs"
    build/release/bin/tactus_tool_tests "[fuse_all]"
    say "On a Cortex-M7, and in single precision on a Cortex-M4"
    jobs=()
    for board in m7 m4; do
        build/release/bin/tactus_tool_tests "[export_$board]" &
        jobs+=($!)
    done
    for job in "${jobs[@]}"; do wait "$job"; done
    say "In node"
    build/release/bin/tactus_tool_tests "[export_wasm]"
    exit
fi

if [ "$mode" = --site ]; then
    build release tactus tactus_python
    say "The site, and its playground in a browser"
    tests/site/run.sh build/release
    exit
fi

if [ "$mode" = --figures ]; then
    build release
    build release instructions whole_tick
    say "Figures"
    build/release/bin/tactus_tool_tests "[figures]"
    /usr/bin/python3 tests/figures/draw.py   # Debian's Python, which has matplotlib
    say "Instructions per tick"
    /usr/bin/python3 tests/bench/instructions.py build/release
    exit
fi

if [ "$mode" = --windows ] && [ "${2:-}" = --sources ]; then
    say "Sources for Windows"
    /usr/bin/python3 -B tests/windows/sources.py
    exit
fi

if [ "$mode" = --windows ]; then
    build release tactus tactus_shared plugin_in_c tactus_cli_tests
    build windows tried_in_wine
    say "In wine"
    xvfb-run -a /usr/bin/python3 -B tests/windows/run.py build/release/bin/tactus build/windows
    exit
fi

if [ "$mode" = --packages ]; then
    build release
    build release all_node_plugins instructions
    say "As part of another project"
    tests/install/parent.sh --build
    say "All nodes as plugins"
    tests/plugins/all_nodes.sh build/release
    say "Packages"
    root=()
    [ "$(id -u)" -eq 0 ] || root=(sudo)
    "${root[@]}" tests/install/packages.sh build/release
    exit
fi

if [ "$mode" = --long ]; then
    build fuzz fuzzers
    say "Fuzzing for 60 s each"
    printf '%s\n' build/fuzz/bin/fuzz_* | xargs -P "$(nproc)" -I{} bash -euc '
        name=${1##*/fuzz_}
        mkdir -p "build/fuzz/found/$name"
        "$1" -max_total_time=60 -print_final_stats=1 -artifact_prefix="build/fuzz/found/$name-" "build/fuzz/found/$name" "tests/fuzz/corpus/$name" \
            >"build/fuzz/$name.txt" 2>&1 || { cat "build/fuzz/$name.txt"; exit 1; }
        echo "$name: $(sed -n "s/^stat::number_of_executed_units: *//p" "build/fuzz/$name.txt") inputs, none of which does harm"' fuzz {}
    build release tactus
    say "Mutated files through the command line"
    /usr/bin/python3 -B tests/fuzz/whole_program.py build/release/bin/tactus --count 10000
    build release
    say "Each installed header"
    cmake --install build/release --component development --prefix build/installed >/dev/null
    tests/install/headers.sh build/installed/include --each
    sanitize_more
fi

# Each run trusts what earlier runs built. Once a day, everything is built again in the same folder, and must come out the same.
kept=
if [ "$mode" = --daily ] && [ -d build/release ] && [ -d build/asan ]; then
    build asan
    build release
    rm -rf build.kept
    mv build build.kept
    kept=build.kept
fi

if [ "$mode" != --quick ]; then
    tidy --changed
    if [ "$mode" = --long ]; then tidy "$(shuf --input-range 1-8 --head-count 1)/8"; fi
    sanitize
fi

# once NAME INPUT... -- COMMAND: a command that is not run again while it reads the same
once () { if [ ${#again[@]} -eq 0 ]; then /usr/bin/python3 -B .ci/remember.py once build/release "$@"; else while [ "$1" != -- ]; do shift; done; "${@:2}"; fi; }

parts=()
if [ "$mode" = --quick ]; then
    parts=(--label-exclude whole)
    build release
else
    say "A newcomer's node"
    mkdir -p build/release
    once newcomer tests/newcomer tests/CMakeLists.txt tests/parts.cmake tests/join.cmake tests/every_node_test.cpp CMakeLists.txt nodes/CMakeLists.txt \
        framework/node host/code/CMakeLists.txt host/code/fuse/bitcode -- tests/newcomer/run.sh   # before the rest is built: what it compiles is not compiled again
    build release
    say "The demo"
    once demo demo.sh .ci/setup.sh graphs build/release/bin/tactus ../shared/data/strokes_evemu ../shared/data/buttons_switchcurves -- ./demo.sh --offline
fi
if [ -n "$kept" ]; then
    say "Comparing with what was kept"
    status=0
    /usr/bin/python3 -B .ci/compare_builds.py "$kept" build || status=$?
    if [ $status -eq 0 ]; then   # then it is true for these, too, that they passed
        for preset in release asan; do cp "$kept/$preset/passed.json" "build/$preset/" 2>/dev/null || true; done
    fi
    rm -rf "$kept"
    [ $status -eq 0 ] || exit $status
fi
if [ "$mode" = --daily ]; then
    build clang
    say "Tests, compiled by clang"
    run_tests clang --label-exclude whole
fi
say "Tests"
run_tests release "${parts[@]}"
if [ "$mode" = --long ]; then
    more_properties 5
    say "Files that tests read"
    /usr/bin/python3 -B tests/structure/reads.py build/release || [ $? -eq 77 ]   # skipped
    say "The energy of elastic surfaces on long loops"
    build/release/bin/tactus_node_tests "[long]"
    say "Soak"
    TACTUS_SOAK_TICKS=120000000 TACTUS_SOAK_SECONDS=1800 /usr/bin/python3 -B tests/host/soak.py build/release/bin/tactus_*_tests
    say "The site, and its playground in a browser"
    tests/site/run.sh build/release
fi
