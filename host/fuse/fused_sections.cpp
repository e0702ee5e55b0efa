// SPDX-License-Identifier: MIT
#include "code_writer.hpp"

#include <host/generate/sources/code.hpp>

// The values in a section are all in memory, because outside of it, and on ticks on which it does not run, they keep their last value.

namespace tactus::host
{

void CodeWriter::latch (const Links& links)
{
    for (const auto& [from, converter] : links)
        line (value (&converter->out) + " = " + read (from) + ";");
}

void CodeWriter::silence (const Links& links)
{
    for (const auto& [from, converter] : links)
        line (value (&converter->out) + " = 0.0;");
}

void CodeWriter::gather (const Links& links)
{
    for (const auto& [from, converter] : links)
        line (value (&converter->gathered) + " += " + read (from) + ";");
}

void CodeWriter::deliver (const Links& links)
{
    for (const auto& [from, converter] : links)
        line ("tactus::fused::deliver (" + value (&converter->out) + ", " + value (&converter->gathered) + ");");
}

void CodeWriter::head (const Links& links)
{
    for (const auto& [from, c] : links)
        line ("tactus::fused::head (" + read (from) + ", " + value (&c->before) + ", " + value (&c->newest) + ", p.as<bool> ("
              + values.number (&c->begun) + "));");
}

void CodeWriter::follow (const Links& links)
{
    for (const auto& [from, c] : links)
        line (value (&c->out) + " = tactus::fused::follow (" + read (from) + ", " + value (&c->before) + ", " + value (&c->newest)
              + ", p.as<bool> (" + values.number (&c->begun) + "), part);");
}

void CodeWriter::every (const plan::RunningSection& s)
{
    const auto factor = std::to_string (s.factor);
    const Block section { *this, "// A section that runs on every tick of " + factor };
    gather (s.gathers);
    line ("const auto phase = " + ticks (s.around) + " % " + factor + "u;");
    {
        const Block running { *this, "if (phase == 0)" };
        line (ticks (&s.number) + " = " + ticks (s.around) + " / " + factor + "u;");
        latch (s.latches);
        deliver (s.gathers);
        records (s.records, true);
        head (s.lines);
        latch (s.pulses);
    }
    if (! s.lines.empty()) line ("const double part = static_cast<double> (phase) / " + literal (static_cast<double> (s.factor)) + ";");
    follow (s.lines);
    if (s.pulses.empty()) return;
    const Block resting { *this, "if (phase != 0)" };
    silence (s.pulses);
}

void CodeWriter::times (const plan::RunningSection& s)
{
    const auto factor = std::to_string (s.factor);
    const Block section { *this, "// A section that runs " + factor + " times a tick" };
    head (s.lines);
    latch (s.pulses);
    const auto i = fresh ("i");
    {
        const Block running { *this, "for (std::uint64_t " + i + " = 0; " + i + " < " + factor + "u; ++" + i + ")" };
        line (ticks (&s.number) + " = " + ticks (s.around) + " * " + factor + "u + " + i + ";");
        if (! s.lines.empty()) line ("const double part = static_cast<double> (" + i + " + 1) / " + literal (static_cast<double> (s.factor)) + ";");
        follow (s.lines);
        if (! s.pulses.empty())
        {
            const Block later { *this, "if (" + i + " == 1)" };
            silence (s.pulses);
        }
        records (s.records, true);
        gather (s.gathers);
        for (const auto& tap : s.samples)
            line ("(&" + value (tap.to) + ")[" + ticks (&s.number) + " % " + std::to_string (tap.per_tick) + "u] = " + read (tap.from) + ";");
    }
    deliver (s.gathers);
}

}   // namespace tactus::host
