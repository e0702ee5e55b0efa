// SPDX-License-Identifier: MIT
#pragma once

#include "fused_code.hpp"

#include <host/code/generate/walk/plan_walk.hpp>

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace tactus::host
{

/// The nodes of a plan whose code can be part of fused code. [main thread]
class FusedNodes
{
public:
    /// `has` tells whether the code of this header can be part of the code that is written.
    FusedNodes (const Plan&, FusedCode::Classes more, bool (*has) (const std::string& header));

    const std::vector<PlanNode>& all() const noexcept { return nodes; }   ///< in the order of Plan::instances
    const PlanNode* find (const void* node) const;                        ///< null if its code is not known

    bool isRare (const PlanNode& n) const { return uses.at (n.header) <= most_copies; }   ///< few nodes of the plan have the same type

    std::set<std::string> headers() const;   ///< as in FusedCode

private:
    /// A compiler takes much longer if the code of a large node is repeated many times.
    static constexpr std::size_t most_copies = 4;

    std::vector<PlanNode> nodes;
    std::unordered_map<const void*, std::size_t> by_address;   // the number in `nodes`
    std::map<std::string, std::size_t> uses;                   // nodes by header
};

}   // namespace tactus::host
