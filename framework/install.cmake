# SPDX-License-Identifier: MIT
# What `cmake --install` installs of the libraries: headers, static and shared libraries, and how CMake and pkg-config find them.
include (GNUInstallDirs)
include (CMakePackageConfigHelpers)

set (package ${CMAKE_INSTALL_LIBDIR}/cmake/Tactus)
install (DIRECTORY framework/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tactus COMPONENT development
    FILES_MATCHING PATTERN "*.hpp" PATTERN capi EXCLUDE PATTERN examine EXCLUDE PATTERN python EXCLUDE
    PATTERN "kit/single" EXCLUDE   # exported code has these in place of others
    # Only sources of the library include these. Their matrices get their memory as the flags of the compiler say (tests/structure/layouts.py).
    PATTERN "fit/least_squares.hpp" EXCLUDE PATTERN "fit/ring_*.hpp" EXCLUDE PATTERN "fit/smooth_column.hpp" EXCLUDE
    PATTERN "fit/spectrum_model.hpp" EXCLUDE PATTERN "check/pair.hpp" EXCLUDE)
install (FILES framework/capi/tactus.h framework/plugin/tactus_plugin.h host/devices/device_plugins/tactus_device.h
    $<$<TARGET_EXISTS:tactus_live_shared>:${PROJECT_SOURCE_DIR}/host/devices/live/tactus_live.h> DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tactus COMPONENT development)
install (DIRECTORY nodes/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tactus/nodes COMPONENT development FILES_MATCHING PATTERN "*.hpp")

foreach (part framework nodes run c)
    set_target_properties (tactus_${part} PROPERTIES EXPORT_NAME ${part})
    install (TARGETS tactus_${part} EXPORT TactusStatic ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    if (TACTUS_OWN_FUNCTIONS)
        list (JOIN TACTUS_OWN_FUNCTIONS "\" \"" command)
        install (CODE "execute_process (COMMAND \"${command}\" -D \"archive=\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/$<TARGET_FILE_NAME:tactus_${part}>\"
            -P \"${PROJECT_SOURCE_DIR}/framework/own_functions.cmake\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT development)
    endif ()
endforeach ()
install (EXPORT TactusStatic NAMESPACE tactus:: DESTINATION ${package} FILE TactusStatic.cmake COMPONENT development)
if (TARGET tactus_shared)
    install (TARGETS tactus_shared EXPORT TactusShared
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT library)
    if (TARGET tactus_live_shared)
        install (TARGETS tactus_live_shared EXPORT TactusLive
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT live NAMELINK_COMPONENT development
            RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT live)
        install (TARGETS force-guardian RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/tactus COMPONENT live)
        install (EXPORT TactusLive NAMESPACE tactus:: DESTINATION ${package} FILE TactusLive.cmake COMPONENT development)
    endif ()
    install (EXPORT TactusShared NAMESPACE tactus:: DESTINATION ${package} FILE TactusShared.cmake COMPONENT development)
endif ()

configure_package_config_file (framework/TactusConfig.cmake.in ${PROJECT_BINARY_DIR}/installed/TactusConfig.cmake INSTALL_DESTINATION ${package})

# What plugins find in a build tree is in a folder of its own: find_package also looks next to the folders of PATH, so a program that needs an installed
# Tactus would find it there (tests/install/build_tree.sh).
file (REMOVE ${PROJECT_BINARY_DIR}/TactusConfig.cmake ${PROJECT_BINARY_DIR}/TactusConfigVersion.cmake)
configure_file (framework/TactusBuildTree.cmake.in ${PROJECT_BINARY_DIR}/plugin_kit/TactusConfig.cmake @ONLY)
write_basic_package_version_file (${PROJECT_BINARY_DIR}/plugin_kit/TactusConfigVersion.cmake COMPATIBILITY SameMinorVersion)
file (RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)   # so that an installed tree can be moved
configure_file (framework/tactus.pc.in ${PROJECT_BINARY_DIR}/tactus.pc @ONLY)
install (FILES ${PROJECT_BINARY_DIR}/installed/TactusConfig.cmake ${PROJECT_BINARY_DIR}/plugin_kit/TactusConfigVersion.cmake framework/node/catalogue.cmake
    framework/own_functions.cmake framework/plugin/plugin.cmake framework/plugin/plugin.map framework/plugin/device.map DESTINATION ${package} COMPONENT development)
install (FILES ${PROJECT_BINARY_DIR}/tactus.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
if (TARGET tactus_live_shared)
    configure_file (host/devices/live/tactus-live.pc.in ${PROJECT_BINARY_DIR}/tactus-live.pc @ONLY)
    install (FILES ${PROJECT_BINARY_DIR}/tactus-live.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endif ()
