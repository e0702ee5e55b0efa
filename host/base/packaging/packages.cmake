# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages, made by `cpack` in the build folder. One package per component of `cmake --install`.
#
# libtactus0 is named after the SONAME libtactus.so.0. Programs that use only the C API work with every libtactus.so.0. Before version
# 1.0, the C++ interface may change with each minor version, so the packages of programs depend on the minor version that they were
# built with (shlibs, below), and find_package (Tactus) accepts no other.
set (debian_version ${PROJECT_VERSION}-1)
math (EXPR next_minor "${PROJECT_VERSION_MINOR} + 1")

file (WRITE ${made}/shlibs "libtactus ${PROJECT_VERSION_MAJOR} libtactus${PROJECT_VERSION_MAJOR} (>= ${PROJECT_VERSION}), \
libtactus${PROJECT_VERSION_MAJOR} (<< ${PROJECT_VERSION_MAJOR}.${next_minor}~)\n")
file (WRITE ${made}/live/shlibs "libtactus_live ${PROJECT_VERSION_MAJOR} libtactus-live${PROJECT_VERSION_MAJOR} (>= ${PROJECT_VERSION})\n")
file (WRITE ${made}/triggers "activate-noawait ldconfig\n")

set (CPACK_GENERATOR DEB)
set (CPACK_PACKAGE_NAME tactus)
set (CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set (CPACK_PACKAGING_INSTALL_PREFIX /usr)
set (CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set (CPACK_STRIP_FILES ON)
set (CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set (CPACK_DEB_COMPONENT_INSTALL ON)
set (CPACK_COMPONENTS_GROUPING IGNORE)
set (CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set (CPACK_DEBIAN_PACKAGE_RELEASE 1)
set (CPACK_DEBIAN_PACKAGE_SOURCE tactus)
set (CPACK_DEBIAN_PACKAGE_MAINTAINER ${TACTUS_MAINTAINER})
set (CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set (CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})

# tactus_package (COMPONENT NAME SECTION SUMMARY DESCRIPTION [RELATION PACKAGES]…): describes the package of a component.
macro (tactus_package component name section summary description)
    list (APPEND CPACK_COMPONENTS_ALL ${component})
    string (TOUPPER ${component} upper)
    set (CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
    set (CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
    set (CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${description}")
    cmake_parse_arguments (relation "" "DEPENDS;RECOMMENDS;SUGGESTS" "" ${ARGN})
    foreach (kind DEPENDS RECOMMENDS SUGGESTS)
        if (relation_${kind})
            set (CPACK_DEBIAN_${upper}_PACKAGE_${kind} ${relation_${kind}})
        endif ()
    endforeach ()
    install (FILES ${packaging}/copyright ${made}/changelog.gz ${made}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
        COMPONENT ${component} OPTIONAL)
endmacro ()

set (about "Tactus lets you build haptic effects the way you patch a modular synthesiser:
models of touch are nodes, and a graph of them computes a force for every
sample of the hand's position.\n")
tactus_package (program tactus science "haptic effects, patched like a modular synthesiser" "${about}
This package contains the command line, the presets, and the profiles of\nhaptic devices."
    DEPENDS "libtactus-live${PROJECT_VERSION_MAJOR} (= ${debian_version})" RECOMMENDS "python3" SUGGESTS "tactus-host, valgrind, libllvm14 | libllvm15 | libllvm16, binutils, g++, libeigen3-dev")
tactus_package (host tactus-host science "editor for graphs of haptic effects" "${about}
This package contains the window in which graphs are edited and played."
    DEPENDS "tactus (= ${debian_version}), libx11-6, libxext6, libxrandr2, libxrender1"
    RECOMMENDS "libjack-jackd2-0 | libjack-0.125, zenity | kdialog")
tactus_package (library libtactus${PROJECT_VERSION_MAJOR} libs "library that plays graphs of haptic effects" "${about}
This package contains the shared library.")
tactus_package (live libtactus-live${PROJECT_VERSION_MAJOR} libs "library that plays graphs of haptic effects on devices" "${about}
This package contains the shared library for haptic devices, and the program\nthat brings them to rest if a program ends or freezes.")
tactus_package (development libtactus-dev libdevel "headers of the library that plays graphs of haptic effects" "${about}
This package contains headers, static libraries, examples, and the files with\nwhich CMake and pkg-config find the library."
    DEPENDS "libtactus${PROJECT_VERSION_MAJOR} (= ${debian_version}), libtactus-live${PROJECT_VERSION_MAJOR} (= ${debian_version}), libeigen3-dev (>= 3.4)")
install (FILES ${packaging}/libtactus-dev.overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME libtactus-dev COMPONENT development)
set (CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${made}/shlibs ${made}/triggers)
set (CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set (CPACK_DEBIAN_LIVE_PACKAGE_CONTROL_EXTRA ${made}/live/shlibs ${made}/triggers)
set (CPACK_DEBIAN_LIVE_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# The Python module, if it is built, is installed as the component `python`. As with every Python package of Debian, its byte code is written
# when it is installed, and removed with it.
get_cmake_property (components COMPONENTS)
if ("python" IN_LIST components)   # quoted, because install.cmake has a variable of this name
    math (EXPR next_python "${TACTUS_PYTHON_MINOR} + 1")
    tactus_package (python python3-tactus python "haptic effects from Python" "${about}
This package contains the Python module."
        DEPENDS "python3 (>= 3.${TACTUS_PYTHON_MINOR}~), python3 (<< 3.${next_python}), python3-numpy" RECOMMENDS "python3-matplotlib, libtactus-live${PROJECT_VERSION_MAJOR}")
    file (WRITE ${made}/postinst "#!/bin/sh\nset -e\nif [ \"$1\" = configure ] && command -v py3compile >/dev/null; then py3compile -p python3-tactus; fi\n")
    file (WRITE ${made}/prerm "#!/bin/sh\nset -e\nif command -v py3clean >/dev/null; then py3clean -p python3-tactus; fi\n")
    set (CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${made}/postinst ${made}/prerm)
    set (CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)   # makes them executable
endif ()

include (CPack)
