# SPDX-License-Identifier: GPL-3.0-or-later
# Writes a C++ file with the doc comment of each node: cmake -D folder=FOLDER -D output=FILE.cpp -P node_docs.cmake
# Leaves the file alone if nothing has changed, so that most edits of a node do not recompile it.
file (GLOB_RECURSE headers ${folder}/*.hpp)
foreach (header IN LISTS headers)
    file (READ ${header} text)
    string (REGEX MATCH "((///[^\n]*\n)+)(template <[^\n]*>\n)?struct" doc "${text}")
    string (REGEX REPLACE "(^|\n)/// ?" "\\1" doc "${CMAKE_MATCH_1}")
    string (REGEX MATCH "\\.id = \"([^\"]+)\"" id "${text}")
    string (APPEND docs "{ \"${CMAKE_MATCH_1}\", R\"doc(${doc})doc\" },\n")
endforeach ()
file (CONFIGURE OUTPUT ${output} CONTENT
"#include <string_view>
#include <utility>
#include <vector>
namespace tactus::host
{
extern const std::vector<std::pair<std::string_view, std::string_view>> node_docs;
const std::vector<std::pair<std::string_view, std::string_view>> node_docs {
${docs}};
}
" @ONLY)
