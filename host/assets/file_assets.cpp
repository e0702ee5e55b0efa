// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_assets.hpp"
#include "image.hpp"
#include "limits.hpp"
#include "mesh.hpp"
#include "table.hpp"

#include <host/io/wav.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

std::string sentence (const Error& e) { return e.where + ": " + e.what + "; " + e.remedy; }

/// Why the file is not even opened; empty if it may be.
std::string refusal (const std::string& path)
{
    std::error_code problem;
    if (path.find ('\0') != std::string::npos) return "a path has no NUL in it; check the path";
    const auto status = fs::status (path, problem);
    if (! fs::exists (status)) return path + ": there is no such file; check the path, which starts at the folder of the graph";
    if (! fs::is_regular_file (status)) return path + ": it is a folder or a device, not a file; check the path, which starts at the folder of the graph";
    if (const auto size = fs::file_size (path, problem); problem || size > most_bytes)
        return path + ": it has more than " + std::to_string (most_bytes >> 20) + " MB; make it smaller, as by leaving out what cannot be felt";
    return {};
}

/// The content of a file, from a function that takes bytes and a name.
template <typename T>
auto fromBytes (tl::expected<T, Error> (*read) (std::string_view, std::string_view))
{
    return [read] (const std::string& path) -> tl::expected<T, Error>
    {
        std::ifstream in (path, std::ios::binary);
        const std::string bytes { std::istreambuf_iterator<char> (in), {} };
        if (! in) return tl::unexpected (Error { .id = "asset/unreadable", .where = path, .what = "it may not be read", .remedy = "check its permissions" });
        return read (bytes, path);
    };
}

tl::expected<Signal, Error> readSignal (const std::string& path)
{
    auto signal = readWav (path);
    const auto fail = [&] (std::string what)
    { return tl::unexpected (Error { .id = "asset/signal", .where = path, .what = std::move (what), .remedy = "record or save it anew" }); };

    if (! signal) return signal;
    if (! (signal->rate_hz > 0.0)) return fail ("it has no sample rate");
    if (signal->channels.empty() || signal->channels.front().empty()) return fail ("there are no samples in it");
    for (const auto& channel : signal->channels)
        if (! std::ranges::all_of (channel, [] (double v)
                                   { return isFinite (v); }))
            return fail ("it has samples that are not finite numbers");
    return signal;
}
}   // namespace

template <typename T, typename Read>
Assets::Loaded<T> FileAssets::load (Cache<T>& cache, const std::string& path, Read read)
{
    if (auto why = refusal (path); ! why.empty()) return why;

    std::error_code problem;
    const auto written = fs::last_write_time (path, problem);
    const auto size = fs::file_size (path, problem);
    if (const auto kept = cache.find (path); kept != cache.end() && kept->second.written == written && kept->second.size == size)
        if (auto content = kept->second.content.lock()) return content;

    auto fresh = read (path);
    if (! fresh) return sentence (fresh.error());
    auto content = std::make_shared<const T> (std::move (*fresh));
    std::erase_if (cache, [] (const auto& entry)
                   { return entry.second.content.expired(); });
    cache[path] = { written, size, content };
    return content;
}

Assets::Loaded<Signal> FileAssets::signal (const std::string& path) { return load (signals, path, readSignal); }
Assets::Loaded<Grid> FileAssets::image (const std::string& path) { return load (images, path, fromBytes (readImage)); }
Assets::Loaded<Grid> FileAssets::table (const std::string& path) { return load (tables, path, fromBytes (readGrid)); }
Assets::Loaded<Mesh> FileAssets::mesh (const std::string& path) { return load (meshes, path, fromBytes (readMesh)); }

}   // namespace tactus::host
