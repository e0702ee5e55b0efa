# SPDX-License-Identifier: GPL-3.0-or-later
# If the host is switched off, the sanitizers and fuzzers still cover its parts that need no JUCE: the readers of files and
# reports, and the threads of runs and devices.
find_package (PkgConfig REQUIRED)
pkg_check_modules (hidapi REQUIRED IMPORTED_TARGET GLOBAL hidapi-hidraw)
foreach (part io assets hid platform guardian plugins device_plugins haply bhaptics hid_link sessions generate fuse live)
    add_subdirectory (host/${part})
endforeach ()
