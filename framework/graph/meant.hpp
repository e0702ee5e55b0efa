// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace tactus::graph
{

/// The remedy for text that is not an id: the id that was probably meant, "my_board" for "My-Board", and what an id is.
std::string idRemedy (std::string_view);

/// The remedy for text that is not a wire: the wire that was probably meant, or how to write one.
std::string wireRemedy (std::string_view);

}   // namespace tactus::graph
