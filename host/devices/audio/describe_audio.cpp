// SPDX-License-Identifier: MIT
#include "audio_rig.hpp"

#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <cstdio>

namespace tactus::host::audio
{
namespace
{
template <typename... Args>
std::string text (const char* format, Args... args)
{
    char line[256];
    std::snprintf (line, sizeof line, format, args...);
    return line;
}

std::string times (std::uint64_t n) { return std::to_string (n) + (n == 1 ? " time" : " times"); }

/// Sound cards and servers choose their names.
std::string nameOf (const AudioStatus& s) { return printableName (s.card.type + ":" + s.card.name); }
}   // namespace

std::string statusOf (const AudioStatus& s)
{
    if (s.card.type.empty()) return {};
    if (! s.is_open) return "   " + nameOf (s) + " is disconnected" + (s.by_timer ? "; the timer ticks the run, with all forces at zero" : "");
    auto line = text ("   sound %+.0f ppm, %+.2f ms, xruns %zu", 1e6 * (s.ratio - 1.0), 1e3 * s.out.error_s, static_cast<std::size_t> (s.xruns));
    if (s.clipped > 0) line += ", clipped " + std::to_string (s.clipped);
    if (s.out.underruns > 0) line += ", ran dry " + times (s.out.underruns);
    return line;
}

std::string accountOf (const AudioStatus& s)
{
    if (s.card.type.empty()) return {};
    const double ms = 1e3;
    auto account = nameOf (s) + ": " + numberText (s.card.rate_hz) + " Hz, blocks of " + std::to_string (s.card.block) + ", "
                   + std::to_string (s.card.outputs) + " outputs, " + std::to_string (s.card.inputs) + " inputs; " + std::to_string (s.blocks)
                   + " blocks, xruns " + std::to_string (s.xruns) + ", late blocks " + std::to_string (s.late_blocks) + "\n";
    account += text ("    ratio of the card's clock to the tick clock: %.6f (%+.1f ppm), error %+.3f ms; latency %.2f ms, plus %.2f ms in the card\n", s.ratio,
                     1e6 * (s.ratio - 1.0), ms * s.out.error_s, ms * s.out.latency_s, ms * s.card.latency_s);
    account +=
        "    clipped " + std::to_string (s.clipped) + " samples, ran dry " + times (s.out.underruns) + ", skipped samples " + times (s.out.overruns) + "\n";
    if (s.card.inputs > 0)
        account += text ("    input latency %.2f ms, error %+.3f ms, ran dry %zu times\n", ms * s.in.latency_s, ms * s.in.error_s,
                         static_cast<std::size_t> (s.in.underruns));
    if (s.not_numbers > 0) account += "    " + std::to_string (s.not_numbers) + " samples of routes were not numbers and were played as 0\n";
    if (s.departures > 0)
        account += "    the card went away " + times (s.departures)
                   + (s.is_open || s.trouble.empty() ? "" : ", and is still disconnected: " + printableName (s.trouble)) + "\n";
    if (s.ticks_by_timer > 0)
        account += "    " + std::to_string (s.ticks_by_timer) + " ticks came from the timer because the card delivered no blocks; all forces were zero\n";
    return account;
}

}   // namespace tactus::host::audio
