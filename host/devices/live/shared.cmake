# SPDX-License-Identifier: MIT
# libtactus_live: all of libtactus, and live sessions on real devices (tactus_live.h). It needs hidapi.
set (parts tactus_nodes tactus_c tactus_no_bitcode tactus_live tactus_reports)   # what nothing refers to; the rest comes from the static libraries
list (TRANSFORM parts REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
add_library (tactus_live_shared SHARED ${parts})
set_target_properties (tactus_live_shared PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}   # next to the programs, as they find the same files
    OUTPUT_NAME tactus_live EXPORT_NAME live VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR} LINKER_LANGUAGE CXX)
target_include_directories (tactus_live_shared INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:include>)
target_link_libraries (tactus_live_shared PRIVATE tactus_reports PkgConfig::hidapi Threads::Threads ${CMAKE_DL_LIBS})
add_dependencies (tactus_live_shared force-guardian)
if (MINGW)   # as for libtactus.dll
    target_link_options (tactus_live_shared PRIVATE LINKER:--output-def,${PROJECT_BINARY_DIR}/tactus_live.def)
    set_target_properties (tactus_live_shared PROPERTIES VERSION "" SOVERSION "" PREFIX "" ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
endif ()
if (CMAKE_SYSTEM_NAME STREQUAL Linux)
    # Exports only the C API, and what fused code calls.
    set (exports ${CMAKE_CURRENT_LIST_DIR}/exports.map)
    target_link_options (tactus_live_shared PRIVATE LINKER:--version-script=${exports} LINKER:-z,defs LINKER:-z,nodelete)   # its signal handlers and threads must stay
    set_target_properties (tactus_live_shared PROPERTIES LINK_DEPENDS ${exports})
endif ()
