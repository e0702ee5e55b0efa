# SPDX-License-Identifier: MIT
# Compiles the ticks of all nodes to LLVM's bitcode, which the programs contain (bitcode.hpp). This takes clang, and is left out without it.

# The oldest clang that is installed: each LLVM reads the bitcode of older ones.
find_program (TACTUS_CLANG NAMES clang++-14 clang++-15 clang++-16 clang++-17 clang++-18 clang++-19 clang++
    DOC "clang for the bitcode of nodes, with which LLVM fuses graphs; OFF: only a compiler fuses graphs")

set (clang_flags -std=c++20 -O3 -DNDEBUG -w -fPIC -fvisibility=hidden -fvisibility-inlines-hidden ${TACTUS_SAME_BITS})
string (REGEX MATCHALL "(^| )-m[^ ]+" machine "${CMAKE_CXX_FLAGS}")   # these can change how a struct is laid out in memory
foreach (flag IN LISTS machine)
    string (STRIP ${flag} flag)
    list (APPEND clang_flags ${flag})
endforeach ()
get_target_property (eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
foreach (folder IN LISTS eigen)
    list (APPEND clang_flags -isystem ${folder})
endforeach ()
list (APPEND clang_flags -I${PROJECT_SOURCE_DIR} -I${PROJECT_BINARY_DIR}/include)
set (clang ${CMAKE_CXX_COMPILER_LAUNCHER} ${TACTUS_CLANG} ${clang_flags})
set (bitcode_folder ${CMAKE_CURRENT_BINARY_DIR}/bitcode)

# tactus_run_clang (OUTPUT SOURCE [FLAG...]): a command that compiles one file.
function (tactus_run_clang output source)
    file (RELATIVE_PATH name ${PROJECT_BINARY_DIR} ${output})
    add_custom_command (OUTPUT ${output}
        COMMAND ${clang} ${ARGN} -MD -MF ${output}.d -MQ ${output} -c ${source} -o ${output}
        DEPENDS ${source} ${precompiled} DEPFILE ${output}.d COMMENT "Building bitcode ${name}" VERBATIM)
endfunction ()

# tactus_make_bitcode (RESULT): RESULT becomes the source file with all bitcode. It defines allBitcode().
function (tactus_make_bitcode result)
    set (headers)
    if (TACTUS_CLANG AND CMAKE_SYSTEM_NAME STREQUAL Linux AND NOT TACTUS_SANITIZE)
        file (GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/nodes ${PROJECT_SOURCE_DIR}/nodes/*.hpp)
        list (SORT headers)
        set (functions ${bitcode_folder}/node_functions.pch)
        tactus_run_clang (${functions} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/node_functions.hpp -x c++-header -Xclang -fno-pch-timestamp)
        set (precompiled ${functions})
        set (parts ${bitcode_folder}/parts.bc)
        tactus_run_clang (${parts} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/parts.cpp -emit-llvm)
        set (files ${parts})
        set (names tactus/run/generated/fused_parts.hpp)
    else ()
        message (STATUS "Graphs are fused by a compiler only: there is no clang for the bitcode of nodes")
    endif ()
    foreach (header IN LISTS headers)
        string (MAKE_C_IDENTIFIER ${header} name)
        file (CONFIGURE OUTPUT ${bitcode_folder}/${name}.cpp CONTENT
"#undef TACTUS_REGISTER
#define TACTUS_REGISTER(N) TACTUS_NODE_FUNCTIONS (N, ${name})
#include <tactus/nodes/${header}>
" @ONLY)
        tactus_run_clang (${bitcode_folder}/${name}.bc ${bitcode_folder}/${name}.cpp -include-pch ${functions} -emit-llvm)
        list (APPEND files ${bitcode_folder}/${name}.bc)
        list (APPEND names tactus/nodes/${header})
    endforeach ()

    # The table also includes a header that changes with these files, because ccache does not see that the assembler reads them.
    set (digest ${bitcode_folder}/digest.hpp)
    set (script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/digest.cmake)
    add_custom_command (OUTPUT ${digest} COMMAND ${CMAKE_COMMAND} -D "files=${files}" -D output=${digest} -P ${script} DEPENDS ${files} ${script} VERBATIM)

    set (number 0)
    foreach (file name IN ZIP_LISTS files names)
        string (APPEND data ".balign 16\ntactus_bitcode_${number}:\n.incbin \"${file}\"\ntactus_bitcode_${number}_end:\n")
        string (APPEND declarations "extern const char tactus_bitcode_${number}[], tactus_bitcode_${number}_end[];\n")
        string (APPEND rows "        { \"${name}\", { tactus_bitcode_${number}, tactus_bitcode_${number}_end } },\n")
        math (EXPR number "${number} + 1")
    endforeach ()
    if (number EQUAL 0)
        set (text "std::span<const tactus::host::Bitcode> tactus::host::allBitcode() noexcept { return {}; }\n")
    else ()
        set (text
"asm (R\"(.section .rodata
${data}.previous
)\");
extern \"C\"
{
${declarations}}
std::span<const tactus::host::Bitcode> tactus::host::allBitcode() noexcept
{
    static const Bitcode all[] {
${rows}    };
    return all;
}
")
    endif ()
    set (${result} ${CMAKE_CURRENT_BINARY_DIR}/bitcode_table.cpp)
    file (CONFIGURE OUTPUT ${${result}} CONTENT "#include <host/code/fuse/bitcode.hpp>\n#include \"${digest}\"\n${text}" @ONLY)
    set_source_files_properties (${${result}} PROPERTIES OBJECT_DEPENDS "${files};${digest}" SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
    set (${result} ${${result}} PARENT_SCOPE)
endfunction ()
