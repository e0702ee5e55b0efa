# SPDX-License-Identifier: MIT
# The tests that are built for Windows: of the framework, and of the devices without those of drivers. Not of nodes, which need MPFR. run.py names the
# cases that are left out.
file (GLOB_RECURSE framework CONFIGURE_DEPENDS framework/*.cpp framework/*.c support/*_test.cpp)
list (FILTER framework EXCLUDE REGEX "/tests/framework/(check|fit|kit)/")
file (GLOB_RECURSE devices CONFIGURE_DEPENDS host/base/files/*.cpp host/base/assets/*.cpp host/base/platform/*.cpp host/devices/*.cpp)
# They call what only Linux has: other users, sockets of files, signals, forks, pseudo-terminals.
list (FILTER framework EXCLUDE REGEX "/(file_lock|realtime|soak|system_calls|ownership)_test.cpp$")
list (FILTER devices EXCLUDE REGEX "/(atomic_folder|awaited_device|c_session|failsafe|file_watch|hid_soak|home_folder)_test.cpp$|/ending_program.cpp$")
list (FILTER devices EXCLUDE REGEX "/(peer_lock|private_folder|report_file|report_hops|stop_threads|terminal|wires)_test.cpp$")
find_package (PkgConfig REQUIRED)
pkg_check_modules (spng REQUIRED IMPORTED_TARGET spng)   # tests make pictures
tactus_test_part (framework SOURCES ${framework} LIBRARIES tactus::c)
tactus_test_part (device SOURCES ${devices} LIBRARIES PkgConfig::spng tactus_asset_readers tactus_no_bitcode tactus_hid tactus_hid_link tactus_device_plugins
    tactus_live tactus_trial tactus_audio tactus_osc tactus_files)
foreach (part framework device)
    target_sources (tactus_${part}_tests PRIVATE ${PROJECT_SOURCE_DIR}/host/base/windows/program.rc)
endforeach ()
set_source_files_properties (framework/capi/c_api_c99.c PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
