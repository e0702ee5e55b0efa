#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the site, with the playground, from a finished build:
#   docs/build.sh [BUILD [OUT [PRESET...]]]
# BUILD is build/release, OUT is build/site/html, and without PRESET all presets are in it. Needs the packages python3-sphinx, furo, python3-myst-parser,
# python3-breathe, python3-nbsphinx, python3-ipykernel, python3-matplotlib, pandoc, libjs-mathjax, doxygen, and those that
# docs/site/build_playground.py names. OUT works on any file server: python3 -m http.server -d OUT
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")
out=${2:-build/site/html}
presets=("${@:3}")
work=$(dirname "$out")/work
mkdir -p "$work"

doxygen - >"$work/doxygen.log" 2>&1 <<END
PROJECT_NAME = Tactus
INPUT = framework/capi/tactus.h framework/plugin/tactus_plugin.h host/devices/live/tactus_live.h host/devices/device_plugins/tactus_device.h
OUTPUT_DIRECTORY = $work/doxygen
OPTIMIZE_OUTPUT_FOR_C = YES
TYPEDEF_HIDES_STRUCT = YES
AUTOLINK_SUPPORT = NO
GENERATE_XML = YES
GENERATE_HTML = NO
GENERATE_LATEX = NO
EXTRACT_ALL = YES
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = TACTUS_API= TACTUS_API_C= TACTUS_PLUGIN_NOEXCEPT= TACTUS_PLUGIN_EXTERN= TACTUS_PLUGIN_EXPORT=
QUIET = YES
END

python=/usr/bin/python3   # Debian's, which has Sphinx
PYTHONPATH=$build/python "$python" -B docs/site/make_pages.py "$build/bin/tactus" "$work/source" "${presets[@]}"
mathjax=$(realpath "$work")/source/_static/mathjax
mkdir -p "$mathjax"
for part in MathJax.js config/TeX-MML-AM_CHTML.js jax/output/CommonHTML jax/element fonts/HTML-CSS/TeX/woff extensions/MathMenu.js extensions/MathEvents.js; do
    (cd /usr/share/javascript/mathjax && cp -rL --parents "$part" "$mathjax")
done
# Debian's furo comes as its sources: a script that imports another one, and a style that is looked for on Debian's web server.
theme=$("$python" -c 'import furo, pathlib; print(pathlib.Path(furo.__file__).parent / "theme/furo/static")')
mkdir -p "$work/source/_static/scripts" "$work/source/_static/styles"
cat "$theme/scripts/gumshoe-patched.js" <(sed '/^import Gumshoe/d' "$theme/scripts/furo.js") >"$work/source/_static/scripts/furo.js"
sed 's|/javascript/normalize.css/||' "$theme/styles/furo.css" >"$work/source/_static/styles/furo.css"
# And this style has lost the rule by which a page is dark where the system is.
{
    echo '@media screen and (prefers-color-scheme: dark) {'
    sed -n '/^  body\[data-theme="dark"\] {/,/}/p' "$theme/styles/furo.css" | sed 's/body\[data-theme="dark"\]/body:not([data-theme="light"])/'
    echo '}'
} >>"$work/source/_static/styles/furo.css"
cp -L /usr/share/javascript/normalize.css/normalize.css "$work/source/_static/styles"
export PYDEVD_DISABLE_FILE_VALIDATION=1   # silences a warning about a debugger, which no notebook here uses
PYTHONPATH=$build/python TACTUS_XML=$(realpath "$work/doxygen/xml") TACTUS_VERSION=$("$build/bin/tactus" --version | grep -o '[0-9.]*' | head -n 1) \
    "$python" -m sphinx -W --keep-going -n -q -j auto -d "$work/doctrees" -b html "$work/source" "$out"
"$python" -B docs/site/build_playground.py "$build/bin/tactus" "$out/playground" "${presets[@]}"
