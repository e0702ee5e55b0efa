# SPDX-License-Identifier: MIT
# Fakes of the libraries of makers, which drivers open when they run. Each driver's folder says which it has, and adds them to `fakes`.
set (fake_libraries ${PROJECT_BINARY_DIR}/tests/fakes)
set (fakes)
function (tactus_fake_library name)
    add_library (${name} SHARED ${ARGN})
    target_include_directories (${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries (${name} PRIVATE tactus_test_options)
    set_target_properties (${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${fake_libraries} UNITY_BUILD OFF CXX_VISIBILITY_PRESET hidden
        BUILD_WITH_INSTALL_RPATH ON)   # so that what a fake needs is not found
    if (TACTUS_SANITIZE AND CMAKE_CXX_COMPILER_ID MATCHES Clang)
        target_compile_options (${name} PRIVATE -fno-sanitize=function)   # it calls back functions of another program
    endif ()
    set (fakes ${fakes} ${name} PARENT_SCOPE)
endfunction ()

# A library that is not found, for fakes that need one.
file (WRITE ${PROJECT_BINARY_DIR}/tests/fakes/needed.cpp.new "// SPDX-License-Identifier: MIT\nint needed_by_fake() { return 1; }\n")
file (COPY_FILE ${PROJECT_BINARY_DIR}/tests/fakes/needed.cpp.new ${PROJECT_BINARY_DIR}/tests/fakes/needed.cpp ONLY_IF_DIFFERENT)
tactus_fake_library (needed_by_fake ${PROJECT_BINARY_DIR}/tests/fakes/needed.cpp)
set_target_properties (needed_by_fake PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${fake_libraries}/elsewhere CXX_VISIBILITY_PRESET default)

file (GLOB kinds CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*/fakes.cmake)
foreach (kind ${kinds})
    include (${kind})
endforeach ()
