# SPDX-License-Identifier: MIT
"""The cases that do not run in wine, by the file of the test, and why: "" is the whole file. TRIED are the files of tests that have run.
tests/docs/hazards.py reads both."""

TRIED = ["host/cli/*_test.cpp", "framework/*_test.cpp"]

TERMINAL = "it needs a terminal of Linux"
EXPORT = "tactus export needs Linux"
PIPES = "it needs named pipes of Linux"
FULL = "it limits the size of files by a signal of Linux"
LINKS = "wine makes no symbolic links"
SLASH = "it compares a path, which has a \\ in Windows"

LEFT_OUT = {
    "atomic_file_test": {"atomic file: the permissions of the old file are kept, and a link stays a link": LINKS,
                         "atomic file: a link or the permissions of another user do not choose what is written": LINKS,
                         "atomic file: what a killed process leaves is removed by the next one that writes there, but no file in use and no other file": LINKS,
                         "atomic file: what a killed process leaves is kept next to the target on request, and never overwritten": "it forks"},
    "blocked_test": {"": TERMINAL},
    "budgets_test": {"attack: a named pipe in place of a file is refused, not waited for": PIPES},
    "clutch_key_test": {"": TERMINAL},
    "emergency_test": {"": "it needs signals of Linux"},
    "export_targets_test": {"": EXPORT},
    "export_test": {"": EXPORT},
    "export_wasm_test": {"": EXPORT},
    "fake_device_test": {"": "its fakes are at the far end of a serial line, which Windows does not have"},
    "faults_test": {"a full disk ends a recording, but neither the run nor the other recording": FULL,
                    "a full disk ends a log after a complete line, but does not end the run": FULL},
    "fuse_test": {"": "graphs are fused on Linux only"},
    "graph_loader_test": {"a graph is saved completely or not at all": LINKS},
    "killed_test": {"a recording and a log survive kill -9 up to their last second, and the next run neither overwrites nor hides them": SLASH},
    "lone_key_test": {"": TERMINAL},
    "pipes_test": {"": PIPES},
    "preset_name_test": {"every command that takes a graph file takes the name of a preset": SLASH, "a mistyped preset or file gets a suggestion": SLASH},
    "render_test": {"an interrupted render leaves no file, not even a hidden one, and reports this": "wine starts too slowly for its half a second",
                    "an interrupted play brings the force to zero and keeps its recording, even if its terminal is closed":
                    "wine passes on SIGINT only, as Ctrl-C, of the signals that it sends"},
    "replay_test": {"a run with late answers of async queries is repeated byte for byte": SLASH},
    "report_test": {"a report has what an answer needs, and no names": "there is no line about the kernel"},
    "settings_test": {"files are found relative to the folder of the graph, and read as the setting needs": SLASH},
    "thousand_stops_test": {"": "its thousand stops take more than ten minutes in wine, which sleeps for too long"},
    "session_command_test": {"a role is bound, shown with what the graph needs from it, and unbound": "it binds files of /dev"},
}
