#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""IsaacLab's client of Haply's service, unmodified, against `tactus fake-device haply_inverse3`. Its file is
source/isaaclab/isaaclab/devices/haply/se3_haply.py of isaac-sim/IsaacLab; TACTUS_ISAACLAB_HAPLY names a copy. Of IsaacLab it imports only two base
classes, which are replaced by empty ones.

Usage: isaaclab_test.py TACTUS. Exit status 77 means skipped: the variable is not set, or python3-torch or python3-websockets is not installed."""

import contextlib
import importlib
import importlib.util
import json
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "support"))
from fake import Fake, demand   # noqa: E402
from waiting import eventually   # noqa: E402

BASE = '''
from dataclasses import dataclass


@dataclass
class DeviceCfg:
    sim_device: str = "cpu"


class DeviceBase:
    def __init__(self, retargeters=None):
        pass
'''


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def client_of(source, folder):
    """The module of IsaacLab, imported from a folder with the same layout."""
    package = folder / "devices/haply"
    package.mkdir(parents=True)
    for init in (folder / "devices/__init__.py", package / "__init__.py"):
        init.write_text("")
    (folder / "devices/device_base.py").write_text(BASE)
    (package / "se3_haply.py").write_bytes(source.read_bytes())
    sys.path.insert(0, str(folder))
    return importlib.import_module("devices.haply.se3_haply")


@contextlib.contextmanager
def opened(haply, fake):
    """IsaacLab's device. Its thread ends only when it is closed."""
    device = haply.HaplyDevice(haply.HaplyDeviceCfg(websocket_uri=f"ws://localhost:{fake.port}"))
    try:
        yield device
    finally:
        device.close()


def feels_the_force(haply, program, folder):
    hand = folder / "hand.json"
    hand.write_text(json.dumps({"driver": "sim", "mass": "0.2 kg", "damping": 20, "position": ["1 cm", "2 cm", "3 cm"], "rotation": [0, 0, 1]}))
    with Fake(program, hand) as fake, opened(haply, fake) as device:
        now = device.advance()
        demand(now.shape == (10,), "ten numbers")
        demand(abs(float(now[2]) - 0.03) < 1e-3, "the position is that of the hand")
        demand(abs(float(now[5]) - 0.4794255) < 1e-6 and abs(float(now[6]) - 0.8775826) < 1e-6, "the orientation is that of the hand")
        for push, sign in ((0.5, 1), (-9.0, -1)):   # the client cuts the second one to 2 N
            before = float(device.advance()[0])
            device.set_force_feedback(push, 0, 0)
            demand(eventually(lambda b=before, s=sign: s * (float(device.advance()[0]) - b) > 0.005), f"a force of {push} N moves the hand")
    print(fake.seen)
    demand(fake.seen["clients"] == 1 and fake.seen["refused"] == 0 and fake.seen["together"] == 0, f"one message at a time: {fake.seen}")
    demand(fake.seen["heard"] - fake.seen["answered"] <= 1, f"each message has its answer: {fake.seen}")   # it may leave before the last one
    demand(fake.seen["largest"] == 2.0, f"the largest force is the limit of the client: {fake.seen}")


def sees_the_buttons(haply, program, folder):
    rows = ["t,x,y,z,rz,button0,button2"]
    for k in range(400):
        t = 0.01 * k
        rows.append(f"{t:.2f},{0.01 * t},0,0,{0.1 * t},{int(k % 100 >= 50)},{int(k >= 200)}")
    trace = folder / "hand.csv"
    trace.write_text("\n".join(rows) + "\n")
    presses = {"a": 0, "b": 0, "c": 0}
    with Fake(program, f"trace:{trace}") as fake, opened(haply, fake) as device:
        for name in presses:
            device.add_callback(name, lambda n=name: presses.__setitem__(n, presses[n] + 1))
        demand(eventually(lambda: float(device.advance()[0]) > 0.0398 and presses["c"] == 1), "the recording is played to its end")
        at_end = device.advance()
    demand(presses["b"] == 0 and presses["a"] >= 1, f"the buttons are those of the recording: {presses}")
    demand(abs(float(at_end[0]) - 0.0399) < 1e-6 and abs(float(at_end[5]) - 0.198179) < 1e-4, "position and orientation belong together")


def main():
    source = os.environ.get("TACTUS_ISAACLAB_HAPLY", "")
    if not source:
        skip("TACTUS_ISAACLAB_HAPLY does not name a copy of se3_haply.py")
    for module in ("torch", "websockets", "numpy"):
        if importlib.util.find_spec(module) is None:
            skip(f"python3-{module} is not installed")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        haply = client_of(pathlib.Path(source), folder)
        feels_the_force(haply, sys.argv[1], folder)
        sees_the_buttons(haply, sys.argv[1], folder)


if __name__ == "__main__":
    main()
