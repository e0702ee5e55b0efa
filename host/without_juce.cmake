# SPDX-License-Identifier: GPL-3.0-or-later
# If the host is switched off, the sanitizers and fuzzers still cover its parts that need no JUCE: the readers of files and
# reports, and the threads of runs and devices.
foreach (part base code devices drivers tools)
    add_subdirectory (host/${part})
endforeach ()
