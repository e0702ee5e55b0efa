# SPDX-License-Identifier: MIT
"""A board that programs push, played by `tactus fake-device`."""

import json
import pathlib
import re
import subprocess
import tempfile

PUSH = {"format": "tactus-graph", "version": 2, "name": "push", "rate_hz": 1000,
        "nodes": {"push": {"type": "signal.constant", "params": {"value": 0.4}}, "motor": {"type": "device.force", "role": "stylus"}},
        "wires": ["push.out -> motor.force.z"]}


class Board:
    """A board on this computer, with a heavy handle, and what it hears."""

    def __init__(self, program):
        self._folder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(self._folder.name)
        (folder / "hand.json").write_text('{"driver": "sim", "mass": "1000 kg"}')
        (folder / "push.json").write_text(json.dumps(PUSH))
        self.graph, self._log = str(folder / "push.json"), folder / "log"
        self._fake = subprocess.Popen([program, "fake-device", "tactus_board", "--wire", "udp", "--log", self._log, "--hand", folder / "hand.json"],
                                      stdout=subprocess.PIPE, text=True)
        lines = iter(self._fake.stdout.readline, "")
        self.device = next(found.group(1) for found in map(re.compile(r"ROLE=(\S+)").search, lines) if found)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._fake.kill()
        self._fake.communicate()
        self._folder.cleanup()

    def forces(self):
        """All that it heard, in uN."""
        whole = self._log.read_text().rpartition("\n")[0].splitlines()
        reports = [bytes.fromhex(line.partition("<")[2]) for line in whole if "<" in line]
        return [max(abs(int.from_bytes(r[at:at + 4], "little", signed=True)) for at in (8, 12, 16)) if r[2] & 1 else 0 for r in reports]

    def is_pushed(self):
        heard = self.forces()
        return bool(heard) and heard[-1] > 390000

    def was_released(self):
        heard = self.forces()
        return max(heard, default=0) > 390000 and heard[-1] == 0
