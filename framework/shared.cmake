# SPDX-License-Identifier: MIT
# libtactus: framework, nodes, run and the C API as one shared library, made of the objects of the static ones.
add_library (tactus_shared SHARED
    $<TARGET_OBJECTS:tactus_framework> $<TARGET_OBJECTS:tactus_framework_cold> $<TARGET_OBJECTS:tactus_nodes>
    $<TARGET_OBJECTS:tactus_run> $<TARGET_OBJECTS:tactus_run_cold> $<TARGET_OBJECTS:tactus_c>)
set_target_properties (tactus_shared PROPERTIES
    OUTPUT_NAME tactus EXPORT_NAME shared VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR} LINKER_LANGUAGE CXX)
target_compile_features (tactus_shared INTERFACE cxx_std_20)
target_include_directories (tactus_shared INTERFACE $<INSTALL_INTERFACE:include>)
target_link_libraries (tactus_shared PUBLIC Eigen3::Eigen Threads::Threads ${CMAKE_DL_LIBS})
if (MINGW)   # libtactus.dll and libtactus.dll.a, and libtactus.def, from which MSVC's `lib /def:libtactus.def /machine:x64` makes its import library
    target_link_options (tactus_shared PRIVATE LINKER:--output-def,${PROJECT_BINARY_DIR}/libtactus.def)
    set_target_properties (tactus_shared PROPERTIES VERSION "" SOVERSION "")
endif ()
if (CMAKE_SYSTEM_NAME STREQUAL Linux)
    # Exports our own symbols, but no instances of std templates, which would replace the program's.
    set (exports ${CMAKE_CURRENT_SOURCE_DIR}/framework/exports.map)
    # Its calls go to its own functions: the copy that a program has of an inline function may be compiled with other flags.
    target_link_options (tactus_shared PRIVATE LINKER:--version-script=${exports} LINKER:-z,defs LINKER:-Bsymbolic-functions)
    set_target_properties (tactus_shared PROPERTIES LINK_DEPENDS ${exports})
endif ()
