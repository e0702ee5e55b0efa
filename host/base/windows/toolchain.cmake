# SPDX-License-Identifier: MIT
# Builds for 64-bit Windows with Debian's mingw-w64: `cmake --preset windows`.
set (CMAKE_SYSTEM_NAME Windows)
set (CMAKE_SYSTEM_VERSION 10.0)
set (CMAKE_SYSTEM_PROCESSOR AMD64)
set (CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set (CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set (CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

set (CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set (CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set (CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set (CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set (CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)   # Eigen and JUCE are sources, the same for every system

# Windows 10: its console takes UTF-8, and its timers have a high resolution.
# Batches of files have more sections than the default format of object files can count.
set (CMAKE_C_FLAGS_INIT "-D_WIN32_WINNT=0x0A00 -DWINVER=0x0A00")
set (CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT} -DNOMINMAX -DWIN32_LEAN_AND_MEAN -Wa,-mbig-obj")
# A program is one file: it needs no library of the compiler beside it.
foreach (kind EXE SHARED MODULE)
    set (CMAKE_${kind}_LINKER_FLAGS_INIT "-static -fstack-protector-strong")
endforeach ()
