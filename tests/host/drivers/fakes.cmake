# SPDX-License-Identifier: MIT
# Fakes of the libraries of makers, which drivers open when they run.
set (fake_libraries ${PROJECT_BINARY_DIR}/tests/fakes)
function (tactus_fake_library name)
    add_library (${name} SHARED ${ARGN})
    target_include_directories (${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries (${name} PRIVATE tactus_test_options)
    set_target_properties (${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${fake_libraries} UNITY_BUILD OFF CXX_VISIBILITY_PRESET hidden
        BUILD_WITH_INSTALL_RPATH ON)   # so that what a fake needs is not found
endfunction ()

set (fake_drd ${PROJECT_SOURCE_DIR}/host/drivers/forcedimension/fake_drd.cpp)
tactus_fake_library (fake_drd ${fake_drd})
tactus_fake_library (fake_old_dhd ${fake_drd})
target_compile_definitions (fake_old_dhd PRIVATE FAKE_OLD)
tactus_fake_library (fake_ancient_dhd ${fake_drd})
target_compile_definitions (fake_ancient_dhd PRIVATE FAKE_ANCIENT)
file (WRITE ${PROJECT_BINARY_DIR}/tests/fakes/needed.cpp.new "// SPDX-License-Identifier: MIT\nint needed_by_fake() { return 1; }\n")
file (COPY_FILE ${PROJECT_BINARY_DIR}/tests/fakes/needed.cpp.new ${PROJECT_BINARY_DIR}/tests/fakes/needed.cpp ONLY_IF_DIFFERENT)
tactus_fake_library (needed_by_fake ${PROJECT_BINARY_DIR}/tests/fakes/needed.cpp)
set_target_properties (needed_by_fake PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${fake_libraries}/elsewhere CXX_VISIBILITY_PRESET default)
tactus_fake_library (fake_needy_drd ${fake_drd})
target_link_libraries (fake_needy_drd PRIVATE needed_by_fake)
target_link_options (fake_needy_drd PRIVATE LINKER:--no-as-needed)
set (fakes fake_drd fake_old_dhd fake_ancient_dhd fake_needy_drd)

if (TARGET tactus_openhaptics)
    # Each in a folder of its own, because the library is found by its name.
    set (fake_hd ${PROJECT_SOURCE_DIR}/host/drivers/openhaptics/fake_hd.cpp)
    foreach (kind hd needy_hd)
        tactus_fake_library (fake_${kind} ${fake_hd})
        set_target_properties (fake_${kind} PROPERTIES OUTPUT_NAME HD LIBRARY_OUTPUT_DIRECTORY ${fake_libraries}/${kind})
        list (APPEND fakes fake_${kind})
        if (TACTUS_SANITIZE AND CMAKE_CXX_COMPILER_ID MATCHES Clang)
            target_compile_options (fake_${kind} PRIVATE -fno-sanitize=function)   # it calls back functions of another program
        endif ()
    endforeach ()
    target_link_libraries (fake_needy_hd PRIVATE needed_by_fake)
    target_link_options (fake_needy_hd PRIVATE LINKER:--no-as-needed)
endif ()
