#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the site, looks at it, and uses its playground in Chromium:
#   tests/site/run.sh BUILD [PRESET...]
# Without PRESET, all presets are in it. Exit status 77 if packages are missing.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$(realpath "${1:-build/release}")
for program in clang++-22 wasm-ld-22 node chromium chromedriver doxygen; do
    command -v $program >/dev/null || missing=$program
done
/usr/bin/python3 -c 'import breathe, furo, ipykernel, matplotlib, myst_parser, nbsphinx, selenium, sphinx' 2>/dev/null || missing='a package of Python'
[ -e /usr/share/javascript/mathjax/MathJax.js ] || missing=libjs-mathjax
[ -d "$build/python/tactus" ] || missing='the Python package of Tactus'
if [ -n "${missing:-}" ]; then
    echo "skipped: $missing is missing. Packages: clang-22 lld-22 libc++-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc nodejs chromium chromium-driver" \
        "python3-selenium python3-sphinx furo python3-myst-parser python3-breathe python3-nbsphinx" \
        "python3-ipykernel python3-matplotlib pandoc libjs-mathjax doxygen"
    exit 77
fi
site=$(mktemp -d)
trap 'rm -rf "$site"' EXIT
docs/build.sh "$build" "$site/html" "${@:2}"
/usr/bin/python3 -B tests/site/site_test.py "$build/bin/tactus" "$site/html"
/usr/bin/python3 -B tests/site/pages_test.py "$site/html"
/usr/bin/python3 -B tests/site/playground_test.py "$build/bin/tactus" "$site/html/playground"
