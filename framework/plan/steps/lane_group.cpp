// SPDX-License-Identifier: MIT
#include "lane_group.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

namespace tactus::plan
{

namespace
{
constexpr std::align_val_t alignment { 64 };
using Words = std::uint64_t[LaneForm::most_words];
}   // namespace

void LaneGroup::Freed::operator() (std::byte* bytes) const noexcept { ::operator delete (bytes, alignment); }

LaneGroup::LaneGroup (const NodeType& t, const LaneForm& f, std::vector<std::shared_ptr<void>> nodes)
    : type (t), lane_form (f), all (std::move (nodes)), memory (static_cast<std::byte*> (::operator new (packs() * f.size, alignment)))
{
    const auto* settings = type.lanes.settings (all.front().get());
    for (std::size_t p = 0; p < packs(); ++p)
        lane_form.make (pack (p), settings);
}

/// Writes words of the i-th node to its lane.
void LaneGroup::put (std::size_t i, std::size_t first, std::size_t words, const std::uint64_t* from) noexcept
{
    auto* lane = static_cast<std::byte*> (pack (i / lane_form.width)) + i % lane_form.width * sizeof (double);
    for (std::size_t w = 0; w < words; ++w)
        std::memcpy (lane + lane_form.offsets[first + w], &from[w], sizeof from[w]);
}

bool LaneGroup::allFit() const noexcept
{
    return std::ranges::all_of (all, [this] (const auto& node) { return type.lanes.fit (node.get()); });
}

void LaneGroup::load() noexcept
{
    in_lanes = allFit();
    if (! in_lanes) return;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        Words words;
        type.lanes.saveParams (all[i].get(), words);
        put (i, 0, lane_form.params, words);
        type.lanes.saveState (all[i].get(), words);
        put (i, lane_form.params, lane_form.state, words);
    }
    if (lane_form.update != nullptr)
        for (std::size_t p = 0; p < packs(); ++p)
            lane_form.update (pack (p));
}

void LaneGroup::unload() noexcept
{
    if (! in_lanes) return;
    in_lanes = false;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        Words words;
        const auto* lane = static_cast<const std::byte*> (pack (i / lane_form.width)) + i % lane_form.width * sizeof (double);
        for (std::size_t w = 0; w < lane_form.state; ++w)
            std::memcpy (&words[w], lane + lane_form.offsets[lane_form.params + w], sizeof words[w]);
        type.lanes.restoreState (all[i].get(), words);
    }
}

void LaneGroup::refresh (std::size_t i) noexcept
{
    if (! in_lanes) return;
    if (! type.lanes.fit (all[i].get())) return unload();
    Words words;
    type.lanes.saveParams (all[i].get(), words);
    put (i, 0, lane_form.params, words);
    if (lane_form.update != nullptr) lane_form.update (pack (i / lane_form.width));
}

void LaneGroup::tick (Connections& wiring) noexcept
{
    if (in_lanes)
        lane_form.tick (memory.get(), packs(), wiring.packed, wiring.inputs, wiring.outputs);
    else
        tickOneByOne (wiring);
}

/// The nodes write their outputs as a struct, and these go to the lanes word by word.
void LaneGroup::tickOneByOne (Connections& wiring) noexcept
{
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        type.tick (all[i].get(), wiring.sources[i], wiring.scratch.data());
        auto* out = reinterpret_cast<double*> (static_cast<std::byte*> (wiring.outputs) + i / lane_form.width * lane_form.outputs_size);
        for (std::size_t w = 0; w < wiring.scratch.size(); ++w)
            out[w * lane_form.width + i % lane_form.width] = wiring.scratch[w];
    }
    load();   // if all fit
}

}   // namespace tactus::plan
