# SPDX-License-Identifier: GPL-3.0-or-later
# Writes a C++ file with a function that returns the bytes of another file:
#     cmake -D input=FILE -D output=FILE.cpp -D function=NAME -P embed.cmake
file (READ ${input} bytes HEX)
string (REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
file (WRITE ${output}
"#include <host/tools/figures/typeface_data.hpp>
namespace tactus::host
{
static constexpr unsigned char bytes[] { ${bytes} };
std::span<const unsigned char> ${function}() noexcept { return bytes; }
}
")
