# SPDX-License-Identifier: MIT
# The linker: LLVM's takes a second for a program for which that of mingw takes minutes. GCC for Windows cannot be told to use it, but runs a program
# called collect2, which it looks for here first. The arguments are the same.
find_program (TACTUS_LLD NAMES ld.lld-14 ld.lld-22 ld.lld)
if (TACTUS_LLD)
    file (WRITE ${PROJECT_BINARY_DIR}/linker/collect2 "#!/bin/sh\nexec '${TACTUS_LLD}' \"$@\"\n")
    file (CHMOD ${PROJECT_BINARY_DIR}/linker/collect2 PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
    add_link_options (-B${PROJECT_BINARY_DIR}/linker/)
endif ()
