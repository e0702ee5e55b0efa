# SPDX-License-Identifier: MIT
"""A 2-down-1-up roughness experiment: two intervals, answers from the keyboard, on a simulated hand (or on yours: give --device stylus=hid:auto).

    python3 keyboard.py FOLDER [--resume]     after a crash or a break, --resume goes on with the trial that was not answered
"""

import argparse

from tactus import lab

parser = argparse.ArgumentParser()
parser.add_argument("folder")
parser.add_argument("--resume", action="store_true")
parser.add_argument("--device", action="append", default=[])
given = parser.parse_args()

protocol = lab.Protocol(name="roughness", graph="dry_wood", devices={"stylus": "gesture:circle"}, instructions="Which one is rougher?", blocks=[
    lab.Block(name="wood", task="2ifc", varies=lab.Varies(target="roughness", standard=0.1, rest=0.0), interval=0.05, gap=0.02,
              procedure=lab.Staircase(start=0.9, steps=(0.2, 0.1, 0.05), low=0.0, high=1.0, down=2, trials=24))])

data = lab.Experiment(protocol, given.folder, window=lab.Terminal(), resume=given.resume, devices="off",
                      device=dict(words.split("=", 1) for words in given.device)).run()
print(f"{data.trials.rows} trials, " + ("complete" if data.is_complete else "go on with --resume"))
if data.is_complete:
    fit = data.fit("wood")
    assert isinstance(fit, lab.Psychometric)
    print(f"threshold {fit.threshold:.3f} (95 % {fit.threshold_interval.low:.3f} to {fit.threshold_interval.high:.3f})")
