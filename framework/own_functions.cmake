# SPDX-License-Identifier: MIT
# Makes the inline functions and templates in compiled code its own. A program that links the code has functions of the same names, above all
# those of Eigen, but may have been compiled with other flags: with others, they give other bits, and expect other alignments. A linker keeps one
# copy of each name, so these functions get names that are not visible outside. Static variables and vtables keep theirs.
#
#   cmake -D linker=… -D nm=… -D objcopy=… -D objects="A.o|B.o" -D result=ALL.o -P own_functions.cmake
#       joins objects to one.
#   cmake -D linker=… -D nm=… -D objcopy=… -D ar=… -D archive=LIB.a -P own_functions.cmake
#       changes each object of a static library.

# own (FROM… TO): joins the objects FROM to TO.
function (own)
    list (POP_BACK ARGV to)
    # Without groups, of which the linker would keep one of each name. It keeps all functions.
    execute_process (COMMAND ${linker} -r --force-group-allocation ${ARGV} -o ${to}.all COMMAND_ERROR_IS_FATAL ANY)
    execute_process (COMMAND ${nm} -P --defined-only ${to}.all OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
    # W: functions. u: static variables, of which there must be one in a program, and which a linker finds only in groups; weak ones it finds.
    foreach (kind W u)
        string (REGEX MATCHALL "[^\n ]+ ${kind} [^\n]*" found "${symbols}")
        list (TRANSFORM found REPLACE " ${kind} .*" "")
        list (JOIN found "\n" names)
        file (WRITE ${to}.${kind} "${names}\n")
    endforeach ()
    execute_process (COMMAND ${objcopy} --localize-symbols=${to}.W --weaken-symbols=${to}.u ${to}.all ${to} COMMAND_ERROR_IS_FATAL ANY)
    file (REMOVE ${to}.all ${to}.W ${to}.u)
endfunction ()

if (objects)
    string (REPLACE "|" ";" objects "${objects}")
    own (${objects} ${result})
    return ()
endif ()

cmake_path (ABSOLUTE_PATH archive)   # `cmake --install` may be given a relative prefix
set (folder ${archive}.own)
file (REMOVE_RECURSE ${folder})
file (MAKE_DIRECTORY ${folder})
execute_process (COMMAND ${ar} t ${archive} OUTPUT_VARIABLE members COMMAND_ERROR_IS_FATAL ANY)
string (REGEX MATCHALL "[^\n]+" members "${members}")
set (made)
foreach (member IN LISTS members)
    # Batches of files have the same names in different folders, so an archive has several members of one name.
    if (NOT DEFINED count_${member})
        set (count_${member} 0)
    endif ()
    math (EXPR number "${count_${member}} + 1")
    set (count_${member} ${number})
    execute_process (COMMAND ${ar} xN ${number} ${archive} ${member} WORKING_DIRECTORY ${folder} COMMAND_ERROR_IS_FATAL ANY)
    own (${folder}/${member} ${folder}/${number}_${member})
    list (APPEND made ${folder}/${number}_${member})
endforeach ()
file (REMOVE ${archive})
execute_process (COMMAND ${ar} qcsD ${archive} ${made} COMMAND_ERROR_IS_FATAL ANY)
file (REMOVE_RECURSE ${folder})
