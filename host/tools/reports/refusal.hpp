// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/message.hpp>
#include <tactus/text/result.hpp>

#include <string>
#include <type_traits>
#include <utility>

namespace tactus::host
{

/// The end of an examination whose input is wrong, as an exception: it ends in the middle of a search. The command line prints the messages; the C API
/// returns them.
struct Refusal
{
    Messages messages;   ///< warnings, and at least one error
};

[[noreturn]] inline void refuse (Message why) { throw Refusal { { std::move (why) } }; }

/// Returns the value of a result, or refuses.
template <typename Expected>
auto orRefuse (Expected&& result)
{
    if (! result) refuse (result.error());
    if constexpr (! std::is_void_v<typename std::remove_cvref_t<Expected>::value_type>)
        return std::move (*result);
}

}   // namespace tactus::host
