// SPDX-License-Identifier: MIT
#include "file_assets.hpp"
#include "mesh.hpp"
#include "table.hpp"

#include <tactus/file/clips/clip_file.hpp>
#include <tactus/file/clips/clip_signal.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>

#include <algorithm>
#include <utility>

namespace tactus::readers
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

/// The content of a file, parsed by a function that takes the bytes and the file name.
template <typename T, typename Parse>
Result<T> fromBytes (const std::string& path, Parse parse)
{
    auto bytes = readFile (path);
    if (bytes) return parse (*bytes, path);
    auto why = std::move (bytes).error();
    return Message::error ("asset/unreadable", path, "it is not readable: " + why.text, why.remedy.empty() ? "check its permissions" : why.remedy);
}

Message noDecoder (std::string_view path, const char* kind)
{
    return Message::error ("asset/no_decoder", std::string (path), std::string ("this program has no decoder for ") + kind,
                           "let the program supply the numbers in it (docs/library.md), or play the graph with `tactus` or `tactus-host`");
}

bool isWave (std::string_view path)
{
    std::string extension (path.substr (std::min (path.rfind ('.'), path.size())));
    std::ranges::transform (extension, extension.begin(), [] (char c) { return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c; });
    return extension == ".wav";
}

/// A file that could be read only in part may have taken as long as a large one.
constexpr double cost_of_a_failure = 8e6;
}   // namespace

bool charge (const Signal& s) noexcept { return chargeReading (8.0 * static_cast<double> (s.channels.size() * s.channels.front().size())); }
bool charge (const Grid& g) noexcept { return chargeReading (8.0 * static_cast<double> (g.values.size())); }
bool charge (const Mesh& m) noexcept { return chargeReading (200.0 * static_cast<double> (m.points.size())); }

Message overReading (const std::string& path)
{
    auto over = tactus::overReading ("asset/unreadable", "this file");
    over.where = path;
    return over;
}

std::optional<Message> whyUnusable (const Signal& signal, const std::string& path)
{
    const auto fail = [&] (std::string what) { return Message::error ("asset/signal", path, std::move (what), "record or save it again"); };
    if (! (signal.rate_hz > 0.0) || ! isFinite (signal.rate_hz)) return fail ("it has no sample rate");
    if (signal.channels.empty() || signal.channels.front().empty()) return fail ("it has no samples");
    for (const auto& channel : signal.channels)
    {
        if (channel.size() != signal.channels.front().size()) return fail ("its channels differ in length");
        if (! std::ranges::all_of (channel, [] (double v) { return isFinite (v); })) return fail ("it has samples that are not finite numbers");
    }
    return {};
}

void FileAssets::adopt (const FileAssets& others)
{
    const auto take = [] (auto& cache, const auto& read) {
        for (const auto& [path, kept] : read)
            cache.insert_or_assign (path, kept);
    };
    take (signals, others.signals);
    take (images, others.images);
    take (tables, others.tables);
    take (meshes, others.meshes);
}

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
    auto fresh = read();
    const bool fits = fresh ? charge (*fresh) : chargeReading (cost_of_a_failure);
    if (! fresh) return std::move (fresh).error();
    if (! fits) return overReading (path);
    auto content = std::make_shared<const T> (std::move (*fresh));
    std::erase_if (cache, [] (const auto& entry) { return entry.second.content.expired(); });
    cache[path] = { written, size, content };
    return content;
}

Assets::Loaded<Signal> FileAssets::signal (const std::string& path)
{
    return load (signals, path,
                 [&]() -> Result<Signal> {
                     std::error_code unknown;
                     if (const auto size = fs::file_size (path, unknown); ! unknown) static_cast<void> (chargeReading (static_cast<double> (size)));
                     auto signal = readSignal (path);
                     if (! signal) return signal;
                     if (auto why = whyUnusable (*signal, path)) return *std::move (why);
                     return signal;
                 });
}

Assets::Loaded<Grid> FileAssets::image (const std::string& path)
{
    const auto decode = [this] (std::string_view bytes, std::string_view name) { return readImage (bytes, name); };
    return load (images, path, [&] { return fromBytes<Grid> (path, decode); });
}

Assets::Loaded<Grid> FileAssets::table (const std::string& path)
{
    if (isWave (path)) return load (tables, path, [&] { return readWave (path); });
    const auto parse = [] (std::string_view bytes, std::string_view name) -> Result<Grid> {
        if (! isClipName (name)) return readGrid (bytes, name);
        auto file = readClip (bytes, name);
        if (! file) return std::move (file).error();
        return gridOf (file->clip);
    };
    return load (tables, path, [&] { return fromBytes<Grid> (path, parse); });
}

/// Converts a recording to a clip of waves, as a table with a row for each sample.
Result<Grid> FileAssets::readWave (const std::string& path)
{
    auto signal = readSignal (path);
    if (! signal) return std::move (signal).error();
    if (auto why = whyUnusable (*signal, path)) return *std::move (why);
    const double numbers = static_cast<double> (clip_columns * signal->channels.size() * signal->channels.front().size());
    if (numbers > budgets().numbers)
    {
        auto over = overBudget ("table/too_large", &Budgets::numbers, "the recording as a clip", numbers, "shorten it, or convert it with `tactus convert`");
        over.where = path;
        return over;
    }
    Messages notes;
    const auto clip = clipOfSignal (*signal, notes);
    if (! notes.empty())
        return Message::error ("clip/range", path, notes.front().text.starts_with ("the values") ? "it has samples outside -1 to 1" : notes.front().text,
                               "convert it with `tactus convert`, which reports what changes");
    return gridOf (clip);
}

Assets::Loaded<Mesh> FileAssets::mesh (const std::string& path)
{
    return load (meshes, path, [&] { return fromBytes<Mesh> (path, readMesh); });
}

Result<Signal> FileAssets::readSignal (const std::string& path) { return noDecoder (path, "recordings"); }
Result<Grid> FileAssets::readImage (std::string_view, std::string_view path) { return noDecoder (path, "pictures"); }

}   // namespace tactus::readers
