# SPDX-License-Identifier: MIT
"""Marks of Lab Streaming Layer, passed on to the session of `tactus experiment`. Not run here: pylsl is not among the packages of the tests."""

import pylsl   # type: ignore[import]

from tactus import lab

inlet = pylsl.StreamInlet(pylsl.resolve_byprop("type", "Markers", timeout=10.0)[0])
while True:
    sample, time = inlet.pull_sample()
    lab.mark(str(sample[0]), repr(time))   # time: s of the clock of LSL
