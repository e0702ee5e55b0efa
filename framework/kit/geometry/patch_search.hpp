// SPDX-License-Identifier: MIT
#pragma once

#include "placed_surface.hpp"
#include <tactus/kit/threads/async_query.hpp>

#include <algorithm>
#include <memory>
#include <optional>

namespace tactus
{

/// Finds the point of a surface that is nearest to a tool: either within the tick, or by a search on another thread, which answers some
/// ticks later.
class PatchSearch
{
public:
    PatchSearch() = default;

    /// If `ticks` is 0, it searches everything within the tick and does not need `index` and `answers`. [main thread]
    PatchSearch (std::shared_ptr<const PlacedSurface> body_, int ticks_, std::shared_ptr<const NearestTriangle> index, QueryService* answers)
        : body (std::move (body_)), ticks (ticks_)
    {
        if (ticks == 0) return;
        const auto find = [held = body, index] (const Vec3& p) noexcept { return index ? (*index) (p) : nearestOfAll (held->walk().mesh(), p); };
        search = std::make_shared<Search> (find, ticks, answers);
    }

    bool takesTime() const noexcept { return search != nullptr; }

    /// The answer that is due on this tick, if any: the triangle nearest to where the tool was when the search began. Call this
    /// once per tick. Only one search runs at a time, and only while `wanted`. [tick thread]
    std::optional<int> answer (const Vec3& p, bool wanted) noexcept
    {
        if (! search) return {};
        const bool asks = wanted && until_asked == 0;
        until_asked = asks ? ticks - 1 : std::max (0, until_asked - 1);
        const auto found = (*search) (asks ? std::optional<Vec3> (p) : std::nullopt);
        return wanted ? found : std::nullopt;
    }

    /// Call this instead of answer() on a tick without a position. [tick thread]
    void skip() noexcept
    {
        if (search) (*search) (std::nullopt);
    }

    /// The nearest spot, given the answer and the spot of the tick before. An answer is only a starting point for a walk. A walk
    /// from the previous spot may end at a nearer one, so the nearer of the two results is returned. [tick thread]
    Spot nearest (std::optional<int> found, const Spot& before, const Vec3& p) const noexcept
    {
        if (! search) return body->walk().nearestOfAll (p, before.triangle);
        const Spot walked = before.triangle >= 0 ? body->walk().nearest (before.triangle, p) : Spot {};
        if (! found) return walked;
        const Spot there = body->walk().nearest (*found, p);
        return walked.triangle < 0 || (there.on.point - p).squaredNorm() < (walked.on.point - p).squaredNorm() ? there : walked;
    }

    void serialize (auto& archive)
    {
        archive (until_asked);
        if (search) archive (*search);
    }

private:
    using Search = AsyncQuery<Vec3, int>;

    std::shared_ptr<const PlacedSurface> body;
    std::shared_ptr<Search> search;   // null: searches within the tick
    int ticks = 0;
    int until_asked = 0;   // ticks until the next search may begin
};

}   // namespace tactus
