#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and tests everything from a fresh Debian 12. May be run again.
#
#   ./test.sh           the tests, also under ASan and UBSan (framework and nodes), and a newcomer's node
#   ./test.sh --quick   the tests only
#   ./test.sh --long    before that: each fuzzer for 60 s, and the tests under TSan
. "$(dirname "$0")/.ci/setup.sh"

mode=${1:-}
case $mode in
    ''|--quick|--long) ;;
    *) echo "usage: ./test.sh [--quick|--long]" >&2; exit 2 ;;
esac

packages+=(python3 python3-jsonschema)
[ "$mode" = --long ] && packages+=(clang-14 libclang-rt-14-dev)
install_packages

run_tests () { ctest --test-dir "build/$1" --output-on-failure --parallel "$(nproc)"; }

if [ "$mode" = --long ]; then
    build fuzz
    for fuzzer in build/fuzz/bin/fuzz_*; do
        name=${fuzzer##*/fuzz_}
        say "Fuzzing $name for 60 s"
        mkdir -p "build/fuzz/found/$name"
        "$fuzzer" -max_total_time=60 -print_final_stats=1 -artifact_prefix="build/fuzz/found/$name-" "build/fuzz/found/$name" "tests/fuzz/corpus/$name"
    done
    build tsan
    say "Tests under TSan"
    run_tests tsan
fi

if [ "$mode" != --quick ]; then
    build asan
    say "Tests under ASan and UBSan"
    run_tests asan
fi

build release
if [ "$mode" != --quick ]; then
    say "A newcomer's node"
    tests/newcomer/run.sh
fi
say "Tests"
run_tests release
