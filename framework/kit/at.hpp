// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>

namespace tactus
{

/// Turns a number into an index into a container. Numbers of nodes, ports, sections and axes are int, so that -1 can mean none.
constexpr std::size_t at (std::signed_integral auto i) noexcept { return static_cast<std::size_t> (i); }

}   // namespace tactus
