#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs as root in a clean Debian 12, with the packages in /test: see packages.sh.
set -euo pipefail
cd /test
export LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive HOME=/test/home
mkdir -p "$HOME"
apt=(apt-get -y -qq --no-install-recommends -o "Dir::Cache::archives=/test/downloads" -o APT::Keep-Downloaded-Packages=true -o Dpkg::Use-Pty=0)
ours=$(for package in ./*.deb; do dpkg-deb -f "$package" Package; done)

SECONDS=0
took () { printf '%4d s: %s\n' "$SECONDS" "$*"; SECONDS=0; }
fail () { echo "packages: $*" >&2; exit 1; }
expect () { [ "$2" = "$3" ] || fail "$1: \"$2\" instead of \"$3\""; }
# Lists all files, except temporary ones, those of this test, logs, and the records of dpkg and man.
files ()
{
    find / -xdev \( -path /test -o -path /proc -o -path /tmp -o -path /dev -o -path /var/lib/dpkg -o -path /var/log -o -path /var/cache/man \) -prune \
        -o -print | sort
}

echo force-unsafe-io >/etc/dpkg/dpkg.cfg.d/unsafe-io   # halves the time; this root need not survive a crash

# First, install the packages with all that they need, and the tools of this test. The files that are left after the packages are
# removed are the reference.
"${apt[@]}" update >/dev/null
"${apt[@]}" install ./*.deb python3 man-db bash-completion zsh fish shared-mime-info desktop-file-utils libglib2.0-bin appstream \
    g++ cmake make pkg-config xvfb xauth xdotool >install.txt 2>&1 || { tail -n 20 install.txt; exit 1; }
took "installed with what they depend on"
# shellcheck disable=SC2086
dpkg --purge $ours >/dev/null
files >before.txt
if grep -i tactus before.txt; then fail "these files are left behind"; fi
dpkg -i ./*.deb >/dev/null
took "removed without residue, and installed again"

# The command line, with presets and profiles
echo "$(tactus --version), $(tactus-host --version)"
tactus validate dry_wood /usr/share/tactus/graphs/*.json >/dev/null
tactus render dry_wood --duration 1 --out installed.csv 2>/dev/null
cmp installed.csv render.csv
tactus session dry_wood >/dev/null
tactus bench --help | grep -- --quick >/dev/null
tactus check-plugin --help | grep -- --strict >/dev/null
expect "a profile" "$(tactus play dry_wood --device stylus=hid:no_such 2>&1 | grep -c tactus_board)" 1
man --warnings tactus-render 2>&1 >/dev/null | tee warnings.txt
[ ! -s warnings.txt ] || fail "man warns"
for command in $(tactus --help | sed -n '/^Subcommands/,/^$/s/^  \([a-z-]*\) .*/\1/p'); do man -w "tactus-$command" >/dev/null; done
man -w tactus-host >/dev/null
took "the command line finds presets and profiles, and has man pages"

# Completions
in_bash ()
{
    bash -c '. /usr/share/bash-completion/bash_completion; _completion_loader "$1"; COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) LINE="$*"
        COMP_LINE=${LINE// = /=} COMP_POINT=${#COMP_LINE} COMP_TYPE=9 COMP_KEY=9; _tactus 2>/dev/null; printf "%s\n" "${COMPREPLY[@]}"' bash "$@"
}
in_fish () { fish -c "complete -C '$*'" | cut -f 1; }
in_zsh () { zsh -f complete.zsh "$*"; }
offers ()
{
    local wanted=$1 shell
    shift
    for shell in in_bash in_fish in_zsh; do
        "$shell" "$@" >offered.txt || true
        grep -qF -- "$wanted" offered.txt || { cat offered.txt; fail "$shell does not complete \"$*\" to $wanted"; }
    done
}
offers render tactus ren
offers --record tactus render dry_wood --rec
offers dry_wood tactus validate dry_
offers friction.elasto_plastic tactus nodes friction.
offers drag.deflection tactus render dry_wood --record drag.de
offers drag.mu= tactus render dry_wood --set drag.m
offers roughness= tactus render dry_wood --set rough
offers rising tactus probe drag.force --edge ris
offers --safe tactus-host --sa
expect "an alternative" "$(in_bash tactus render dry_wood --set drag.adhesion = dah)" dahl
expect "a list" "$(in_bash tactus render dry_wood --record drag.force,drag.defl)" drag.force,drag.deflection
tactus play dry_wood --duration 60 --osc off >/dev/null 2>&1 &
playing=$!
for attempt in $(seq 60); do in_bash tactus probe drag.fo | grep -q drag.force && break; sleep 0.5; done
offers drag.force tactus probe drag.fo
kill -INT $playing
wait $playing || true
took "bash, zsh and fish complete commands, options, nodes, ports, presets, parameters and controls"

# The file type of graphs. A file is a graph if it is called *.tactus.json, or if it has no known extension and the content of a graph.
type_of () { gio info -a standard::content-type "$1" | sed -n 's/.*content-type: //p'; }
graph=application/vnd.tactus.graph+json
cp /usr/share/tactus/graphs/dry_wood.json wood.tactus.json
cp wood.tactus.json wood
cp wood.tactus.json wood.json
echo '{ "format": "glTF" }' >other
expect "a graph" "$(type_of wood.tactus.json)" $graph
expect "a graph without an extension" "$(type_of wood)" $graph
expect "a graph called .json" "$(type_of wood.json)" application/json
[ "$(type_of other)" != $graph ] || fail "other JSON is taken for a graph"
update-desktop-database -q
gio mime $graph | grep 'Default application.*tactus-host.desktop' >/dev/null || fail "graphs do not open in the host"
desktop-file-validate /usr/share/applications/tactus-host.desktop
appstreamcli validate --no-net --no-color /usr/share/metainfo/org.tactus_haptics.Tactus.metainfo.xml >appstream.txt || { cat appstream.txt; fail "AppStream"; }
# shellcheck disable=SC2016
xvfb-run -a bash -euc '
    gio open wood.tactus.json &
    for attempt in $(seq 60); do xdotool search --name "Dry wood" >/dev/null 2>&1 && exit; sleep 0.5; done
    exit 1' 2>/dev/null || fail "opening a graph shows no window with its name"
took "a double click on a graph opens the host"

# Examples, built from what is installed
for example in embed embed_c own_node; do
    cmake -S /usr/share/doc/libtactus-dev/examples/$example -B built/$example -DCMAKE_BUILD_TYPE=Release >/dev/null
    cmake --build built/$example >/dev/null
    built/$example/$example /usr/share/tactus/graphs/dry_wood.json >$example.csv
done
python3 same_bits.py render.csv embed_c.csv
# shellcheck disable=SC2046
gcc /usr/share/doc/libtactus-dev/examples/embed_c/main.c $(pkg-config --cflags --libs tactus | sed 's/-std=[^ ]*//') -o by_pkg_config
./by_pkg_config /usr/share/tactus/graphs/dry_wood.json | cmp - embed_c.csv
# shellcheck disable=SC2046
gcc /usr/share/doc/libtactus-dev/examples/live_c/main.c $(pkg-config --cflags --libs tactus-live) -o live_c
./live_c dry_wood stylus=gesture:stroke 0.5   # a preset
ldd live_c | grep libhidapi >/dev/null || fail "libtactus_live has no devices"
[ -x /usr/libexec/tactus/force-guardian ] || fail "there is no guardian"
took "the examples, by CMake and by pkg-config"

if grep -q python3-tactus <<<"$ours"; then
    python3 -c 'import tactus; assert tactus.Graph ("/usr/share/tactus/graphs/dry_wood.json").render (duration=0.1)'
    python3 -c 'import tactus; assert tactus.Graph ("/usr/share/tactus/graphs/liver.json").render (duration=0.1)'   # reads a mesh
    python3 -c 'import tactus; s = tactus.play ("dry_wood", ["stylus=gesture:stroke"], session="off", duration=0.3); assert s.wait (60); s.close()'
    took "the Python module"
fi

# shellcheck disable=SC2086
dpkg --purge $ours >/dev/null
files >after.txt
diff before.txt after.txt || fail "use of the programs left these files behind"
took "removed without residue after use"
