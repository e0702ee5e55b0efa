// SPDX-License-Identifier: MIT
#include "wiring_writer.hpp"

// As in fused_sections.cpp, the values in a section are all in memory.

namespace tactus::host
{

void WiringWriter::latch (const Links& links)
{
    for (const auto& [from, converter] : links)
        store ("double", read (from), object (&converter->out, "double"));
}

void WiringWriter::silence (const Links& links)
{
    for (const auto& [from, converter] : links)
        store ("double", "0.0", object (&converter->out, "double"));
}

void WiringWriter::gather (const Links& links)
{
    for (const auto& [from, converter] : links)
    {
        const auto value = read (from), to = object (&converter->gathered, "double");
        store ("double", result ("fadd double " + load ("double", to) + ", " + value), to);
    }
}

void WiringWriter::deliver (const Links& links)
{
    for (const auto& [from, converter] : links)
        run ("tactus_fused_deliver", { "double* " + object (&converter->out, "double"), "double* " + object (&converter->gathered, "double") });
}

void WiringWriter::head (const Links& links)
{
    for (const auto& [from, c] : links)
        run ("tactus_fused_head", { "double " + read (from), "double* " + object (&c->before, "double"), "double* " + object (&c->newest, "double"),
                                    "i8* " + object (&c->begun) });
}

void WiringWriter::follow (const Links& links, const std::string& part)
{
    for (const auto& [from, c] : links)
    {
        const auto now = read (from), before = object (&c->before, "double"), newest = object (&c->newest, "double"), begun = object (&c->begun);
        const auto value = called ("double", "tactus_fused_follow",
                                   { "double " + now, "double* " + before, "double* " + newest, "i8* " + begun, "double " + part });
        store ("double", value, object (&c->out, "double"));
    }
}

void WiringWriter::every (const plan::RunningSection& s)
{
    const auto factor = std::to_string (s.factor), runs = label(), then = label();
    gather (s.gathers);
    const auto around = load ("i64", object (s.around, "i64")), phase = result ("urem i64 " + around + ", " + factor);
    const auto is_on = result ("icmp eq i64 " + phase + ", 0");
    branch (is_on, runs, then);
    startBlock (runs);
    values.openScope();
    store ("i64", result ("udiv i64 " + around + ", " + factor), object (&s.number, "i64"));
    latch (s.latches);
    deliver (s.gathers);
    records (s.records, true);
    head (s.lines);
    latch (s.pulses);
    values.closeScope();
    jump (then);
    startBlock (then);
    if (! s.lines.empty())
        follow (s.lines, result ("fdiv double " + result ("uitofp i64 " + phase + " to double") + ", " + exactly (static_cast<double> (s.factor))));
    if (s.pulses.empty()) return;
    const auto rests = label(), end = label();
    branch (is_on, end, rests);
    startBlock (rests);
    silence (s.pulses);
    jump (end);
    startBlock (end);
}

void WiringWriter::times (const plan::RunningSection& s)
{
    const auto factor = std::to_string (s.factor), again = label(), end = label();
    head (s.lines);
    latch (s.pulses);
    const auto count = room ("i64");
    store ("i64", "0", count);
    jump (again);
    startBlock (again);
    values.openScope();
    const auto i = load ("i64", count), next = result ("add i64 " + i + ", 1");
    store ("i64", next, count);
    const auto before = result ("mul i64 " + load ("i64", object (s.around, "i64")) + ", " + factor), number = result ("add i64 " + before + ", " + i);
    store ("i64", number, object (&s.number, "i64"));
    if (! s.lines.empty())
        follow (s.lines, result ("fdiv double " + result ("uitofp i64 " + next + " to double") + ", " + exactly (static_cast<double> (s.factor))));
    if (! s.pulses.empty())
    {
        const auto second = label(), others = label();
        branch (result ("icmp eq i64 " + i + ", 1"), second, others);
        startBlock (second);
        silence (s.pulses);
        jump (others);
        startBlock (others);
    }
    records (s.records, true);
    gather (s.gathers);
    for (const auto& tap : s.samples)
    {
        const auto at = result ("urem i64 " + number + ", " + std::to_string (tap.per_tick)), value = read (tap.from);
        store ("double", value, result ("getelementptr inbounds double, double* " + object (tap.to, "double") + ", i64 " + at));
    }
    values.closeScope();
    branch (result ("icmp ult i64 " + next + ", " + factor), again, end);
    startBlock (end);
    deliver (s.gathers);
}

}   // namespace tactus::host
