# SPDX-License-Identifier: MIT
"""Messages of the C++ side in the words of Python. They are written for the command line and the C API: `--rate` is the argument `rate` here."""

from __future__ import annotations

import re
from typing import List, Tuple

# In this order. DEVICES stands for the name of the argument.
_RULES: List[Tuple["re.Pattern[str]", str]] = [(re.compile(pattern), words) for pattern, words in (
    (r"`tactus play --log`", "tactus.play(log=FILE)"),
    (r"`tactus play`", "tactus.play"),
    (r"`tactus nodes ([\w.]+)`", r"tactus.nodes()['\1']"),
    (r"`tactus nodes`", "tactus.nodes()"),
    (r",? or in the session: tactus session --clock \w+", ""),
    (r"tactus session --clock (\w+)", r"clock='\1'"),
    (r"create one: tactus session --file FILE --bind ROLE=hid:PROFILE", "create one with the program `tactus session`"),
    (r"`tactus session --help`", "the program `tactus session`"),
    (r" or --sweep\b", ""),
    (r"(?:raise the budget: )?--limits ([\w.,=]+)", r'raise the budget: tactus.set_limits("\1")'),
    (r"--limits", "set_limits"),
    (r"(?:^|(?<=[\s(]))--device ([^\s=,;]+)=([^\s,;)]+)", r"DEVICES={'\1': '\2'}"),
    (r"--device\b", "DEVICES"),
    (r"\bROLE=([^\s,;)]+)", r"{'ROLE': '\1'}"),
    (r"--plugins\b", "the environment variable TACTUS_PLUGINS"),
    (r"(?<=write )--clock (\w+) or --clock (\w+)", r"clock='\1' or clock='\2'"),
    (r"--(clock|session) (timer|audio|ROLE|FILE)\b", r"\1='\2'"),
    (r"tactus_run_device or tactus_run_pushed_device", "devices={'ROLE': …}"),
    (r"a name that tactus_run_role returns", "one of Engine.roles"),
    (r"the wires that tactus_graph_text returns", "graph.wires"),
    (r"\btactus_(?:run|session)_(\w+)", r"\1"),
    (r"\btactus_graph_(\w+)", r"Graph.\1"),
    (r"(?<![\w-])--([a-z][\w-]*)", r"\1"),
)]
_HINT = re.compile(r"--|\btactus_|`tactus |tactus session|ROLE=")


def in_python(text: str, devices: str = "devices") -> str:
    """A part of a message. devices: what the argument with the devices is called."""
    if _HINT.search(text) is None:
        return text
    for pattern, words in _RULES:
        text = pattern.sub(words.replace("DEVICES", devices), text)
    return text
