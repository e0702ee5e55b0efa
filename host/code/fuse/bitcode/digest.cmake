# SPDX-License-Identifier: MIT
# Writes a header with the digests of files: cmake -D "files=FILE;FILE..." -D output=HEADER -P digest.cmake
foreach (file IN LISTS files)
    file (SHA256 ${file} digest)
    string (APPEND text "// ${digest}\n")
endforeach ()
file (WRITE ${output} "${text}")
