# SPDX-License-Identifier: MIT
# Writes NAME.tactus.build next to a plugin: how the plugin is built, for `tactus play --watch` and
# the host. This file is not installed.
function (tactus_write_build_file name)
    set (text "compiler ${CMAKE_CXX_COMPILER}\n")
    foreach (file IN LISTS ARGN)
        get_filename_component (whole "${file}" ABSOLUTE)
        string (APPEND text "source ${whole}\n")
        if (file MATCHES "[.]c$")
            string (REPLACE "compiler ${CMAKE_CXX_COMPILER}" "compiler ${CMAKE_C_COMPILER}" text "${text}")
        endif ()
    endforeach ()
    set (includes "$<TARGET_PROPERTY:${name},INCLUDE_DIRECTORIES>")
    set (macros "$<TARGET_PROPERTY:${name},COMPILE_DEFINITIONS>")
    string (APPEND text "$<$<BOOL:${includes}>:include $<JOIN:${includes},\ninclude >\n>")
    string (APPEND text "$<$<BOOL:${macros}>:define $<JOIN:${macros},\ndefine >\n>")
    file (GENERATE OUTPUT "$<TARGET_FILE:${name}>.build" CONTENT "${text}")
endfunction ()

# tactus_add_device (NAME FILES…): a device driver, NAME.tactus-device, in C or C++. One of the files defines tactus_device_entry; see
# <tactus/tactus_device.h>.
function (tactus_add_device name)
    add_library (${name} MODULE ${ARGN})
    set_target_properties (${name} PROPERTIES PREFIX "" SUFFIX .tactus-device UNITY_BUILD OFF
        C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    target_link_libraries (${name} PRIVATE tactus::plugin_kit)
    if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options (${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fno-gnu-unique>)   # unique symbols would keep the driver loaded forever
    endif ()
    if (CMAKE_SYSTEM_NAME STREQUAL Linux)
        set (exports ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/device.map)
        target_link_options (${name} PRIVATE LINKER:--version-script=${exports} LINKER:-z,now)
        set_target_properties (${name} PROPERTIES LINK_DEPENDS ${exports})
    endif ()
endfunction ()

# tactus_add_plugin (NAME FILES…): a node plugin, NAME.tactus. One of the files has the TACTUS_PLUGIN line; see
# <tactus/plugin/node_plugin.hpp>.
#
# The plugin contains the code of Tactus that its nodes use, and hides it: it needs no library of Tactus when it is loaded, and its
# symbols do not clash with those of the program that loads it.
function (tactus_add_plugin name)
    add_library (${name} MODULE ${ARGN})
    set_target_properties (${name} PROPERTIES PREFIX "" SUFFIX .tactus UNITY_BUILD OFF
        C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    target_link_libraries (${name} PRIVATE tactus::plugin_kit)
    target_compile_definitions (${name} PRIVATE TACTUS_PLUGIN_NAME="${name}" TACTUS_PLUGIN_VERSION="${PROJECT_VERSION}")
    if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
        target_compile_options (${name} PRIVATE -O3)   # without a build type, CMake would not optimise the nodes
    endif ()
    if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options (${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fno-gnu-unique>)   # unique symbols would keep the plugin loaded forever
        # The adapter and several nodes in one file use up the growth that GCC allows inlining, and a function that two nodes call may be
        # too large to be inlined in both: calls would remain within a tick.
        target_compile_options (${name} PRIVATE "$<$<COMPILE_LANGUAGE:CXX>:--param=inline-unit-growth=200;--param=max-inline-insns-single=1000>")
    endif ()
    tactus_write_build_file (${name} ${ARGN})
    if (CMAKE_SYSTEM_NAME STREQUAL Linux)
        set (exports ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/plugin.map)
        target_link_options (${name} PRIVATE LINKER:--version-script=${exports} LINKER:-z,now)
        set_target_properties (${name} PROPERTIES LINK_DEPENDS ${exports})
    endif ()
endfunction ()
