# SPDX-License-Identifier: MIT
"""The cases that do not run in wine, by the file of the test, and why: "" is the whole file. TRIED are the files of tests that have run.
tests/docs/hazards.py reads both."""

TRIED = ["host/cli/*_test.cpp", "framework/*_test.cpp", "host/base/*_test.cpp", "host/devices/*_test.cpp"]

TERMINAL = "it needs a terminal of Linux"
EXPORT = "tactus export needs Linux"
PIPES = "it needs named pipes of Linux"
FULL = "it limits the size of files by a signal of Linux"
LINKS = "wine makes no symbolic links"
LINE = "its fakes are at the far end of a serial line, which Windows does not have"
GUARDIAN = "its devices are not opened without a guardian"
OWNERS = "on Windows, it is not seen who else can change or read a file"
SLASH = "it compares a path, which has a \\ in Windows"

FEWER = {"thousand_stops_test": 10}   # percent of the rounds of a test (TACTUS_ROUNDS), as wine sleeps for too long

LEFT_OUT = {
    "answer_wire_test": {"": LINE},
    "atomic_file_test": {"atomic file: the permissions of the old file are kept, and a link stays a link": LINKS,
                         "atomic file: a link or the permissions of another user do not choose what is written": LINKS,
                         "atomic file: what a killed process leaves is removed by the next one that writes there, but no file in use and no other file": LINKS,
                         "atomic file: what a killed process leaves is kept next to the target on request, and never overwritten": "it forks"},
    "blocked_test": {"": TERMINAL},
    "budgets_test": {"attack: a named pipe in place of a file is refused, not waited for": PIPES},
    "capture_test": {"a capture of a device on a wire has all its reports, and replays to the same readings": LINE},
    "clip_reports_test": {"a recording that an .ahap names is read only below its folder, without links and dots; else the reason is named": LINKS},
    "clutch_key_test": {"": TERMINAL},
    "device_session_test": {"a session that another user can change binds nothing, unless it is named": OWNERS},
    "dualpanto_test": {"": LINE},
    "emergency_test": {"": "it needs signals of Linux"},
    "export_targets_test": {"": EXPORT},
    "export_test": {"": EXPORT},
    "export_wasm_test": {"": EXPORT},
    "fake_device_test": {"with a board on UDP, a message changes its force only with the token, which programs of the same user find": OWNERS,
                         "a second program cannot drive a device over UDP that a first one drives, by no name of its address":
                         "on Windows, two programs may drive a device over a network",
                         "a program that is killed while it pushes leaves the device on a wire at rest": GUARDIAN,
                         "a program that is killed while it pushes an arm without a watchdog leaves it at rest": GUARDIAN,
                         "a program that is frozen while it pushes leaves the device on a wire at rest": GUARDIAN,
                         "what fake-device cannot play is refused with a remedy": LINKS},
    "faults_test": {"a full disk ends a recording, but neither the run nor the other recording": FULL,
                    "a full disk ends a log after a complete line, but does not end the run": FULL},
    "file_assets_test": {"a file that cannot be read is refused with path, cause and remedy": "it reads files of /dev"},
    "fuse_test": {"": "graphs are fused on Linux only"},
    "graph_loader_test": {"a graph is saved completely or not at all": LINKS},
    "hid_device_test": {"a device that takes no neutral report when it is lost or closed is left to the guardian": GUARDIAN},
    "lone_key_test": {"": TERMINAL},
    "open_device_test": {"the messages about a user's profile are reported when it opens a device": "it names a file of /dev as a serial port"},
    "osc_port_test": {"a port that other machines can reach answers only this machine and the named one":
                      "wine lets a program bind an address of another machine"},
    "pipes_test": {"": PIPES},
    "plugin_device_test": {"": GUARDIAN},
    "plugin_efforts_test": {"": GUARDIAN},
    "plugin_opening_test": {"a session tightens the limits of a driver, and never loosens them": GUARDIAN,
                            "a driver that gives neither number nor time must give max_still, and one that promises them must give them": GUARDIAN,
                            "a reading without the number that its driver promises is not used": GUARDIAN,
                            "a device that nothing brings to rest when the program dies is not opened": GUARDIAN},
    "preset_name_test": {"a folder in place of a serial line is told to be one": "on Windows, it is no port: hid/not_connected"},
    "profile_library_test": {"user's profiles: a relative path in the environment names no folder, because it would be next to a graph":
                             "it expects folders of Linux",
                             "profiles that another user can change are not used": OWNERS},
    "remote_control_test": {"the token of a run is in a file that only this user can read, and goes with the run": OWNERS},
    "render_test": {"an interrupted render leaves no file, not even a hidden one, and reports this": "wine starts too slowly for its half a second",
                    "an interrupted play brings the force to zero and keeps its recording, even if its terminal is closed":
                    "wine passes on SIGINT only, as Ctrl-C, of the signals that it sends"},
    "report_test": {"a report has what an answer needs, and no names": "there is no line about the kernel"},
    "serial_ports_test": {"serial ports are listed with the USB device behind them, and interfaces without hardware are not": LINKS,
                          "the port of a Falcon names its driver, and what makes it slow or hides it is told with the remedy": SLASH},
    "session_command_test": {"a role is bound, shown with what the graph needs from it, and unbound": "it binds files of /dev"},
    "settings_test": {"files are found relative to the folder of the graph, and read as the setting needs": SLASH},
    "wire_soak_test": {"": LINE},
}
