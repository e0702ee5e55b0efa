# SPDX-License-Identifier: MIT
# Builds a catalogue from a folder of headers. A header registers its node by ending with
#     TACTUS_NODE (my::Node);
# Each node gets its own translation unit, so editing a node compiles one file. This script reads only the names of the headers and
# their TACTUS_NODE lines, so that an edit does not rerun CMake.

# tactus_collect_nodes (RESULT FOLDER INCLUDED_AS END): RESULT becomes the generated sources of all nodes in the folder, whose headers
# are included as INCLUDED_AS/path. END is C++ code that follows the declaration of `nodeTypes()`, which returns all of them.
function (tactus_collect_nodes result folder included_as end)
    file (GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${folder} ${folder}/*.hpp)
    list (SORT headers)
    get_filename_component (library ${CMAKE_CURRENT_BINARY_DIR} NAME)

    foreach (header IN LISTS headers)
        file (STRINGS ${folder}/${header} line REGEX "^TACTUS_NODE")
        list (LENGTH line nodes)
        if (nodes EQUAL 0)
            message (FATAL_ERROR "${folder}/${header} has no TACTUS_NODE line. Add one, or move the header to framework/kit/ or out of this folder.")
        elseif (nodes GREATER 1)
            message (FATAL_ERROR "${folder}/${header} has ${nodes} TACTUS_NODE lines. Give each node its own header.")
        endif ()
        string (MAKE_C_IDENTIFIER "${library}_${header}" name)

        file (CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT
"#include <tactus/node/catalogue.hpp>
#undef TACTUS_REGISTER
#define TACTUS_REGISTER(N) tactus::NodeType ${name}() { return tactus::describe<N>(); }
#include <${included_as}/${header}>
" @ONLY)
        list (APPEND sources ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
        string (APPEND declarations "tactus::NodeType ${name}();\n")
        string (APPEND types "${name}(), ")
    endforeach ()

    file (CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/catalogue.cpp CONTENT
"#include <tactus/node/catalogue.hpp>
${declarations}
static std::vector<tactus::NodeType> nodeTypes() { return { ${types}}; }
${end}
" @ONLY)
    list (APPEND sources ${CMAKE_CURRENT_BINARY_DIR}/catalogue.cpp)
    set (${result} ${sources} PARENT_SCOPE)
endfunction ()

# tactus_add_nodes (PROGRAM FOLDER): adds the nodes of a folder to a program. Its catalogue contains them next to the nodes of Tactus.
function (tactus_add_nodes program folder)
    get_filename_component (folder ${folder} ABSOLUTE)
    tactus_collect_nodes (sources ${folder} ${folder} "static const tactus::NodeLibrary library { nodeTypes };")
    # An object library: from a static library, the linker would drop the nodes, because no code calls them.
    add_library (${program}_nodes OBJECT ${sources})
    target_link_libraries (${program}_nodes PUBLIC tactus::nodes PRIVATE tactus::node_flags)
    target_link_libraries (${program} PRIVATE tactus::nodes)
    if (CMAKE_SYSTEM_NAME STREQUAL Linux AND CMAKE_LINKER AND CMAKE_NM AND CMAKE_OBJCOPY)
        # The program is compiled with other flags, and must not share inline functions with the nodes.
        set (own ${CMAKE_CURRENT_BINARY_DIR}/${program}_nodes.o)
        set (here ${CMAKE_CURRENT_FUNCTION_LIST_DIR})   # the script is next to this file in an installed tree, and in the folder above in the sources
        find_file (script own_functions.cmake PATHS ${here} ${here}/.. NO_DEFAULT_PATH NO_CACHE REQUIRED)
        set_target_properties (${program}_nodes PROPERTIES INTERPROCEDURAL_OPTIMIZATION OFF)
        add_custom_command (OUTPUT ${own} DEPENDS ${program}_nodes $<TARGET_OBJECTS:${program}_nodes> VERBATIM COMMAND_EXPAND_LISTS
            COMMAND ${CMAKE_COMMAND} -D linker=${CMAKE_LINKER} -D nm=${CMAKE_NM} -D objcopy=${CMAKE_OBJCOPY} -D result=${own}
                "-D objects=$<JOIN:$<TARGET_OBJECTS:${program}_nodes>,|>" -P ${script})
        target_sources (${program} PRIVATE ${own})
    else ()
        target_link_libraries (${program} PRIVATE ${program}_nodes)
    endif ()
endfunction ()
