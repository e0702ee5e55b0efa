# SPDX-License-Identifier: MIT
if (TARGET tactus_falcon)
    foreach (kind ftdi old_ftdi)   # each in a folder of its own, because the library is found by its name
        tactus_fake_library (fake_${kind} ${PROJECT_SOURCE_DIR}/host/drivers/falcon/fake_ftdi.cpp)
        set_target_properties (fake_${kind} PROPERTIES OUTPUT_NAME ftdi1 SUFFIX .so.2 LIBRARY_OUTPUT_DIRECTORY ${fake_libraries}/${kind})
    endforeach ()
    target_compile_definitions (fake_old_ftdi PRIVATE FAKE_LACKS_LATENCY)
endif ()
