// SPDX-License-Identifier: GPL-3.0-or-later
#include "energy_meter.hpp"

#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tactus::host
{

namespace
{
std::shared_ptr<Trace> traceOf (const char* name, double rate)
{
    return std::make_shared<Trace> (Tap { .name = name, .quantity = Quantity::energy, .unit = "J" }, rate);
}

/// The value at a tick; nan if there is none.
double at (const Trace& t, std::uint64_t tick) { return tick >= t.begin() && tick < t.end() ? t.at (tick) : std::nan (""); }

/// The sum at a tick; nan if a value is missing.
double sumAt (const TraceList& traces, std::uint64_t tick)
{
    double sum = 0.0;
    for (const auto& t : traces)
        sum += at (*t, tick);
    return sum;
}

std::array<double, 3> vectorAt (const TraceList& traces, std::uint64_t tick) { return { at (*traces[0], tick), at (*traces[1], tick), at (*traces[2], tick) }; }

bool isWhole (const std::array<double, 3>& v) { return std::isfinite (v[0]) && std::isfinite (v[1]) && std::isfinite (v[2]); }
}   // namespace

void EnergyMeter::restart()
{
    now = {};
    shown.clear();
    is_reset = true;
}

void EnergyMeter::begin (const Sources& s)
{
    now = {};
    const double rate = s.position.front()->rate();
    work = traceOf ("work of the hand", rate);
    stored = traceOf ("stored", rate);
    dissipated = traceOf ("dissipated", rate);
    shown = { work, stored, dissipated };
    has_last = was_gap = false;
    last_step = {};
    const auto& reference = *s.position.front();
    const bool is_same_run = ! read.position.empty() && read.position.front().get() == &reference && begun == reference.beginnings();
    begun = reference.beginnings();
    first = is_same_run ? next : 0;
    for (const auto* list : { &s.position, &s.applied, &s.stored, &s.dissipated })
        for (const auto& t : *list)
            first = std::max (first, is_reset ? t->end() : t->begin());
    const auto late = static_cast<std::uint64_t> (std::ceil (s.late));
    for (const auto& t : s.applied)
        first = std::max (first, t->begin() + late);   // the force that acts then has to be known
    now.late = s.late;
    next = first;
    read = s;
    lost.assign (s.dissipated.size(), std::nan (""));
    kept = 0.0;
    is_reset = false;
}

void EnergyMeter::follow (const Sources& s)
{
    if (s.position.size() != 3 || s.applied.size() != 3) return;
    const auto& reference = *s.position.front();
    if (is_reset || s.position != read.position || s.applied != read.applied || s.late != read.late || reference.beginnings() != begun
        || reference.begin() > next)   // ticks that are no longer stored are lost
        begin (s);
    readOn();   // what nodes that are gone have left
    takeNodes (s);
    readOn();
}

void EnergyMeter::readOn()
{
    auto end = read.position.front()->end();
    for (const auto* list : { &read.position, &read.applied, &read.stored, &read.dissipated })
        for (const auto& t : *list)
            end = std::min (end, t->end());
    for (; next < end; ++next)
        add (vectorAt (read.position, next), vectorAt (read.applied, next), actingAt (next), sumAt (read.stored, next));
}

/// The force that acts on the tool until a tick: that of `late` ticks before, or between two ticks.
EnergyMeter::Vector EnergyMeter::actingAt (std::uint64_t tick) const
{
    const double whole = std::floor (read.late), part = read.late - whole;
    const auto to = tick - static_cast<std::uint64_t> (whole);
    auto f = vectorAt (read.applied, to);
    if (part > 0.0)
        for (std::size_t i = 0; i < 3; ++i)
            f[i] += part * (vectorAt (read.applied, to - 1)[i] - f[i]);
    return f;
}

void EnergyMeter::takeNodes (const Sources& s)
{
    std::vector<double> of_these (s.dissipated.size(), std::nan (""));
    for (std::size_t i = 0; i < read.dissipated.size(); ++i)
    {
        const auto same = std::ranges::find (s.dissipated, read.dissipated[i]);
        if (same != s.dissipated.end())
            of_these[static_cast<std::size_t> (same - s.dissipated.begin())] = lost[i];
        else if (std::isfinite (lost[i]))
            kept += lost[i];
    }
    lost = std::move (of_these);
    read = s;
}

/// The energy dissipated since the first tick. A node that is new counts from its first value on; one that is bypassed or replaced falls to 0, and what it
/// has dissipated before stays in the sum.
double EnergyMeter::dissipatedAt (std::uint64_t tick)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < lost.size(); ++i)
    {
        const double value = at (*read.dissipated[i], tick);
        if (! std::isfinite (value)) return value;
        if (std::isnan (lost[i]))
            kept -= value;
        else if (value == 0.0)
            kept += lost[i];
        lost[i] = value;
        sum += value;
    }
    return sum + kept;
}

