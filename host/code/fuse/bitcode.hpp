// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tactus::host
{

/// The functions of a header as LLVM's bitcode, as the program contains it: those of a node (bitcode/node_functions.hpp), or those of
/// framework/run/generated/fused_parts.hpp (bitcode/parts.cpp).
struct Bitcode
{
    std::string_view header;   ///< as it is included: "tactus/nodes/texture/grating.hpp"
    std::string_view bytes;
};

/// All bitcode, by header. Empty if the program was built without clang, or links tactus_no_bitcode. [any thread]
std::span<const Bitcode> allBitcode() noexcept;

/// The bitcode of a header; empty if there is none.
std::string_view findBitcode (std::string_view header) noexcept;

/// The name of a function in the bitcode of a node: "tactus_fused_tick_texture_grating_hpp" for "tick".
std::string bitcodeName (std::string_view function, std::string_view header);

}   // namespace tactus::host
