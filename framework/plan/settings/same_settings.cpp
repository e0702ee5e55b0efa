// SPDX-License-Identifier: MIT
#include "same_settings.hpp"

#include <tactus/kit/geometry/surface.hpp>

#include <algorithm>

namespace tactus::plan
{

namespace
{
/// Structured bindings take types apart, so adding a member without comparing it does not compile.
struct Same
{
    template <typename T>
    bool operator() (const T& a, const T& b) const
    {
        return a == b;
    }

    template <typename T>
    bool operator() (const std::vector<T>& a, const std::vector<T>& b) const
    {
        return std::ranges::equal (a, b, *this);
    }

    template <typename T>
    bool operator() (const std::shared_ptr<const T>& a, const std::shared_ptr<const T>& b) const
    {
        return a == b || (a && b && (*this) (*a, *b));
    }

    bool operator() (const Signal& a, const Signal& b) const
    {
        const auto& [rate_hz, channels] = a;
        return rate_hz == b.rate_hz && channels == b.channels;
    }

    bool operator() (const Grid& a, const Grid& b) const
    {
        const auto& [rows, columns, values] = a;
        return rows == b.rows && columns == b.columns && values == b.values;
    }

    bool operator() (const Image& a, const Image& b) const { return (*this) (a.grid, b.grid); }
    bool operator() (const Sheet& a, const Sheet& b) const { return (*this) (a.grid, b.grid); }

    bool operator() (const Mesh& a, const Mesh& b) const
    {
        const auto& [points, triangles] = a;
        return points == b.points && triangles == b.triangles;
    }

    bool operator() (const Ratio& a, const Ratio& b) const
    {
        const auto& [number, law, curve] = a;
        return number == b.number && law == b.law && curve == b.curve;
    }

    bool operator() (const Surface& a, const Surface& b) const
    {
        const auto& [mesh, frames, curves, mu, weights] = a;
        return (*this) (mesh, b.mesh) && frames == b.frames && curves == b.curves && (*this) (mu, b.mu) && weights == b.weights;
    }

    bool operator() (const SettingValue& a, const SettingValue& b) const
    {
        const auto compare = [&] (const auto& x) { return (*this) (x, std::get<std::remove_cvref_t<decltype (x)>> (b)); };
        return a.index() == b.index() && std::visit (compare, static_cast<const SettingValue::variant&> (a));
    }
};
}   // namespace

bool same (const Values& a, const Values& b) { return Same {}(a, b); }

}   // namespace tactus::plan