void EnergyMeter::add (const Vector& p, const Vector& f, const Vector& acting, double in)
{
    const double heat = isWhole (p) && isWhole (f) && isWhole (acting) && std::isfinite (in) ? dissipatedAt (next) : std::nan ("");
    if (! std::isfinite (heat))
    {
        now.gaps += has_last;
        was_gap = true;
        last_step = {};
        return;
    }
    if (has_last)
    {
        double step = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
        {
            // The force at the end of the previous step is known only now. With it, this adds the work of a continuous force (the trapezoid
            // rule) minus the work of the force that was held, and late.
            if (! was_gap) now.held -= (0.5 * (f[i] + last_force[i]) - last_acting[i]) * last_step[i];
            last_step[i] = p[i] - last[i];
            step -= (was_gap ? 0.5 * (acting[i] + last_acting[i]) : acting[i]) * last_step[i];
        }
        now.work += step;
        now.moved += std::abs (step);
        now.worst = std::min (now.worst, now.work);
    }
    else
        now.stored_first = in;
    now.stored = in;
    now.dissipated = heat;
    now.seconds = static_cast<double> (next - first + 1) / work->rate();
    has_last = true;
    was_gap = false;
    last = p;
    last_force = f;
    last_acting = acting;
    work->add (next, now.work);
    stored->add (next, in - now.stored_first);
    dissipated->add (next, now.dissipated);
}

std::string describe (const EnergyBalance& b)
{
    const auto joule = [] (double v) {
        auto text = v == 0.0 ? std::string ("0 J") : withPrefix (v, "J", 2);
        const auto gap = text.find (' ');
        return gap == std::string::npos ? text : text.replace (gap, 1, "\u00a0");   // keeps the number and its unit on one line
    };
    const auto matters = [&] (double v, double share) { return v > share * b.moved && v > 1e-7; };
    const auto kind = b.isPassive() ? TRANS ("passive over %5: work of the hand %1, %2 stored, %3 dissipated")
                                    : TRANS ("active over %5, without the damping of the device: at one moment, %4 more had come out than had gone in; by now, "
                                             "work of the hand %1, %2 stored, %3 dissipated");
    auto text = filled (kind, joule (b.work), joule (b.stored), joule (b.dissipated), joule (-b.worst - b.stored_first),
                        (b.seconds < 10.0 ? juce::String (b.seconds, 1) : juce::String (juce::roundToInt (b.seconds))) + juce::String::fromUTF8 ("\u00a0s"));
    if (matters (b.held, 0.01))
        text << "; "
             << filled (b.late > 0.0 ? TRANS ("the delay of the device and holding the force between ticks created %1")
                                     : TRANS ("holding the force between ticks created %1"),
                        joule (b.held));
    if (matters (b.elsewhere(), 0.02)) text << ", " << filled (TRANS ("%1 unaccounted for"), joule (b.elsewhere()));
    if (matters (-b.elsewhere(), 0.02))
        text << "; "
             << filled (TRANS ("the nodes report %1 more than the hand gave: their force was turned down, as by a mixer, limited or faded, or the tool or its "
                               "sensor moves too far in a tick"),
                        joule (-b.elsewhere()));
    return text.toStdString();
}

}   // namespace tactus::host
