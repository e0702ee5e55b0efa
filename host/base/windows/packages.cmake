# SPDX-License-Identifier: MIT
# The libraries that Debian has for Linux, but not for Windows: built from Debian's sources into build/windows/packages, once. pkg-config then
# finds them there, so the rest of the build does not differ. Headers without a library (CLI11, Catch2) are those of Debian.
set (prefix ${PROJECT_BINARY_DIR}/packages)
set (recipe ${CMAKE_CURRENT_LIST_DIR}/packages)
file (GLOB files ${recipe}/* ${CMAKE_CURRENT_LIST_DIR}/toolchain.cmake)
set (key)
foreach (file IN LISTS files)
    file (SHA256 ${file} hash)
    string (APPEND key ${hash})
endforeach ()
string (SHA256 key "${key}")
set (built)
if (EXISTS ${prefix}/built)
    file (READ ${prefix}/built built)
endif ()
if (NOT built STREQUAL key)
    message (STATUS "Building the libraries that Debian does not have for Windows (two minutes)")
    set (options -G Ninja -DCMAKE_TOOLCHAIN_FILE=${CMAKE_TOOLCHAIN_FILE} -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=${prefix})
    foreach (step "-S;${recipe};-B;${prefix}/build;${options}" "--build;${prefix}/build;-j2" "--install;${prefix}/build")
        execute_process (COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE failed
            OUTPUT_FILE ${PROJECT_BINARY_DIR}/packages.txt ERROR_FILE ${PROJECT_BINARY_DIR}/packages_errors.txt)
        if (failed)
            message (FATAL_ERROR "The libraries for Windows cannot be built: see ${PROJECT_BINARY_DIR}/packages.txt and packages_errors.txt")
        endif ()
    endforeach ()
    file (WRITE ${prefix}/built ${key})
endif ()

# JUCE comes as sources, in a folder that is named after the processor of this computer.
file (GLOB juce /usr/lib/*/cmake/JUCE-7*)
set (JUCE_DIR "${juce}" CACHE PATH "JUCE's modules")

set (ENV{PKG_CONFIG_LIBDIR} ${prefix}/lib/pkgconfig)   # and no library of Linux
list (APPEND CMAKE_FIND_ROOT_PATH ${prefix})
list (APPEND CMAKE_PREFIX_PATH ${prefix})
link_directories (${prefix}/lib)   # Debian's JUCE links zlib by its name

# Only these headers, because the C library of Linux is in the same folder.
file (MAKE_DIRECTORY ${prefix}/include)
foreach (headers CLI catch2)
    if (NOT EXISTS /usr/include/${headers})
        message (FATAL_ERROR "There is no /usr/include/${headers}: install libcli11-dev and catch2")
    endif ()
    file (CREATE_LINK /usr/include/${headers} ${prefix}/include/${headers} SYMBOLIC)
endforeach ()
foreach (target CLI11::CLI11 Catch2::Catch2)
    add_library (${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories (${target} INTERFACE ${prefix}/include)
endforeach ()
