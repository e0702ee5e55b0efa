# SPDX-License-Identifier: MIT
# Compiles tests in batches, which takes half the time of compiling them one by one: a batch reads the headers once and
# instantiates their templates once. Each file is included inside its own namespace, so two files may use the same names for their
# helpers. All headers must therefore be included first, so this file also runs as a script that writes a batch.

if (CMAKE_SCRIPT_MODE_FILE)   # cmake -D batch=FILE.cpp -D files=A.cpp;B.cpp… -P join.cmake
    set (headers)
    set (tests)
    foreach (file IN LISTS files)
        cmake_path (GET file PARENT_PATH folder)
        string (MAKE_C_IDENTIFIER ${file} name)
        file (STRINGS ${file} lines REGEX "^#include ")
        foreach (line IN LISTS lines)
            string (REGEX REPLACE "^#include \"(.*)\".*" "${folder}/\\1" beside ${line})
            if (EXISTS ${beside})
                set (line "#include \"${beside}\"")
            endif ()
            string (APPEND headers "${line}\n")
        endforeach ()
        string (APPEND tests "namespace ${name}\n{\n#include \"${file}\"\n}\n")
    endforeach ()
    file (WRITE ${batch} "${headers}${tests}")
    return ()
endif ()

# tactus_join (VARIABLE): replaces the files of tests in this list by batches of them. Files that define or extend namespaces are left
# as they are.
function (tactus_join variable)
    # Two batches in one take a sixth less time, four a third less, and each needs more memory: 4 GB at 600 kB. So batches are larger where few
    # are compiled at once; but not those of nodes, because the newcomer's node (tests/newcomer) compiles one of them twice.
    cmake_host_system_information (RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
    set (largest 200000)
    if (processors LESS_EQUAL 2 AND NOT variable STREQUAL node_tests)
        set (largest 600000)
    endif ()
    set (out)
    set (files)
    set (size 0)
    set (number 0)
    list (SORT ${variable})
    foreach (file IN LISTS ${variable} ITEMS last)
        if (NOT file STREQUAL last)
            file (STRINGS ${file} own_namespace REGEX "^(namespace [a-z_:]+$|template <>)" LIMIT_COUNT 1)
            if (own_namespace OR NOT file MATCHES "_test.cpp$")
                list (APPEND out ${file})
                continue ()
            endif ()
            list (APPEND files ${file})
            file (SIZE ${file} bytes)
            math (EXPR size "${size} + ${bytes}")
        endif ()
        if (files AND (size GREATER largest OR file STREQUAL last))
            set (batch ${CMAKE_CURRENT_BINARY_DIR}/joined_${variable}_${number}.cpp)
            add_custom_command (OUTPUT ${batch} DEPENDS ${files} ${CMAKE_CURRENT_FUNCTION_LIST_FILE} VERBATIM
                COMMAND ${CMAKE_COMMAND} -D batch=${batch} "-D files=${files}" -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
            list (APPEND out ${batch})
            set (files)
            set (size 0)
            math (EXPR number "${number} + 1")
        endif ()
    endforeach ()
    set (${variable} ${out} PARENT_SCOPE)
endfunction ()
