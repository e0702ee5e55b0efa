// SPDX-License-Identifier: MIT
#include "caller_assets.hpp"

#include <tactus/file/assets/mesh.hpp>
#include <tactus/text/budget.hpp>

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

namespace tactus::capi
{

namespace
{
template <typename T>
bool sameBits (const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp (a.data(), b.data(), a.size() * sizeof (T)) == 0);
}

bool same (const Signal& a, const Signal& b) { return a.rate_hz == b.rate_hz && std::ranges::equal (a.channels, b.channels, sameBits<double>); }
bool same (const Grid& a, const Grid& b) { return a.rows == b.rows && a.columns == b.columns && sameBits (a.values, b.values); }
bool same (const Mesh& a, const Mesh& b) { return sameBits (a.points, b.points) && sameBits (a.triangles, b.triangles); }

Message unusable (const std::string& path, std::string what)
{
    return Message::error ("asset/supplied", path, std::move (what), "correct the program that supplies it");
}

/// Checks that rows and columns are there, and that there are not too many numbers.
Result<> checkSize (const tactus_asset& from, const std::string& path)
{
    if (from.values == nullptr || from.rows == 0 || from.columns == 0) return unusable (path, "the program supplies no numbers for it");
    const double numbers = static_cast<double> (from.rows) * static_cast<double> (from.columns);
    if (numbers <= budgets().numbers && numbers <= static_cast<double> (std::numeric_limits<int>::max())) return {};
    auto over = overBudget ("asset/supplied", &Budgets::numbers, "it", numbers, "supply fewer numbers");
    over.where = path;
    return over;
}

Result<Signal> takeSignal (const tactus_asset& from, const std::string& path)
{
    if (auto fits = checkSize (from, path); ! fits) return std::move (fits).error();
    Signal made { .rate_hz = from.rate_hz, .channels = std::vector<std::vector<double>> (from.columns) };
    for (std::size_t i = 0; i < from.rows * from.columns; ++i)
        made.channels[i % from.columns].push_back (from.values[i]);
    if (auto why = readers::whyUnusable (made, path)) return unusable (path, std::move (why->text));
    return made;
}

Result<Grid> takeGrid (const tactus_asset& from, const std::string& path)
{
    if (auto fits = checkSize (from, path); ! fits) return std::move (fits).error();
    Grid made { .rows = static_cast<int> (from.rows), .columns = static_cast<int> (from.columns), .values = {} };
    made.values.assign (from.values, from.values + from.rows * from.columns);
    if (! std::ranges::all_of (made.values, [] (double v) { return isFinite (v); })) return unusable (path, "it has numbers that are not finite");
    return made;
}

Result<Mesh> takeMesh (const tactus_asset& from, const std::string& path)
{
    if (from.points == nullptr || from.triangles == nullptr) return unusable (path, "the program supplies no points and triangles for it");
    return readers::meshOf (std::span (from.points, 3 * from.point_count), std::span (from.triangles, 3 * from.triangle_count), path);
}
}   // namespace

template <typename T, typename Take>
std::optional<Assets::Loaded<T>> CallerAssets::supplied (Cache<T>& cache, tactus_asset_kind kind, const std::string& path, Take take) const
{
    if (reader.read == nullptr) return {};
    tactus_asset asset {};
    asset.size = sizeof asset;
    const auto answer = reader.read (reader.context, kind, path.c_str(), &asset);
    if (answer == TACTUS_ASSET_FROM_FILE) return {};
    if (answer != TACTUS_ASSET_SUPPLIED) return unusable (path, asset.problem != nullptr ? asset.problem : "the program does not supply it");

    Result<T> fresh = take (asset, path);
    if (! fresh) return std::move (fresh).error();
    if (! readers::charge (*fresh)) return readers::overReading (path);
    std::erase_if (cache, [] (const auto& entry) { return entry.second.expired(); });
    if (const auto kept = cache.find (path); kept != cache.end())
        if (auto before = kept->second.lock(); before && same (*before, *fresh)) return before;
    auto content = std::make_shared<const T> (std::move (*fresh));
    cache[path] = content;
    return content;
}

Assets::Loaded<Signal> CallerAssets::signal (const std::string& path)
{
    if (auto mine = supplied (signals, TACTUS_ASSET_SIGNAL, path, takeSignal)) return *std::move (mine);
    return FileAssets::signal (path);
}

Assets::Loaded<Grid> CallerAssets::image (const std::string& path)
{
    if (auto mine = supplied (images, TACTUS_ASSET_IMAGE, path, takeGrid)) return *std::move (mine);
    return FileAssets::image (path);
}

Assets::Loaded<Grid> CallerAssets::table (const std::string& path)
{
    if (auto mine = supplied (tables, TACTUS_ASSET_TABLE, path, takeGrid)) return *std::move (mine);
    return FileAssets::table (path);
}

Assets::Loaded<Mesh> CallerAssets::mesh (const std::string& path)
{
    if (auto mine = supplied (meshes, TACTUS_ASSET_MESH, path, takeMesh)) return *std::move (mine);
    return FileAssets::mesh (path);
}

}   // namespace tactus::capi
