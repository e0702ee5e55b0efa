# SPDX-License-Identifier: MIT
# What `cmake --install --component wheel` installs: the content of the wheel that tactus_backend.py packs. The library for devices finds the guardian, the
# presets and the profiles next to itself, so all of them are in the package. Names of the build folder are removed by --strip.
if (TARGET tactus_python AND TARGET tactus_live_shared)
    install (TARGETS tactus_python LIBRARY DESTINATION tactus COMPONENT wheel EXCLUDE_FROM_ALL)
    install (TARGETS tactus_live_shared LIBRARY DESTINATION tactus COMPONENT wheel NAMELINK_SKIP EXCLUDE_FROM_ALL)
    install (TARGETS force-guardian RUNTIME DESTINATION tactus COMPONENT wheel EXCLUDE_FROM_ALL)
    install (DIRECTORY framework/python/tactus/ DESTINATION tactus COMPONENT wheel EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
    install (DIRECTORY graphs/ DESTINATION tactus/graphs COMPONENT wheel EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN "*.json" PATTERN "assets/*.png" PATTERN "assets/*.obj" PATTERN "assets/*.csv" PATTERN "assets/*.haptic")
    install (DIRECTORY host/devices/profiles/ DESTINATION tactus/profiles COMPONENT wheel EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.json")
endif ()
