// SPDX-License-Identifier: GPL-3.0-or-later
#include "stems.hpp"
#include "stem_files.hpp"
#include "stem_plan.hpp"

#include <host/base/platform/atomic_folder.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr std::size_t most_samples = 100'000'000;
}

struct Stems::Impl
{
    const Plan& plan;
    StemOptions options;
    StemPlan parts;
    int per_tick = 1;
    std::size_t frames = 0;

    Impl (const Plan& p, const StemOptions& o) : plan (p), options (o), parts (p)
    {
        for (const auto& tap : plan.taps())
            per_tick = std::max (per_tick, tap.per_tick);
    }

    void take()
    {
        for (auto& m : parts.mixers)
            m.tick (plan.nextTick() - 1);
        for (int i = 0; i < per_tick; ++i)
        {
            for (const auto& c : parts.channels)
            {
                double sum = 0.0;
                for (const auto& [tap, gain] : c.from)
                    sum += gain * tap->sample (i, per_tick);
                parts.stems[c.stem].channels[c.channel].push_back (static_cast<float> (sum));
            }
            for (const auto& l : parts.layers)
                for (std::size_t c = 0; c < parts.mixers[l.mixer].width; ++c)
                    parts.stems[l.stem].channels[c].push_back (static_cast<float> (parts.mixers[l.mixer].part (l.layer, c, i, per_tick)));
        }
        frames += static_cast<std::size_t> (per_tick);
    }

    double ownRate() const { return plan.rateHz() * per_tick; }
};

std::vector<std::string> Stems::portsOf (const plan::Flat& flat) { return stemPorts (flat); }

Stems::Stems (const Plan& run, const StemOptions& options) : impl (std::make_unique<Impl> (run, options)) {}
Stems::~Stems() = default;

Result<> Stems::frame()
{
    std::size_t width = 0;
    for (const auto& s : impl->parts.stems)
        width += s.channels.size();
    if ((impl->frames + static_cast<std::size_t> (impl->per_tick)) * width > most_samples)
        return Message::error ("stems/too_long", {}, "the stems of this run have more than " + std::to_string (most_samples) + " samples",
                               "render a shorter run");
    impl->take();
    return {};
}

Result<> Stems::check (const std::filesystem::path& folder) { return AtomicFolder::check (folder, list_of_stems); }

Result<WrittenStems> Stems::write (const std::filesystem::path& folder, const std::string& name)
{
    return writeStems ({ impl->parts.stems, impl->frames, impl->ownRate(), impl->parts.mixers }, impl->options, folder, name);
}

}   // namespace tactus::host
