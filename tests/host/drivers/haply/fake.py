# SPDX-License-Identifier: MIT
"""Starts `tactus fake-device haply_inverse3` for clients in Python, and reads what it says at its end."""

import re
import signal
import subprocess

SUMMARY = re.compile(r"(\d+) clients; (\d+) messages heard, (\d+) with a force of at most (\S+) N, (\d+) answered, "
                     r"(\d+) sent before the answer, (\d+) refused")


class Fake:
    """A fake service on a free port. `seen` holds its counts after the with block."""

    def __init__(self, program, hand):
        self.command = [program, "fake-device", "haply_inverse3", "--hand", str(hand)]
        self.seen = {}

    def __enter__(self):
        self.process = subprocess.Popen(self.command, stdout=subprocess.PIPE, text=True)
        first = self.process.stdout.readline()
        self.port = int(re.search(r"localhost:(\d+)", first).group(1))
        return self

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGINT)
        text, _ = self.process.communicate(timeout=60)
        clients, heard, forces, largest, answered, together, refused = SUMMARY.search(text).groups()
        self.seen = {"clients": int(clients), "heard": int(heard), "forces": int(forces), "largest": float(largest), "answered": int(answered),
                     "together": int(together), "refused": int(refused)}


def demand(condition, what):
    if not condition:
        raise SystemExit(f"wrong: {what}")
