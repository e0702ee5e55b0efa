# SPDX-License-Identifier: MIT
"""own_script.py GRAPH WHAT: a script that plays a graph on the board and raises an exception, exits or goes on while a force acts."""

import os
import sys
import time

import tactus

graph, what = sys.argv[1:3]
with tactus.play(graph, device=["stylus=hid:tactus_board"], session="off") as session:
    session.probe("motor.force")
    while session.status().force == 0.0:
        time.sleep(0.02)
    time.sleep(0.3)
    print("force", session.values()["motor.force"].tolist(), "by", [h.profile for h in session.health()], file=sys.stderr)
    if what == "raise":
        raise RuntimeError("an exception of the script")
    if what == "exit":
        sys.exit(0)
    while not session.wait(1.0):
        pass
