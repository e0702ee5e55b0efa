#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Holds all nodes of the catalogue, built as plugins, to what every node promises, renders all presets with them, and compares what
# their ticks cost. Run by ./test.sh --packages.
#
#   all_nodes.sh BUILD     BUILD is a release build in which the target all_node_plugins is built
set -euo pipefail
build=$1
plugins=$build/tests/plugins/objects/all_nodes

for plugin in "$plugins"/*.tactus; do
    "$build/bin/tactus" check-plugin "$plugin" > "$plugin.txt" || { grep -vE "^  (PASS|SKIPPED) " "$plugin.txt"; exit 1; }
    echo "$(basename "$plugin"): $(grep -c "^  PASS " "$plugin.txt") examinations passed"
done
TACTUS_TESTED_PLUGINS=$plugins "$build/bin/tactus_plugin_tests" "a preset gives the same bits with nodes from a plugin"
if [ -n "$(command -v valgrind)" ]; then
    /usr/bin/python3 -B tests/plugins/cost.py "$build" "$plugins"/*.tactus
else
    echo "skipped: valgrind is not installed, so the cost of a tick is not compared"
fi
