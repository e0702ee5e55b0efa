// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/message.hpp>

#include <cstdlib>

namespace tactus::fuzz
{

/// Checks that an error has an id, a location, a description and a remedy. Aborts otherwise.
inline void checkWhole (const Message& e)
{
    if (e.id.empty() || e.where.empty() || e.text.empty() || e.remedy.empty()) std::abort();
}

}   // namespace tactus::fuzz
