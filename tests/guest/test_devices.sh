#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# test_devices.sh BUILD: tests the programs of a build folder with virtual HID devices, in a QEMU guest. The guest runs copies of them, in a
# folder below /var/tmp with spaces in its name, as a checkout may be anywhere. Exits with status 77 and a message if no guest can run here.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$(cd "$1" && pwd)
guest=build/guest
results=$(mktemp -d "${TMPDIR:-/tmp}/the results of the guest.XXXXXX")
place=$(mktemp -d "/var/tmp/a folder for the guest.XXXXXX")
trap 'rm -rf "$place"; [ -z "${KEEP:-}" ] && rm -rf "$results" || echo "$results"' EXIT

tests/guest/make_guest.sh $guest
mkdir -p "$place"/{tests/guest,host/devices,build/release/bin}
cp tests/guest/in_guest.sh "$place/tests/guest"
cp -r host/devices/profiles "$place/host/devices"
cp -r graphs "$place"
cp tests/guest/own_script.py "$place/tests/guest"
cp "$build"/bin/{tactus,force-guardian,guest_device,libtactus_live.so.0} "$place/build/release/bin"
cc -Wall -Wextra -Werror tests/guest/own_program.c -I"$build/include" -o "$place/build/release/bin/own_program" \
    -L"$build/bin" -ltactus_live -lpthread -Wl,-rpath,"\$ORIGIN"
mkdir -p "$place/build/release/lib/tactus/plugins"
cp "$build"/lib/tactus/plugins/evdev.tactus-device "$place/build/release/lib/tactus/plugins" 2>/dev/null || true   # where libevdev was there
mkdir "$place/plugins"
cc -shared -fPIC -Wall -Wextra -Werror tests/guest/hidraw_board.c -I"$build/include" -lm -o "$place/plugins/hidraw_board.tactus-device"
if [ -d "$build/python" ]; then cp -rL "$build/python" "$place/build/release"; fi
cp ../shared/data/hid_ffb/openffboard_1axis.bin "$place/descriptor" 2>/dev/null || true
status=0
tests/guest/run_guest.sh $guest "$place/tests/guest/in_guest.sh" "$results" || status=$?
[ $status -eq 77 ] && exit 77
if [ $status -ne 0 ]; then
    tail -n 20 "$results"/*.err >&2 || true
    exit 1
fi
/usr/bin/python3 tests/guest/check.py "$results" "$build/bin/tactus" "$PWD"
