# SPDX-License-Identifier: GPL-3.0-or-later
# Writes a C++ file with the text of a graph: cmake -D name=FUNCTION -D input=FILE -D output=FILE.cpp -P embed.cmake
file (READ ${input} bytes HEX)
string (REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
file (WRITE ${output}
"#include <string_view>
namespace tactus::bench
{
static constexpr unsigned char bytes[] { ${bytes} };
std::string_view ${name}() noexcept { return { reinterpret_cast<const char*> (bytes), sizeof bytes }; }
}
")
