# SPDX-License-Identifier: MIT
# Builds a catalogue from a folder of headers. A header registers its node by ending with
#     TACTUS_NODE (my::Node);
# Each node gets its own translation unit, so editing a node compiles one file. This script reads only the names of the headers and
# their TACTUS_NODE lines, so that an edit does not rerun CMake.

# The widths of packs for which nodes with a TACTUS_LANES line are also compiled, and their flags (framework/kit/pack.hpp). Without fused
# multiply-adds, which AVX-512 has, too: no code asks for them, and -ffp-contract=off keeps the compiler from making any. To clang, -mno-fma
# means that there is no AVX-512 either.
#
# The wide packs are for Release only. Without optimisation, a compiler emits small functions that it would otherwise inline, such as those
# of <cmath>, with AVX2 instructions too, and the linker may keep that copy for all code. tests/structure/lanes.py looks for such copies.
set (TACTUS_LANE_WIDTHS 2)
set (TACTUS_LANES_2_FLAGS "")
if (CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$" AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND CMAKE_BUILD_TYPE STREQUAL Release)
    set (TACTUS_LANE_WIDTHS 2 4 8)
    set (TACTUS_LANES_4_FLAGS -mavx2 -mno-fma)
    set (TACTUS_LANES_8_FLAGS -mavx2 -mavx512f)
    if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
        # Otherwise GCC copies packs in parts of 16 bytes, and a load of a whole pack must wait for all of them.
        list (APPEND TACTUS_LANES_4_FLAGS -mmove-max=256 -mstore-max=256)
        list (APPEND TACTUS_LANES_8_FLAGS -mmove-max=512 -mstore-max=512)
    endif ()
    if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        list (APPEND TACTUS_LANES_8_FLAGS -mno-fma -fno-tree-slp-vectorize -Wno-uninitialized -Wno-maybe-uninitialized)   # GCC 12 warns about its own header
    endif ()
endif ()

# tactus_collect_lanes (RESULT NAME HEADER): for each width, RESULT_WIDTH gets the file for a node, and RESULT the C++ code that lists its forms.
function (tactus_collect_lanes result name header)
    set (forms "")
    set (declarations "")
    foreach (width 2 4 8)
        if (NOT width IN_LIST TACTUS_LANE_WIDTHS)
            string (APPEND forms "nullptr, ")
            continue ()
        endif ()
        file (CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}_lanes${width}.cpp CONTENT
"#include <tactus/node/form_lanes.hpp>
#undef TACTUS_LANES
tactus::LaneForm ${name}_lanes${width}() noexcept;
#define TACTUS_LANES(N) tactus::LaneForm ${name}_lanes${width}() noexcept { return tactus::formLanes<N, ${width}>(); }
#include <${header}>
" @ONLY)
        set (${result}_${width} ${CMAKE_CURRENT_BINARY_DIR}/${name}_lanes${width}.cpp PARENT_SCOPE)
        string (APPEND forms "${name}_lanes${width}, ")
        string (APPEND declarations "tactus::LaneForm ${name}_lanes${width}() noexcept; ")
    endforeach ()
    set (${result} "${declarations}|${forms}" PARENT_SCOPE)
endfunction ()

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

        file (STRINGS ${folder}/${header} has_lanes REGEX "^TACTUS_LANES")
        set (more "")
        set (declared "")
        if (has_lanes)
            tactus_collect_lanes (lanes ${name} ${included_as}/${header})
            string (REGEX REPLACE "\\|.*" "" declared "${lanes}")
            string (REGEX REPLACE ".*\\|" "" forms "${lanes}")
            set (more "type.lanes = tactus::laneNode<N> ({ ${forms}}); ")
            foreach (width IN LISTS TACTUS_LANE_WIDTHS)
                list (APPEND lanes_${width}_sources ${lanes_${width}})
            endforeach ()
        endif ()
        file (CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT
"#include <tactus/node/catalogue.hpp>
#include <tactus/node/node_lanes.hpp>
${declared}
#undef TACTUS_REGISTER
#define TACTUS_REGISTER(N) tactus::NodeType ${name}() { auto type = tactus::describe<N>(); ${more}return type; }
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
    foreach (width IN LISTS TACTUS_LANE_WIDTHS)
        set (${result}_lanes${width} ${lanes_${width}_sources} PARENT_SCOPE)
    endforeach ()
endfunction ()

# tactus_add_lanes (TARGET RESULT): compiles what tactus_collect_nodes has put into RESULT_lanesWIDTH, each width with its own flags, and adds it
# to the target. Without the precompiled header of the target, which has other flags.
function (tactus_add_lanes target result)
    set (objects "")
    foreach (width IN LISTS TACTUS_LANE_WIDTHS)
        set (sources ${${result}_lanes${width}})
        if (sources AND TACTUS_JOIN)   # not by UNITY_BUILD, which leaves out files that have flags of their own
            list (TRANSFORM sources REPLACE "(.+)" "#include \"\\1\"\n" OUTPUT_VARIABLE includes)
            string (JOIN "" includes ${includes})
            set (sources ${CMAKE_CURRENT_BINARY_DIR}/${target}_lanes${width}.cpp)
            file (CONFIGURE OUTPUT ${sources} CONTENT "${includes}" @ONLY)
        endif ()
        if (sources)
            add_library (${target}_lanes${width} OBJECT ${sources})
            set_target_properties (${target}_lanes${width} PROPERTIES UNITY_BUILD OFF)
            target_link_libraries (${target}_lanes${width} PRIVATE tactus_framework $<BUILD_INTERFACE:tactus_options>)
            set_source_files_properties (${sources} PROPERTIES COMPILE_OPTIONS "${TACTUS_LANES_${width}_FLAGS}")
            target_sources (${target} PRIVATE $<TARGET_OBJECTS:${target}_lanes${width}>)
            list (APPEND objects $<TARGET_OBJECTS:${target}_lanes${width}>)
        endif ()
    endforeach ()
    set (${target}_lane_objects ${objects} CACHE INTERNAL "what a library of the objects of ${target} needs, too")
endfunction ()

# tactus_add_nodes (PROGRAM FOLDER): adds the nodes of a folder to a program. Its catalogue contains them next to the nodes of Tactus.
function (tactus_add_nodes program folder)
    get_filename_component (folder ${folder} ABSOLUTE)
    tactus_collect_nodes (sources ${folder} ${folder} "static const tactus::NodeLibrary library { nodeTypes };")
    # An object library: from a static library, the linker would drop the nodes, because no code calls them.
    add_library (${program}_nodes OBJECT ${sources})
    tactus_add_lanes (${program}_nodes sources)
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
