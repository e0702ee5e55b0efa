// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace tactus
{

/// A hook of a node in a plugin failed. compile() reports it as an error of the graph.
struct NodeFault : std::runtime_error
{
    using runtime_error::runtime_error;
};

}   // namespace tactus
