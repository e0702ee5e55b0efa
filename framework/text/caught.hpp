// SPDX-License-Identifier: MIT
#pragma once

#include "result.hpp"

#include <exception>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

namespace tactus
{

/// The exception that is being handled, as an error at this place. Id: program/exception. [in a catch block]
inline Message exceptionAt (std::string where)
{
    std::string what = "of an unknown kind";
    try
    {
        throw;
    }
    catch (const std::bad_alloc&)
    {
        return Message::error ("program/exception", std::move (where), "the memory ran out", "close other programs, or use a smaller file");
    }
    catch (const std::exception& e)
    {
        what = e.what();
    }
    catch (...)
    {
    }
    return Message::error ("program/exception", std::move (where), "an error that Tactus did not expect: " + what,
                           "please report it, and include the file that was read");
}

template <typename T>
struct ResultOf
{
    using Type = Result<T>;
};
template <typename T>
struct ResultOf<Result<T>>
{
    using Type = Result<T>;
};

/// Calls a function at the entry of a thread, where an exception would end the program. What it throws becomes an error at the place `where`, such as
/// the file that the thread reads. Every thread begins with this call; tests/structure/threads.py checks that. Id: program/exception.
template <typename F>
auto caught (std::string where, F&& act) -> typename ResultOf<std::invoke_result_t<F>>::Type
{
    try
    {
        if constexpr (std::is_void_v<std::invoke_result_t<F>>)
        {
            std::forward<F> (act)();
            return {};
        }
        else
            return std::forward<F> (act)();
    }
    catch (...)
    {
        return exceptionAt (std::move (where));
    }
}

}   // namespace tactus
