// SPDX-License-Identifier: MIT
#include "plan.hpp"

namespace tactus
{

void Plan::fuse (std::shared_ptr<const FusedTick> code)
{
    const auto* next = code.get();
    if (code && std::ranges::find (fused_kept, code) == fused_kept.end()) fused_kept.push_back (std::move (code));
    fused_now.store (next, std::memory_order_release);
}

void Plan::tickRecords() noexcept
{
    for (const auto& r : parts.records)
        r.step (r.self, r.sources, r.outputs);
    ++parts.number;
}

void Plan::settle() noexcept
{
    parts.ramps.forgetWritten();
    for (const auto& r : parts.settled)
        r.step (r.self, r.sources, r.outputs);
}

void Plan::forgetGraph()
{
    parts.flat = {};
    parts.exposed = std::make_shared<std::map<std::string, std::vector<plan::PortRef>>>();
    parts.instances = std::vector<plan::Instance>();   // = {} would keep the memory
    parts.ramps = {};
    parts.takeover = {};
}

}   // namespace tactus
