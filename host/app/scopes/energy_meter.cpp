// SPDX-License-Identifier: GPL-3.0-or-later
#include "energy_meter.hpp"

#include <host/app/model/with_prefix.hpp>

#include <cmath>
#include <cstdio>

namespace tactus::host
{

namespace
{
std::shared_ptr<Trace> traceOf (const char* name, double rate) { return std::make_shared<Trace> (Tap { .name = name, .quantity = Quantity::energy, .unit = "J" }, rate); }

/// The sum of what stands there on a tick; nan if one of it is missing.
double sumAt (const TraceList& traces, std::uint64_t tick)
{
    double sum = 0.0;
    for (const auto& t : traces)
        sum += tick >= t->begin() && tick < t->end() ? t->at (tick) : std::nan ("");
    return sum;
}

double at (const TraceList& traces, std::size_t i, std::uint64_t tick) { return tick >= traces[i]->begin() && tick < traces[i]->end() ? traces[i]->at (tick) : std::nan (""); }
}   // namespace

void EnergyMeter::restart()
{
    now = {};
    looked_at.clear();
    shown.clear();
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
    next = s.position.front()->begin();
    for (const auto* list : { &s.position, &s.applied, &s.stored, &s.dissipated })
        for (const auto& t : *list)
            next = std::max (next, t->begin());
}

void EnergyMeter::follow (const Sources& s)
{
    if (s.position.size() != 3 || s.applied.size() != 3) return;
    TraceList all;
    for (const auto* list : { &s.position, &s.applied, &s.stored, &s.dissipated })
        all.insert (all.end(), list->begin(), list->end());
    auto end = all.front()->end();
    for (const auto& t : all)
        end = std::min (end, t->end());
    if (all != looked_at || all.front()->begin() > next)   // what is not held any more is lost
    {
        begin (s);
        looked_at = std::move (all);
    }

    for (; next < end; ++next)
    {
        std::array<double, 3> p {}, f {};
        bool is_whole = true;
        for (std::size_t i = 0; i < 3; ++i)
        {
            p[i] = at (s.position, i, next);
            f[i] = at (s.applied, i, next);
            is_whole = is_whole && std::isfinite (p[i]) && std::isfinite (f[i]);
        }
        const double in = sumAt (s.stored, next), lost = sumAt (s.dissipated, next);
        if (! is_whole || ! std::isfinite (in) || ! std::isfinite (lost))
        {
            now.gaps += has_last;
            was_gap = true;
            last_step = {};
            continue;
        }
        if (has_last)
        {
            double step = 0.0;
            for (std::size_t i = 0; i < 3; ++i)
            {
                // The force at the end of the step before is known only now: by it the trapezoid differs from what was held.
                if (! was_gap) now.held -= 0.5 * (f[i] - last_force[i]) * last_step[i];
                last_step[i] = p[i] - last[i];
                step -= (was_gap ? 0.5 * (f[i] + last_force[i]) : f[i]) * last_step[i];
            }
            now.work += step;
            now.moved += std::abs (step);
            now.worst = std::min (now.worst, now.work);
        }
        else
        {
            now.stored_first = in;
            lost_first = lost;
        }
        now.stored = in;
        now.dissipated = lost - lost_first;
        has_last = true;
        was_gap = false;
        last = p;
        last_force = f;
        work->add (next, now.work);
        stored->add (next, in - now.stored_first);
        dissipated->add (next, now.dissipated);
    }
}

std::string inWords (const EnergyBalance& b)
{
    const auto joule = [] (double v)
    {
        auto text = withPrefix (v, "J", 2);
        const auto gap = text.find (' ');
        return gap == std::string::npos ? text : text.replace (gap, 1, "\u00a0");   // a number stays with its unit
    };
    std::string text = b.isPassive() ? "passive: the hand has put in " + joule (b.work) : "active: " + joule (-b.worst - b.stored_first) + " more came out than went in; work of the hand " + joule (b.work);
    text += ", " + joule (b.stored) + " are stored, " + joule (b.dissipated) + " dissipated";
    if (b.held > 0.01 * b.moved && b.held > 1e-7) text += "; holding the force from tick to tick made " + joule (b.held);
    if (std::abs (b.elsewhere()) > 0.02 * b.moved && std::abs (b.elsewhere()) > 1e-7) text += b.elsewhere() > 0.0 ? ", " + joule (b.elsewhere()) + " elsewhere" : ": " + joule (-b.elsewhere()) + " too much, since the steps of the ticks are coarse";
    return text;
}

}   // namespace tactus::host
