#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the playground and uses it in Chromium:
#   tests/site/run.sh BUILD [PRESET...]
# Without PRESET, all presets are in it. Exit status 77 if packages are missing.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$(realpath "${1:-build/release}")
for program in clang++-22 wasm-ld-22 node chromium chromedriver; do
    command -v $program >/dev/null || { echo "skipped: needs clang-22 lld-22 libc++-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc nodejs chromium chromium-driver python3-selenium"; exit 77; }
done
site=$(mktemp -d)
trap 'rm -rf "$site"' EXIT
/usr/bin/python3 -B docs/site/build_playground.py "$build/bin/tactus" "$site" "${@:2}"
/usr/bin/python3 -B tests/site/playground_test.py "$build/bin/tactus" "$site"
