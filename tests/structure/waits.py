#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that tests wait only by tests/support/waiting.hpp and waiting.py, and let no wall time decide.

Usage: waits.py [SOURCE_FOLDER]. Prints FILE:LINE for each problem. Exit status 1 if there are any.

A row of REFUSED is the suffixes of files, a pattern of one line, the remedy, and a line that it must refuse: the check first tries itself on these.
A row of LEFT_OUT is what drives or measures real time on purpose. It must contain something that is refused elsewhere, so that it cannot rot."""

import pathlib
import re
import sys

CPP, PYTHON, SHELL = (".cpp", ".hpp", ".c", ".h"), (".py",), (".sh",)
WAIT = "wait for a condition (eventually), see that nothing comes (stays), or let time pass (letPass)"
REFUSED = [
    (CPP, r"\b(sleep_for|sleep_until|u?sleep|(clock_)?nanosleep) ?\(|Thread::sleep ?\(", WAIT, "std::this_thread::sleep_for (5ms);"),
    (CPP, r"(Clock|_clock)::now ?\(\)|\bclock_gettime ?\(|\bgettimeofday ?\(|getMillisecondCounter|getHighResolutionTicks",
     "gate on order, counts or virtual time; print a Stopwatch, and give code a time with fromNow()", "const auto end = WireClock::now() + 10s;"),
    (CPP, r"\.s\(\) ?<=? |(?<![->])>=? ?\w+\.s\(\)", "a busy computer takes longer: compare with a Stopwatch that ran in turn with it, or print it",
     "CHECK (watch.s() < 0.5);"),
    (CPP, r"runDispatchLoopUntil", "let the window work with settle() or waitFor() of tests/host/app/support/wait_for.hpp",
     "juce::MessageManager::getInstance()->runDispatchLoopUntil (20);"),
    (PYTHON, r"\btime\.(sleep|time|monotonic|perf_counter)\b|\basyncio\.sleep|\bthreading\.Timer", "use tests/support/waiting.py", "        time.sleep(0.1)"),
    (SHELL, r"^(?!.*\b(for|while|until)\b.*; do ).*\bsleep [0-9$]", "wait for a condition, in a loop on one line with the sleep", "sleep 1"),
]
FINE = [
    (CPP, "CHECK (sent <= 2.0 + 10.0 * watch.s());"), (CPP, "std::cout << watch.s() << \" s\\n\";"), (CPP, "fs::last_write_time (file, time + hours (1));"),
    (CPP, "// it may sleep_for (1ms)"), (SHELL, "for i in $(seq 60); do [ -e here ] && break; sleep 0.5; done"),
]
LEFT_OUT = [
    ("tests/support/waiting.hpp", "the one place"),
    ("tests/support/waiting.py", "the one place"),
    ("tests/host/app/support/wait_for.hpp", "the one place for the window"),
    ("tests/audio", "sound that a sound server plays"),
    ("tests/bench", "measures time, and judges none"),
    ("tests/guest", "programs and devices in a machine whose clock counts instructions"),
    ("tests/host/app/screens", "films and listens to the program"),
    ("tests/host/code/generate/exported_code.cpp", "the program that it writes prints its time"),
    ("tests/host/drivers/apart", "libraries with a servo loop of their own and calls that stall"),
    ("tests/plugins/objects", "devices and nodes, which are slow on purpose"),
    ("tests/mutants", "a program that people start by hand: it ends compilers that do not end"),
    ("tests/structure/waits.py", "examples"),
]


def refused(suffix, text):
    """The lines that are refused, with the remedy."""
    for number, line in enumerate(text.splitlines(), 1):
        code = re.sub(r"//.*" if suffix in CPP else r"(^|\s)#.*", "", line)
        yield from ((number, remedy) for suffixes, pattern, remedy, _ in REFUSED if suffix in suffixes and re.search(pattern, code))


def problems(root):
    for suffixes, pattern, _, example in REFUSED:
        if not list(refused(suffixes[0], example)):
            yield f"tests/structure/waits.py: {pattern} does not refuse its example"
    for suffixes, line in FINE:
        if list(refused(suffixes[0], line)):
            yield f"tests/structure/waits.py: this is fine, and refused: {line}"
    used = set()
    for path in sorted((root / "tests").rglob("*")):
        name = path.relative_to(root).as_posix()
        if not path.is_file() or path.suffix not in CPP + PYTHON + SHELL:
            continue
        left_out = next((place for place, _ in LEFT_OUT if name == place or name.startswith(place + "/")), None)
        for number, remedy in refused(path.suffix, path.read_text(encoding="utf-8")):
            used.add(left_out)
            if left_out is None:
                yield f"{name}:{number}: {remedy}"
    for place, _ in LEFT_OUT:
        if place not in used:
            yield f"{place}: nothing here waits or looks at a clock; correct LEFT_OUT of waits.py"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]).resolve()
    found = list(problems(root))
    print("\n".join(found) or "tests wait only by tests/support/waiting")
    return 1 if found else 0


sys.exit(main())
