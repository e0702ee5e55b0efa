# SPDX-License-Identifier: GPL-3.0-or-later
# Writes a C++ file that includes the sources in FOLDER/tactus, whichever they are: cmake -D folder=FOLDER -D output=FILE.cpp -P batch.cmake
file (GLOB_RECURSE sources ${folder}/tactus/*.cpp)
list (SORT sources)
list (TRANSFORM sources REPLACE "(.+)" "#include \"\\1\"")
list (JOIN sources "\n" sources)
file (WRITE ${output} "${sources}\n")
