# SPDX-License-Identifier: GPL-3.0-or-later
# Where the host is switched off, the sanitizers and fuzzers still look at those parts of it that need no JUCE: what reads
# files and reports, and the threads of runs and devices.
find_package (PkgConfig REQUIRED)
pkg_check_modules (hidapi REQUIRED IMPORTED_TARGET hidapi-hidraw)
foreach (part io assets devices hid platform runtime hid_link runlog audio sessions)
    add_subdirectory (host/${part})
endforeach ()
