# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the udev rules that allow the user who is logged in at the computer to open the devices that have a profile, and those that only a driver
knows.

udev_rules.py PROFILES OUTPUT

Over Bluetooth, no parent of a device has idVendor, but the kernel's name for it contains bus, vendor and product.
"""
import json
import pathlib
import sys

DRIVERS = """
# Arms of Force Dimension
SUBSYSTEM=="usb", ATTRS{idVendor}=="1451", TAG+="uaccess"

# Touch of 3D Systems, as a serial port. Sources name both pairs of numbers.
SUBSYSTEM=="tty", ATTRS{idVendor}=="0301", ATTRS{idProduct}=="2988", TAG+="uaccess"
SUBSYSTEM=="tty", ATTRS{idVendor}=="2988", ATTRS{idProduct}=="0302", TAG+="uaccess"
KERNEL=="hidraw*", ATTRS{idVendor}=="2988", TAG+="uaccess"

# Novint Falcon. The kernel does not know it as a serial port, and its adapter keeps answers for 16 ms unless a program sets another time.
ACTION=="add", SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", \
RUN+="/bin/sh -c 'modprobe ftdi_sio && echo 0403 cb48 > /sys/bus/usb-serial/drivers/ftdi_sio/new_id'"
ACTION=="add", SUBSYSTEM=="usb-serial", ATTRS{idVendor}=="0403", ATTRS{idProduct}=="cb48", ATTR{latency_timer}="1"
SUBSYSTEM=="usb", ATTRS{idVendor}=="0403", ATTRS{idProduct}=="cb48", TAG+="uaccess"
SUBSYSTEM=="tty", ATTRS{idVendor}=="0403", ATTRS{idProduct}=="cb48", TAG+="uaccess"

"""


def rules(match):
    vendor = int(match["vid"], 16)
    products = match["pid"] if isinstance(match["pid"], list) else [match["pid"]]
    for product in (int(text, 16) for text in products):
        if match.get("bus") != "bluetooth":
            yield f'ATTRS{{idVendor}}=="{vendor:04x}", ATTRS{{idProduct}}=="{product:04x}"'
        if match.get("bus") != "usb":
            yield f'KERNELS=="0005:{vendor:04X}:{product:04X}.*"'


def main(profiles, output):
    lines = {}   # by rule: the names of the profiles that need it
    for file in sorted(pathlib.Path(profiles).glob("*.json")):
        profile = json.loads(file.read_text(encoding="utf-8"))
        if profile.get("format") != "tactus-profile":
            continue
        for match in profile.get("match", []):   # profiles that hold only numbers have none
            for rule in rules(match):
                lines.setdefault(rule, []).append(profile["name"])
    text = "# Tactus: the user who is logged in at the computer may open the haptic devices for which Tactus has a profile or a driver.\n"
    text += 'ACTION=="remove", GOTO="tactus_end"\n' + DRIVERS + 'KERNEL!="hidraw*", GOTO="tactus_end"\n'
    named = None
    for rule, names in lines.items():
        if names != named:
            text += f"\n# {', '.join(names)}\n"
        named = names
        text += f'{rule}, TAG+="uaccess"\n'
    pathlib.Path(output).write_text(text + '\nLABEL="tactus_end"\n', encoding="utf-8")


main(*sys.argv[1:])
