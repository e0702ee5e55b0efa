#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A client of Haply's service on python3-websockets, as the public description of the messages says: it waits for the inventory, then sends a force for
each state that it gets, 200 times a second. It runs against `tactus fake-device haply_inverse3`.

Usage: client_test.py TACTUS. Exit status 77 means skipped: python3-websockets is not installed."""

import asyncio
import json
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "support"))
from fake import Fake, demand   # noqa: E402
from waiting import let_pass   # noqa: E402

try:
    import websockets
except ImportError:
    print("skipped: python3-websockets is not installed")
    sys.exit(77)

PUSHES = 200
HAND = {"driver": "sim", "mass": "1 kg", "damping": 5, "position": ["1 cm", "2 cm", "3 cm"], "rotation": [0, 0, 1]}


def force(device, spelling, x):
    return json.dumps({"inverse3": [{"device_id": device, "commands": {"set_cursor_force": {spelling: {"x": x, "y": 0, "z": 0}}}}]})


async def talk(port):
    async with websockets.connect(f"ws://localhost:{port}", ping_interval=None) as service:
        inventory = json.loads(await service.recv())
        arm, grip = inventory["inverse3"][0], inventory["wireless_verse_grip"][0]
        demand(arm["config"]["type"] == "inverse3" and arm["status"]["ready"], "the inventory describes the arm")
        demand(set(grip["state"]["buttons"]) >= {"a", "b", "c"}, "the grip has its buttons")
        demand(abs(grip["state"]["orientation"]["z"] - 0.479425538604203) < 1e-12, "the grip turns with the hand")
        demand(abs(arm["state"]["cursor_position"]["z"] - 0.03) < 1e-3, "the cursor is where the hand is")
        sent = 0
        for spelling, x in (("values", 0.5), ("vector", -0.25)):
            for _ in range(PUSHES):
                await service.send(force(arm["device_id"], spelling, x))
                sent += 1
                state = json.loads(await service.recv())
                demand("config" not in state["inverse3"][0], "only the inventory has the configuration")
                demand(state["inverse3"][0]["state"]["control_mode"] == "cursor_force", "a push is not idle")
                let_pass(1 / 200)
        moved = state["inverse3"][0]["state"]["cursor_position"]
        demand(moved["x"] != 0.01 and abs(moved["y"] - 0.02) < 1e-3, "the hand has felt the force along x only")
        await service.send(json.dumps({"inverse3": [{"device_id": arm["device_id"], "commands": {"probe_position": {}}}]}))
        state = json.loads(await service.recv())
        demand(state["inverse3"][0]["state"]["control_mode"] == "idle", "who only asks does not push")

        # Silence is answered with silence.
        try:
            await asyncio.wait_for(service.recv(), timeout=0.2)
            demand(False, "the service speaks only when it is spoken to")
        except asyncio.TimeoutError:
            pass
        return sent + 1


with tempfile.TemporaryDirectory() as folder:
    hand = pathlib.Path(folder) / "hand.json"
    hand.write_text(json.dumps(HAND))
    with Fake(sys.argv[1], hand) as fake:
        sent = asyncio.run(talk(fake.port))
    print(fake.seen)
    demand(fake.seen == {"clients": 1, "heard": sent, "forces": 2 * PUSHES, "largest": 0.5, "answered": sent, "together": 0, "refused": 0},
           f"what the service has counted: {fake.seen}")
