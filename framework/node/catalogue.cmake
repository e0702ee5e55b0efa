# SPDX-License-Identifier: MIT
# Builds the catalogue from the headers in nodes/. A header registers its node by ending with
#     TACTUS_NODE (tactus::nodes::MyNode);
# Each node gets its own translation unit, so editing a node compiles one file. This script reads only the names of the headers,
# so that an edit does not rerun CMake.
function (tactus_collect_nodes result)
    file (GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/*.hpp)
    list (SORT headers)

    foreach (header IN LISTS headers)
        file (STRINGS ${PROJECT_SOURCE_DIR}/${header} line REGEX "^TACTUS_NODE")
        list (LENGTH line nodes)
        if (nodes EQUAL 0)
            message (FATAL_ERROR "${header} has no TACTUS_NODE line. Helpers that nodes share belong in framework/kit/.")
        elseif (nodes GREATER 1)
            message (FATAL_ERROR "${header} has ${nodes} TACTUS_NODE lines. Each node has its own header.")
        endif ()
        string (REGEX REPLACE "[/.]" "_" name "${header}")

        file (CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT
"#include <tactus/node/catalogue.hpp>
#undef TACTUS_REGISTER
#define TACTUS_REGISTER(N) tactus::NodeType ${name}() { return tactus::describe<N>(); }
#include <${header}>
" @ONLY)
        list (APPEND sources ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
        string (APPEND declarations "tactus::NodeType ${name}();\n")
        string (APPEND types "${name}(), ")
    endforeach ()

    file (CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/catalogue.cpp CONTENT
"#include <tactus/node/catalogue.hpp>
${declarations}
const tactus::Catalogue& tactus::catalogue()
{
    static const Catalogue all { { ${types}} };
    return all;
}
" @ONLY)
    list (APPEND sources ${CMAKE_CURRENT_BINARY_DIR}/catalogue.cpp)
    set (${result} ${sources} PARENT_SCOPE)
endfunction ()
