// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/io/error.hpp>

#include <cstdlib>

namespace tactus::fuzz
{

/// An error says all four things. Aborts if not.
inline void checkWhole (const host::Error& e)
{
    if (e.id.empty() || e.where.empty() || e.what.empty() || e.remedy.empty()) std::abort();
}

}   // namespace tactus::fuzz
