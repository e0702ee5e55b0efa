// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/cutting.hpp>
#include <tactus/kit/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tactus
{

/// The places where a flat body has been cut: the planes of the last cuts, and how deep the crack is along each of them.
///
/// Each plane is at right angles to the surface. It is divided into columns of equal width that run straight down; each column has one
/// crack. Columns are counted along the plane from where the cut began. Only the last cuts and columns are kept: a new cut replaces
/// the one that has been unused for longest, and a column replaces the one `columns` away from it, which is then whole again.
class CutPlaces
{
public:
    static constexpr int cuts = 16, columns = 512;
    static constexpr int longest = 250;       ///< most columns that an edge may cover
    static constexpr double furthest = 1e9;   ///< how far an edge may be from where its cut began, in columns

    struct Column
    {
        Cutting::Crack crack;
        bool follows = false;     ///< the edge is over the column, and the crack follows it
        std::int32_t index = 0;   ///< counted from the start of the cut
    };

    class Cut
    {
    public:
        double distance (const Vec3& p) const noexcept { return std::abs (aside.dot (p - origin)); }   ///< from the plane, in m
        double place (const Vec3& p) const noexcept { return direction.dot (p - origin); }             ///< along the plane, in m
        const Vec3& along() const noexcept { return direction; }
        double spacing() const noexcept { return width; }   ///< width of a column, in m

        /// The column with this index, for writing. It replaces a column that is a multiple of `columns` away.
        Column& operator[] (std::int32_t index) noexcept
        {
            Column& c = all[static_cast<std::size_t> (index) % columns];
            if (c.index != index) c = {};
            c.index = index;
            return c;
        }

        /// The crack in the column with this index. A column that has not been used, or has been replaced, is whole.
        Cutting::Crack crackAt (std::int32_t index) const noexcept
        {
            const Column& c = all[static_cast<std::size_t> (index) % columns];
            return c.index == index ? c.crack : Cutting::Crack {};
        }

        /// The columns of a cut that does not exist are not looked at.
        void serialize (auto& archive)
        {
            archive (origin, direction, aside, width, used);
            if (width > 0.0) archive (all);
        }

    private:
        friend class CutPlaces;

        Vec3 origin = Vec3::Zero(), direction = Vec3::UnitX(), aside = Vec3::UnitY();
        double width = 0.0;   // 0: the cut does not exist
        std::int64_t used = 0;
        std::vector<Column> all = std::vector<Column> (columns);
    };

    /// The nearest cut whose plane contains the edge from a to b, to within the width of a column; null if there is none.
    Cut* find (const Vec3& a, const Vec3& b) noexcept
    {
        Cut* best = nullptr;
        double nearest = 0.0;
        for (Cut& cut : all)
        {
            const double far = std::max (cut.distance (a), cut.distance (b));
            const bool fits = cut.width > 0.0 && far <= cut.width && (b - a).norm() <= (longest + 1) * cut.width;
            if (! fits || (best && far >= nearest)) continue;
            best = &cut;
            nearest = far;
        }
        return best;
    }

    /// Begins a cut in whole material. The cut has no plane until place() is called.
    Cut& begin (double spacing) noexcept
    {
        Cut* oldest = &all.front();
        for (Cut& cut : all)
            if (cut.used < oldest->used) oldest = &cut;
        oldest->width = spacing;
        for (Column& c : oldest->all)
            c = {};
        return *oldest;
    }

    /// Moves a cut to another plane. `along` and `aside` are unit vectors in the surface, at right angles to each other.
    static void place (Cut& cut, const Vec3& origin, const Vec3& along, const Vec3& aside) noexcept
    {
        cut.origin = origin;
        cut.direction = along;
        cut.aside = aside;
    }

    static void forget (Cut& cut) noexcept
    {
        cut.width = 0.0;
        cut.used = 0;
    }

    void use (Cut& cut) noexcept { cut.used = ++time; }

    /// Copies all cuts, without allocating.
    void adopt (const CutPlaces& old) noexcept
    {
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = old.all[i];
        time = old.time;
    }

    std::size_t indexOf (const Cut& cut) const noexcept { return static_cast<std::size_t> (&cut - all.data()); }
    Cut& operator[] (std::size_t index) noexcept { return all[index]; }

    void serialize (auto& archive) { archive (all, time); }

private:
    std::vector<Cut> all = std::vector<Cut> (cuts);
    std::int64_t time = 0;
};

}   // namespace tactus
