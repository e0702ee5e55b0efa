# SPDX-License-Identifier: MIT
"""python3 -m tactus.lab experiment|mark|study|tables|schema: what `tactus experiment`, `tactus mark` and `tactus study` start."""

from __future__ import annotations

import argparse
import json
import sys
import time
from typing import List, Optional

from .._messages import Error, fail
from .._views import with_unit
from . import (Block, Browser, Experiment, Observer, PowerLaw, Protocol, Receiver, SessionData, Silent, Simulated, Terminal, _study, _study_command, load,
               mark, schema)
from ._schema import read
from ._stages import PORT


def observer_of(text: str) -> Observer:
    """The observer that an option describes: threshold=0.3,width=0.1,function=weibull."""
    given = {}
    for part in text.split(","):
        name, _, value = part.partition("=")
        try:
            given[name] = value if name == "function" else int(value) if name == "seed" and value.isdigit() else float(value)
        except ValueError:
            raise ValueError(f"--observer: '{part}' is not a name and a number; give, for example, threshold=0.3,width=0.1") from None
    return read(Observer, given, "--observer")


def experiment(given: argparse.Namespace) -> int:
    """Runs a session, and prints its results."""
    protocol = Protocol.load(given.file)
    browser = Browser() if given.web else None
    window = browser or (Simulated(observer_of(given.observer)) if given.observer else Terminal())
    if given.osc != "off" and not (given.osc.isdecimal() and int(given.osc) <= 65535):
        raise ValueError(f"--osc: '{given.osc}' is not a port; give a number such as {PORT}, 0 for any free port, or off")
    receiver = None if given.osc == "off" else Receiver(int(given.osc))
    made = Experiment(protocol, given.out, given.participant, given.session, window=window, stage=Silent() if given.no_devices else None, resume=given.resume,
                      receiver=receiver, device=dict(words.split("=", 1) for words in given.device), devices=given.devices, packed=given.packed_log)
    if receiver:
        print(f"OSC on 127.0.0.1:{receiver.port} (token for answers: {receiver.token})", flush=True)
    if browser:
        print(f"participant:  {browser.participant}\nexperimenter: {browser.experimenter}", flush=True)
    print(told(made.run()))
    if browser:
        time.sleep(0.5)   # so that the pages can show that it is over
    return 0


def told(data: SessionData) -> str:
    """A line about the session and, if it is complete, one about each condition of each block."""
    said = [f"{data.folder}: {data.trials.rows} trials, " + ("complete" if data.is_complete else "not complete; go on with --resume")]
    for block in data.protocol.blocks if data.is_complete else []:
        for condition in block.conditions or [c.name for c in data.protocol.all_conditions()]:
            try:
                said.append(f"{block.name}, {condition}: {describe(data, block, condition)}")
            except Error as why:
                said.append(f"{block.name}, {condition}: no fit: {why.text}")
    return "\n".join(said)


def describe(data: SessionData, block: Block, condition: str) -> str:
    """The fit of a block and a condition in a few words."""
    if block.task in ("adjust", "match"):
        levels = data.chosen(block.name, condition)["outcomes"]
        if len(levels) < 2:
            return "fewer than two settings"
        return f"mean {levels.mean():.4g}, standard deviation {levels.std(ddof=1):.4g} of {len(levels)} settings"
    fit = data.fit(block.name, condition)
    if isinstance(fit, PowerLaw):
        return f"exponent {fit.exponent:.4g} (95 % {fit.exponent_interval.low:.4g} to {fit.exponent_interval.high:.4g})"
    ends = fit.threshold_interval
    return f"threshold {with_unit(fit.threshold, fit.unit)} (95 % {ends.low:.4g} to {ends.high:.4g}), width {fit.width:.4g}, {fit.function}"


def main(arguments: Optional[List[str]] = None) -> int:
    """The commands. Returns the exit status: 0 success, 1 an error in the input or an interruption, 2 wrong usage."""
    parser = argparse.ArgumentParser(prog="tactus", description="Experiments with graphs; see docs/lab.md.")
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("experiment", help="run a session of an experiment", description="Runs a session of an experiment.")
    run.add_argument("file", help="the protocol file")
    run.add_argument("--out", default="data", help="the folder of the study; default: data")
    run.add_argument("--participant", default="01", help="its label, letters and digits; default: 01")
    run.add_argument("--session", default="01", help="the label of the session; default: 01")
    run.add_argument("--resume", action="store_true", help="go on with a session that was not completed")
    who = run.add_mutually_exclusive_group()
    who.add_argument("--web", action="store_true", help="pages for the participant and the experimenter, for a browser on this computer")
    who.add_argument("--observer", help="a simulated observer: threshold=0.3,width=0.1[,lapse=…,function=…,exponent=…,noise=…,seed=…]")
    run.add_argument("--no-devices", action="store_true", help="play no graph: nothing is felt")
    run.add_argument("--device", action="append", default=[], help="the device of a role: ROLE=hid:auto; may be given more than once")
    run.add_argument("--devices", help="the session file that binds roles to devices, or \"off\"")
    run.add_argument("--packed-log", action="store_true", help="pack the log of the inputs, which takes less space")
    run.add_argument("--osc", default=str(PORT), help=f"UDP port for marks and answers, 0 for any, or \"off\"; default: {PORT}")
    note = commands.add_parser("mark", help="mark a moment of the experiment that runs", description="Marks a moment of the experiment that runs.")
    note.add_argument("text", help="the name of the mark")
    note.add_argument("value", nargs="?", default="", help="more about it")
    note.add_argument("--osc", type=int, default=PORT, help=f"the port of the experiment; default: {PORT}")
    tables = commands.add_parser("tables", help="write the tables of a session again", description="Writes the tables of a session again, from its journal.")
    tables.add_argument("folder", help="the folder of the session")
    tables.add_argument("--name", default="", help="the name of the experiment, if the folder has several")
    tables.add_argument("--to", nargs="*", default=[], choices=["csv", "h5", "mat", "xdf"], help="further formats")
    _study_command.add(commands)
    shape = commands.add_parser("schema", help="print the JSON schema of protocol files, or of study files")
    shape.add_argument("of", nargs="?", default="experiment", choices=["experiment", "study"], help="the kind of file; default: experiment")
    given = parser.parse_args(arguments)
    try:
        if given.command == "experiment":
            return experiment(given)
        if given.command == "study":
            return _study_command.run(given)
        if given.command == "tables":
            print(*load(given.folder, given.name).write(*given.to), sep="\n")
        elif given.command == "schema":
            print(json.dumps(_study.schema() if given.of == "study" else schema(), indent=2, ensure_ascii=False))
        elif not mark(given.text, given.value, given.osc):
            fail("lab/no_experiment", f"port {given.osc}", "no experiment has answered", "start one, or name its port with --osc")
        return 0
    except (Error, ValueError) as why:
        print(f"error: {why}", file=sys.stderr)
        return 1 if isinstance(why, Error) else 2
    except KeyboardInterrupt:
        print("stopped; go on with --resume", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
