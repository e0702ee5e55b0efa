#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# test_devices.sh BUILD: tests the programs of a build folder with virtual HID devices, in a QEMU guest. Exits with status 77 and a
# message if no guest can run here.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$(cd "$1" && pwd)
guest=build/guest
results=$(mktemp -d)
trap '[ -z "${KEEP:-}" ] && rm -rf "$results" || echo $results' EXIT

tests/guest/make_guest.sh $guest
data=../shared/data/hid_ffb/openffboard_1axis.bin
cat >"$results/run.sh" <<RUN
export TACTUS_PROGRAM=$build/bin/tactus GUEST_DEVICE=$build/bin/guest_device FFB_DESCRIPTOR=$(realpath -m $data)
exec "$PWD/tests/guest/in_guest.sh"
RUN
status=0
tests/guest/run_guest.sh $guest "$results/run.sh" "$results" || status=$?
[ $status -eq 77 ] && exit 77
if [ $status -ne 0 ]; then
    tail -n 20 "$results"/*.err >&2 || true
    exit 1
fi
/usr/bin/python3 tests/guest/check.py "$results" "$build/bin/tactus" "$PWD"
