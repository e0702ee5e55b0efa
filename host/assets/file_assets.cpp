// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_assets.hpp"
#include "image.hpp"
#include "mesh.hpp"
#include "table.hpp"

#include <host/io/wav.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

/// Checks that the file exists, is a regular file and is not too large.
Result<> checkFile (const std::string& path)
{
    const auto fail = [] (std::string where, std::string text,
                          std::string remedy) { return Message::error ("asset/unreadable", std::move (where), std::move (text), std::move (remedy)); };
    std::error_code problem;
    if (path.find ('\0') != std::string::npos) return fail ({}, "the path contains a NUL", "check the path");
    const auto status = fs::status (path, problem);
    if (! fs::exists (status)) return fail (path, "there is no such file", "check the path, which is relative to the folder of the graph");
    if (! fs::is_regular_file (status))
        return fail (path, "it is a folder or a device, not a file", "check the path, which is relative to the folder of the graph");
    const auto size = static_cast<double> (fs::file_size (path, problem));
    if (! problem && size <= budgets().file) return {};
    auto over = overBudget ("asset/unreadable", &Budgets::file, "it", size, "make it smaller, for example by leaving out details that cannot be felt");
    over.where = path;
    return over;
}

Message overReading (const std::string& path)
{
    auto over = tactus::overReading ("asset/unreadable", "this file");
    over.where = path;
    return over;
}

/// The content of a file, parsed by a function that takes the bytes and the file name.
template <typename T>
auto fromBytes (Result<T> (*read) (std::string_view, std::string_view))
{
    return [read] (const std::string& path) -> Result<T> {
        auto bytes = readFile (path);
        if (bytes) return read (*bytes, path);
        auto why = std::move (bytes).error();
        return Message::error ("asset/unreadable", path, "it is not readable: " + why.text, why.remedy.empty() ? "check its permissions" : why.remedy);
    };
}

Result<Signal> readSignal (const std::string& path)
{
    std::error_code unknown;
    if (const auto size = fs::file_size (path, unknown); ! unknown) static_cast<void> (chargeReading (static_cast<double> (size)));
    auto signal = readWav (path);
    const auto fail = [&] (std::string what) { return Message::error ("asset/signal", path, std::move (what), "record or save it again"); };

    if (! signal) return signal;
    if (! (signal->rate_hz > 0.0)) return fail ("it has no sample rate");
    if (signal->channels.empty() || signal->channels.front().empty()) return fail ("it has no samples");
    for (const auto& channel : signal->channels)
        if (! std::ranges::all_of (channel, [] (double v) { return isFinite (v); }))
            return fail ("it has samples that are not finite numbers");
    return signal;
}

// How much the contents of a file add to the budget `reading`, in bytes.
double costOf (const Signal& s) { return 8.0 * static_cast<double> (s.channels.size() * s.channels.front().size()); }
double costOf (const Grid& g) { return 8.0 * static_cast<double> (g.values.size()); }
double costOf (const Mesh& m) { return 200.0 * static_cast<double> (m.points.size()); }

/// A file that could be read only in part may have taken as long as a large one.
constexpr double cost_of_a_failure = 8e6;
}   // namespace

template <typename T, typename Read>
Assets::Loaded<T> FileAssets::load (Cache<T>& cache, const std::string& path, Read read)
{
    if (auto fine = checkFile (path); ! fine) return std::move (fine).error();

    std::error_code problem;
    const auto written = fs::last_write_time (path, problem);
    const auto size = fs::file_size (path, problem);
    if (const auto kept = cache.find (path); kept != cache.end() && kept->second.written == written && kept->second.size == size)
        if (auto content = kept->second.content.lock()) return content;

    if (! chargeReading (0.0)) return overReading (path);
    auto fresh = read (path);
    const bool fits = chargeReading (fresh ? costOf (*fresh) : cost_of_a_failure);
    if (! fresh) return std::move (fresh).error();
    if (! fits) return overReading (path);
    auto content = std::make_shared<const T> (std::move (*fresh));
    std::erase_if (cache, [] (const auto& entry) { return entry.second.content.expired(); });
    cache[path] = { written, size, content };
    return content;
}

Assets::Loaded<Signal> FileAssets::signal (const std::string& path) { return load (signals, path, readSignal); }
Assets::Loaded<Grid> FileAssets::image (const std::string& path) { return load (images, path, fromBytes (readImage)); }
Assets::Loaded<Grid> FileAssets::table (const std::string& path) { return load (tables, path, fromBytes (readGrid)); }
Assets::Loaded<Mesh> FileAssets::mesh (const std::string& path) { return load (meshes, path, fromBytes (readMesh)); }

}   // namespace tactus::host
