// SPDX-License-Identifier: MIT
#pragma once

namespace tactus::test
{

/// A node with these parameters, prepared and updated as the engine would do it.
template <typename N>
N ready (const typename N::Params& params = {}, double rate_hz = 1000.0)
{
    N node;
    node.params = params;
    if constexpr (requires { node.prepare ({ .rate_hz = rate_hz }); }) node.prepare ({ .rate_hz = rate_hz });
    if constexpr (requires { node.update(); }) node.update();
    return node;
}

}   // namespace tactus::test
