// SPDX-License-Identifier: MIT
#include "stretch_files.hpp"

#include <tactus/file/clips/clip_signal.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/text/list_text.hpp>

#include <algorithm>

namespace tactus::host
{

Clip clipOfStretch (const Stretch& stretch, Messages& notes)
{
    Signal signal { .rate_hz = stretch.rate_hz, .channels = {} };
    for (std::size_t i = 0; i < stretch.names.size(); ++i)
    {
        auto& samples = signal.channels.emplace_back();
        samples.reserve (stretch.ticks());
        for (std::size_t k = 0; k < stretch.ticks(); ++k)
            samples.push_back (stretch.value (k, i));
    }
    auto clip = readers::clipOfSignal (signal, notes);
    std::string names;
    for (const auto& name : stretch.names)
        addToList (names, name);
    clip.notes.emplace_back ("description", names);
    return clip;
}

Result<> saveMovement (const Stretch& stretch, const std::filesystem::path& path)
{
    if (stretch.columns.empty())
        return Message::error ("take/no_movement", path.string(), "there is no movement: the run has no role", "record a graph that uses a device");
    auto file = TableWriter::create (path, stretch.columns);
    if (! file) return file.error();
    const auto width = stretch.columns.size();
    for (std::size_t k = 0; k < stretch.ticks(); ++k)
        if (auto written = file->row (std::span (stretch.movement).subspan (k * width, width)); ! written) return written.error();
    return file->commit();
}

}   // namespace tactus::host
