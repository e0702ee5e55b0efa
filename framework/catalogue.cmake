# SPDX-License-Identifier: MIT
# Builds the catalogue from the headers in nodes/. A header joins by ending in
#     TACTUS_NODE (tactus::nodes::MyNode);
# Each becomes a translation unit of its own, so that a new node compiles alone.
function (tactus_collect_nodes result)
    file (GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/*.hpp)
    list (SORT headers)

    foreach (header IN LISTS headers)
        file (STRINGS ${PROJECT_SOURCE_DIR}/${header} line REGEX "^TACTUS_NODE")
        if (NOT line)
            message (FATAL_ERROR "${header} has no TACTUS_NODE line; helpers shared by nodes belong in framework/")
        endif ()
        list (LENGTH line nodes)
        if (nodes GREATER 1)
            message (FATAL_ERROR "${header} has ${nodes} TACTUS_NODE lines; one node is one header")
        endif ()
        set_property (DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${header})
        string (REGEX REPLACE "^TACTUS_NODE *\\(([A-Za-z0-9_:]+)\\).*" "\\1" type "${line}")
        string (REGEX REPLACE "[/.]" "_" name "${header}")

        file (CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT
"#include <framework/catalogue.hpp>
#include <${header}>
tactus::NodeType ${name}() { return tactus::describe<${type}>(); }
" @ONLY)
        list (APPEND sources ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
        string (APPEND declarations "tactus::NodeType ${name}();\n")
        string (APPEND types "${name}(), ")
    endforeach ()

    file (CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/catalogue.cpp CONTENT
"#include <framework/catalogue.hpp>
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
