# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` installs of the programs: the component `program` is the command line with presets, profiles, man pages and
# completions, the component `host` the window with what a desktop needs to know about it.
find_package (Python3 COMPONENTS Interpreter)
if (NOT Python3_FOUND)
    message (STATUS "There is no Python, so man pages cannot be written, and only the libraries are installed")
    return ()
endif ()

# Man pages and AppStream data state the date of the newest entry of the changelog, not that of the build, so that two builds give the
# same bytes.
file (STRINGS CHANGELOG.md entries REGEX "^## ")
if (NOT entries MATCHES "^## ([0-9.]+) \\(([0-9]+-[0-9]+-[0-9]+)\\)" OR NOT CMAKE_MATCH_1 STREQUAL PROJECT_VERSION)
    message (FATAL_ERROR "The newest entry of CHANGELOG.md is not \"## ${PROJECT_VERSION} (YEAR-MONTH-DAY)\"")
endif ()
set (TACTUS_RELEASE_DATE ${CMAKE_MATCH_2})

set (packaging ${PROJECT_SOURCE_DIR}/host/base/packaging)
set (made ${PROJECT_BINARY_DIR}/packaging)
file (GLOB profiles CONFIGURE_DEPENDS host/devices/profiles/*.json)
file (GLOB pages CONFIGURE_DEPENDS docs/*.md docs/decisions/*.md docs/tutorials/*.md)
file (RELATIVE_PATH data_from_pages /${CMAKE_INSTALL_DATADIR}/doc/tactus /${CMAKE_INSTALL_DATADIR})
file (RELATIVE_PATH headers_from_pages /${CMAKE_INSTALL_DATADIR}/doc/tactus /${CMAKE_INSTALL_INCLUDEDIR})
set (TACTUS_MAINTAINER "The Tactus developers <tactus@example.org>" CACHE STRING "Who to ask about packages, as NAME <ADDRESS>")
set (python ${Python3_EXECUTABLE} -B)

set (check_plugin)   # empty where tactus-check-plugin cannot be built
if (TARGET tactus-check-plugin)
    set (check_plugin tactus-check-plugin)
endif ()

# Man pages and completions are written from --help, and the schema of graphs from the catalogue, so this runs the programs after they are
# built.
add_custom_command (OUTPUT ${made}/written
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${made}/man ${made}/completions
    COMMAND ${python} ${packaging}/man_pages.py $<TARGET_FILE:tactus> tactus ${PROJECT_VERSION} ${TACTUS_RELEASE_DATE} ${made}/man
    COMMAND ${python} ${packaging}/man_pages.py $<TARGET_FILE:tactus-host> tactus-host ${PROJECT_VERSION} ${TACTUS_RELEASE_DATE} ${made}/man
    COMMAND ${python} ${packaging}/completions.py $<TARGET_FILE:tactus> $<TARGET_FILE:tactus-host> ${made}/completions
    COMMAND ${CMAKE_COMMAND} -E env --unset=TACTUS_PLUGINS HOME=${made}/nobody XDG_CONFIG_HOME=${made}/nobody $<TARGET_FILE:tactus> schema -o ${made}/graph.schema.json
    COMMAND ${python} ${packaging}/udev_rules.py ${PROJECT_SOURCE_DIR}/host/devices/profiles ${made}/70-tactus.rules
    COMMAND ${python} ${packaging}/changelogs.py ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${TACTUS_MAINTAINER} ${made}
    COMMAND ${python} ${packaging}/installed_pages.py ${PROJECT_SOURCE_DIR} ${made}/pages ${data_from_pages} ${headers_from_pages}
    COMMAND ${CMAKE_COMMAND} -E touch ${made}/written
    DEPENDS tactus tactus-host ${check_plugin} ${profiles} ${pages} CHANGELOG.md ${packaging}/installed_pages.py
        ${packaging}/program_help.py ${packaging}/man_pages.py ${packaging}/completions.py ${packaging}/udev_rules.py ${packaging}/changelogs.py
    COMMENT "Writing man pages, completions, the schema of graphs and udev rules" VERBATIM)
add_custom_target (installed_texts ALL DEPENDS ${made}/written)

set (optional)   # as for tactus-check-plugin
foreach (program tactus-bench tactus-fuse-llvm)
    if (TARGET ${program})
        list (APPEND optional ${program})
    endif ()
endforeach ()
install (TARGETS tactus ${check_plugin} ${optional} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install (DIRECTORY graphs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/tactus/graphs COMPONENT program
    FILES_MATCHING PATTERN "*.json" PATTERN "assets/*.png" PATTERN "assets/*.obj" PATTERN "assets/*.csv" PATTERN "assets/*.haptic")
get_property (drivers GLOBAL PROPERTY TACTUS_DRIVERS)
foreach (driver ${drivers})
    if (TARGET ${driver})
        install (TARGETS ${driver} LIBRARY DESTINATION lib/tactus/plugins COMPONENT program)
    endif ()
endforeach ()
get_property (helpers GLOBAL PROPERTY TACTUS_DRIVER_HELPERS)
if (helpers)
    install (TARGETS ${helpers} RUNTIME DESTINATION lib/tactus/plugins COMPONENT program)
endif ()
get_property (fakes GLOBAL PROPERTY TACTUS_SHIPPED_FAKES)
foreach (fake ${fakes})   # as targets, not as files, so that they are stripped
    get_target_property (folder ${fake} LIBRARY_OUTPUT_DIRECTORY)
    cmake_path (RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_BINARY_DIR})
    install (TARGETS ${fake} LIBRARY DESTINATION ${folder} COMPONENT program)
endforeach ()
install (FILES ${made}/graph.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/tactus COMPONENT program)
install (FILES ${profiles} DESTINATION ${CMAKE_INSTALL_DATADIR}/tactus/profiles COMPONENT program)
install (FILES ${packaging}/names_in_graph.py DESTINATION ${CMAKE_INSTALL_DATADIR}/tactus COMPONENT program)
install (FILES ${made}/70-tactus.rules DESTINATION lib/udev/rules.d COMPONENT program)
install (FILES ${packaging}/tactus.mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages RENAME tactus.xml COMPONENT program)
install (DIRECTORY ${made}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program PATTERN "tactus-host*" EXCLUDE)
install (DIRECTORY ${made}/completions/bash/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install (DIRECTORY ${made}/completions/zsh/ DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install (DIRECTORY ${made}/completions/fish/ DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
install (DIRECTORY ${made}/pages/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tactus COMPONENT program)
install (DIRECTORY docs/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libtactus-dev COMPONENT development)

install (TARGETS tactus-host RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT host)
install (FILES ${made}/man/tactus-host.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT host)
install (FILES ${packaging}/tactus-host.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT host)
install (FILES ${packaging}/tactus-host.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT host)
configure_file (${packaging}/org.tactus_haptics.Tactus.metainfo.xml.in ${made}/org.tactus_haptics.Tactus.metainfo.xml @ONLY)
install (FILES ${made}/org.tactus_haptics.Tactus.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo COMPONENT host)

include (host/base/packaging/packages.cmake)
