# SPDX-License-Identifier: MIT
# Fakes that are written apart from ours: see drd_apart.c.
if (CMAKE_SYSTEM_NAME STREQUAL Linux)
    foreach (kind drd HD)
        string (TOLOWER ${kind} source)
        tactus_fake_library (apart_${source} ${CMAKE_CURRENT_LIST_DIR}/${source}_apart.c)
        set_target_properties (apart_${source} PROPERTIES OUTPUT_NAME ${kind} LIBRARY_OUTPUT_DIRECTORY ${fake_libraries}/apart)
        target_link_libraries (apart_${source} PRIVATE m)
    endforeach ()
    add_library (tactus_falcon_apart STATIC ${CMAKE_CURRENT_LIST_DIR}/falcon_apart.c)
    target_link_libraries (tactus_falcon_apart PUBLIC m)
    set (fake_parts tactus_falcon_apart)
endif ()
