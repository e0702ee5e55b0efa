# SPDX-License-Identifier: MIT
if (TARGET tactus_openhaptics)
    foreach (kind hd needy_hd)   # each in a folder of its own, because the library is found by its name
        tactus_fake_library (fake_${kind} ${PROJECT_SOURCE_DIR}/host/drivers/openhaptics/fake_hd.cpp)
        set_target_properties (fake_${kind} PROPERTIES OUTPUT_NAME HD LIBRARY_OUTPUT_DIRECTORY ${fake_libraries}/${kind})
    endforeach ()
    target_link_libraries (fake_needy_hd PRIVATE needed_by_fake)
    target_link_options (fake_needy_hd PRIVATE LINKER:--no-as-needed)
endif ()
