// SPDX-License-Identifier: MIT
// Loads clips of 3 minutes with 1000 and 10 000 events, and ticks a clip at rest, so that callgrind can count (clip.py).
//
// Callgrind counts inside the functions `counted_…` and dumps after each `counted`, so its n-th dump belongs to the n-th line printed here.

#include <tactus/file/clips/clip_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/nodes/signal/clip.hpp>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

using namespace tactus;

namespace
{
constexpr double minutes_s = 180.0;
constexpr int ticks = 1000;

/// A clip of 3 minutes. Half of its events are points of the envelopes, the others are transients.
Clip clipWith (int events)
{
    Clip clip;
    auto& track = clip.tracks.emplace_back();
    const int each = events / 4;
    for (int i = 0; i < each; ++i)
    {
        const double t = minutes_s * i / (each - 1), level = 0.2 + 0.1 * (i % 7);
        track.amplitude.push_back ({ t, level });
        track.sharpness.push_back ({ t, 0.1 * (i % 11) });
    }
    for (int i = 0; i < 2 * each; ++i)
        track.taps.push_back ({ minutes_s * i / (2 * each), 0.9, 0.1 * (i % 11) });
    return clip;
}
}   // namespace

extern "C"
{
    // Callgrind finds these functions by name, so they must not be inlined.
    [[gnu::noinline]] void counted_load (const std::string& text, const std::string& name);
    [[gnu::noinline]] void counted_tick (const NodeType&, void* node, const double* const* sources, void* outputs) noexcept;
    [[gnu::noinline]] void counted() noexcept;

    void counted_load (const std::string& text, const std::string& name)
    {
        const auto read = readers::readClip (text, name);
        if (! read) std::abort();
        nodes::SignalClip node;
        node.settings.clip = { std::make_shared<const Grid> (gridOf (read->clip)) };
        if (! node.problem().empty()) std::abort();
        node.prepare ({ .rate_hz = 4000.0 });
    }

    void counted_tick (const NodeType& type, void* node, const double* const* sources, void* outputs) noexcept { type.tick (node, sources, outputs); }

    void counted() noexcept { asm volatile(""); }
}

namespace
{
void load (const char* format, int events)
{
    const auto name = std::string ("clip.") + format;
    const auto text = readers::writeClip (clipWith (events), name)->text;
    counted_load (text, name);
    std::printf ("load %s %d\n", format, events);
    counted();
}

/// Ticks a node whose inputs are 0.
void rest (const char* id)
{
    const auto* type = catalogue().find (id);
    if (type == nullptr) std::abort();
    const auto node = type->make();
    if (std::string_view (id) == "signal.clip")
        static_cast<nodes::SignalClip*> (node.get())->settings.clip = { std::make_shared<const Grid> (gridOf (clipWith (10'000))) };
    if (type->prepare) type->prepare (node.get(), { .rate_hz = 4000.0 });
    if (type->update) type->update (node.get());
    const double zero = 0.0;
    const std::vector<const double*> sources (16, &zero);
    const auto outputs = std::make_unique<std::byte[]> (type->outputs_size);
    type->initialiseOutputs (outputs.get());
    for (int i = 0; i < ticks; ++i)
        counted_tick (*type, node.get(), sources.data(), outputs.get());
    std::printf ("rest %s %d\n", id, ticks);
    counted();
}
}   // namespace

int main()
{
    for (const auto* format : { "haptic", "ahap", "hjif", "json" })
        for (const int events : { 1000, 10'000 })
            load (format, events);
    rest ("signal.clip");
    rest ("signal.constant");
}
