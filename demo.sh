#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Works on a fresh Debian 12: installs what is needed, builds, and opens the host. Without a display, it renders all presets to CSV, WAV and PNG under out/.
# Can be run repeatedly.
#
#   ./demo.sh             opens the window if there is a display
#   ./demo.sh --offline   renders files even if there is a display
. "$(dirname "$0")/.ci/setup.sh"

offline=${1:-}
case $offline in
    ''|--offline) ;;
    *) echo "usage: ./demo.sh [--offline]" >&2; exit 2 ;;
esac

install_packages
if [ -z "$offline" ] && [ -n "${DISPLAY:-}" ]; then
    build release tactus-host tactus
    say "Opening the host. To render files instead: ./demo.sh --offline"
    exec build/release/bin/tactus-host
fi

build release tactus
bin=build/release/bin
mkdir -p out
made=()

# render NAME GRAPH [OPTIONS…]: writes CSV, WAV and PNG
render ()
{
    local name=$1 graph=$2
    shift 2
    echo "  $name"
    "$bin/tactus" render "$graph" "$@" --out "out/$name.csv" --out "out/$name.wav" --plot "out/$name.png"
    made+=("$name")
}

say "Rendering presets, each moved by a simulated hand"
render dry_wood graphs/dry_wood.json --record hand.position.x,board.resistance,drag.force.x,grain_felt.out.x
render potato_cut graphs/potato_cut.json --record down.out,blade.crack,blade.resistance,parting.hit
render soft_pad graphs/soft_pad.json --record hand.position.z,pad.resistance
render aluminium_bar graphs/aluminium_bar.json --record hand.position.z,bar.resistance,ring.value
render layered_cloth graphs/layered_cloth.json --record hand.position.x,hand.position.y,drag.force,felt.out
render squealing_rubber graphs/squealing_rubber.json --record hand.position.x,foot.force.x,tone.value
render liver graphs/liver.json --record hand.position,liver.depth,liver.force
render oak_board graphs/oak_board.json --record hand.position.x,motor.force.x
for graph in graphs/*.json; do
    name=$(basename "$graph" .json)
    case " ${made[*]} " in
        *" $name "*) ;;
        *) render "$name" "$graph" ;;
    esac
done

say "The same wood, with the hand moving in circles"
render dry_wood_circle graphs/dry_wood.json --device stylus=gesture:circle --record hand.position.x,hand.position.y,drag.force

strokes=../shared/data/strokes_evemu
if [ -d "$strokes" ]; then
    say "The same wood, with strokes recorded on a tablet"
    for recording in "$strokes"/*.events; do
        name=$(basename "${recording%.events}" | tr -c "A-Za-z0-9\n" _)
        "$bin/tactus" convert "$recording" "out/trace_$name.csv"
        render "wood_$name" graphs/dry_wood.json --device "stylus=trace:out/trace_$name.csv" --record hand.position,drag.force,board.resistance
    done
fi

switches=../shared/data/buttons_switchcurves
if [ -d "$switches" ]; then
    say "Measured keys, pressed by a simulated finger"
    for curve in "$switches"/*.csv; do
        name=$(basename "${curve%.csv}" | tr -c "A-Za-z0-9\n" _)
        "$bin/tactus" fit switch "$curve" -o "out/key_$name.json"
        render "key_$name" "out/key_$name.json"
    done
fi

say "Files written, each as .csv, .wav and .png:"
printf '  out/%s\n' "${made[@]}"
