// SPDX-License-Identifier: MIT
#pragma once

#include "exported.hpp"

#include <string>

namespace tactus::host
{

struct ClassFiles
{
    std::string header, source;
    std::string data;   ///< constant tables; empty if there are none
};

/// Writes the class of a graph.
ClassFiles classFiles (const Exported&);

}   // namespace tactus::host
