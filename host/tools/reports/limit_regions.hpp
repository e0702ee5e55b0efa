// SPDX-License-Identifier: MIT
#pragma once

#include "boundary.hpp"
#include "contact_at.hpp"
#include "varied.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// One picture: two quantities that vary, and the lines on it.
struct View
{
    std::string title;
    Varied x, y;
};

/// The range around a value in which a predicate holds; empty if it holds nowhere.
struct Range
{
    double low = 0.0, high = 0.0;
    bool is_low_known = true, is_high_known = true;   // false: beyond it, the loop is not known
    bool is_lowest = false;                           // true: no value below `low` was searched
};

/// The limits of the working point.
struct Limits
{
    std::optional<Range> stiffness, damping, rate;
};

/// Finds the limits of a contact. [main thread]
class LimitRegions
{
public:
    /// `steps`: of each axis of a picture or a table. `checkOn` is called for each point of one, and may throw.
    LimitRegions (int s, Contact& c, std::function<void()> on) : checkOn (std::move (on)), steps (s), contact (c), here (c.at (conditions ({}, {}))) {}

    const std::function<void()> checkOn;
    const int steps;

    const Standing& workingPoint() const noexcept { return here; }

    /// The conditions at two values of two quantities.
    Conditions conditions (const std::vector<const Varied*>& varied, const std::vector<double>& values) const
    {
        Conditions c { .params = params_now };
        for (std::size_t i = 0; i < varied.size(); ++i)
        {
            if (varied[i]->what == Varied::What::stiffness) c.stiffness = values[i];
            if (varied[i]->what == Varied::What::damping) c.damping = values[i];
            if (varied[i]->what == Varied::What::rate) c.rate_hz = values[i];
            if (varied[i]->what == Varied::What::param) c.params[varied[i]->param] = values[i];
        }
        return c;
    }

    void vary (const std::vector<Varied>& params)
    {
        for (const auto& v : params)
            if (v.what == Varied::What::param)
            {
                contact.varied.push_back (v.name);
                params_now.push_back (v.now);
            }
    }

    enum class Rule
    {
        passive,
        stable
    };

    Limits limitsOf (Rule rule) const
    {
        const double b = std::max (here.damping, 0.0), most_b = 2.0 * here.largest_damper, period = here.period_s;
        const double some_k = 2.0 * contact.damping() / period;
        Limits all;
        const Varied stiffness { .what = Varied::What::stiffness }, damping { .what = Varied::What::damping }, rate { .what = Varied::What::rate };
        all.stiffness = rangeOf (rule, stiffness, grid (1e-3 * some_k, 1e3 * some_k, 120), std::abs (here.stiffness));
        all.damping = rangeOf (rule, damping, withZero (grid (1e-3 * contact.damping(), std::max (most_b, 2.0 * b), 90)), b);
        all.rate = rangeOf (rule, rate, grid (std::max (10.0, contact.rate() / 32.0), std::min (1e5, 32.0 * contact.rate()), 41), contact.rate());
        return all;
    }

    double value (Rule rule, const Conditions& c) const
    {
        const auto s = contact.at (c);
        return rule == Rule::passive ? s.passive (contact.damping()) : s.rests();
    }

    /// The views that are drawn if no axes are named: near the working point, over the rate, and the whole region.
    std::vector<View> usualViews (const Limits& stable) const
    {
        const double B = contact.damping();
        Varied stiffness { .what = Varied::What::stiffness, .name = "stiffness", .unit = "N/m", .now = here.stiffness };
        Varied damping { .what = Varied::What::damping, .name = "virtual damping", .unit = "N*s/m", .now = here.damping };
        Varied rate { .what = Varied::What::rate, .name = "rate", .unit = "Hz", .now = contact.rate() };
        double most = std::max (here.stiffness, 2.0 * B / here.period_s);
        for (const double b : grid (1e-2 * B, here.largest_damper, 24))
            if (const auto range = rangeOf (Rule::stable, { .what = Varied::What::stiffness }, grid (1e-3 * most, 1e3 * most, 60), most,
                                            { { Varied::What::damping, b } }))
                most = std::max (most, range->high);
        View whole { "the whole region", stiffness, damping }, near { "near the working point", stiffness, damping }, over { "over the rate", rate, stiffness };
        whole.x.to = 1.1 * most;
        whole.y.to = 1.1 * std::max (here.largest_damper, here.damping);
        near.y.to = std::max (2.0 * B, 2.0 * here.damping);
        near.x.to = 1.25 * std::max ({ here.stiffness, stable.stiffness ? stable.stiffness->high : 0.0, 2.0 * B / here.period_s });
        over.x.from = 0.25 * contact.rate();
        over.x.to = std::min (1e5, 3.0 * contact.rate());
        over.y.to = 2.0 * near.x.to;
        return { near, over, whole };   // neighbours with the same axis would share its range
    }

    std::vector<std::string> columns() const
    {
        std::vector<std::string> all { "rate (Hz)", "stiffness (N/m)", "damping (N*s/m)" };
        for (const auto& v : contact.varied)
            all.push_back (v);
        for (const char* more : { "load (N*s/m)", "radius", "passive", "stable", "b < 2M/T + 4B/3", "sigma T < b + B" })
            all.emplace_back (more);
        return all;
    }

    /// All points of the views, row after row.
    std::vector<std::vector<double>> rows (const std::vector<View>& views) const
    {
        std::vector<std::vector<double>> all;
        for (const auto& view : views)
            for (int i = 0; i <= steps; ++i)
                for (int j = 0; j <= steps; ++j)
                {
                    const auto c = conditions ({ &view.x, &view.y }, { view.x.from + (view.x.to - view.x.from) * i / steps,
                                                                       view.y.from + (view.y.to - view.y.from) * j / steps });
                    const auto s = contact.at (c);
                    checkOn();
                    auto& row = all.emplace_back (std::vector { c.rate_hz > 0.0 ? c.rate_hz : contact.rate(), s.stiffness, s.damping });
                    row.insert (row.end(), c.params.begin(), c.params.end());
                    const auto holds = [] (double v) { return std::isnan (v) ? v : v < 0.0 ? 1.0
                                                                                           : 0.0; };
                    const double B = contact.damping();
                    for (const double v : { s.load, s.radius.value_or (std::nan ("")), holds (s.passive (B)), holds (s.rests()), holds (s.damperHolds()),
                                            holds (s.footnote (B)) })
                        row.push_back (v);
                }
        return all;
    }

private:
    Contact& contact;
    std::vector<double> params_now {};
    Standing here;

    static std::vector<double> grid (double from, double to, int steps)
    {
        std::vector<double> all;
        for (int i = 0; i <= steps; ++i)
            all.push_back (from * std::pow (to / from, static_cast<double> (i) / steps));
        return all;
    }

    static std::vector<double> withZero (std::vector<double> all)
    {
        all.insert (all.begin(), 0.0);
        return all;
    }

    /// The range of a quantity in which a rule holds that contains its value now, or else the one nearest to it.
    std::optional<Range> rangeOf (Rule rule, const Varied& v, const std::vector<double>& values, double now,
                                  const std::vector<std::pair<Varied::What, double>>& others = {}) const
    {
        const auto valueAt = [&] (double at) {
            auto c = conditions ({ &v }, { at });
            for (const auto& [what, other] : others)
                (what == Varied::What::damping ? c.damping : c.stiffness) = other;
            return value (rule, c);
        };
        const auto holds = [&] (double at) { return valueAt (at) < 0.0; };
        const auto isKnown = [&] (double at) { return ! std::isnan (valueAt (at)); };
        const auto between = [&] (double in, double out) {
            for (int i = 0; i < 14; ++i)
                (holds (0.5 * (in + out)) ? in : out) = 0.5 * (in + out);
            return in;
        };
        std::optional<Range> best;
        double nearest = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            if (! holds (values[i])) continue;
            const auto first = i;
            while (i + 1 < values.size() && holds (values[i + 1]))
                ++i;
            const Range found { first == 0 ? values.front() : between (values[first], values[first - 1]),
                                i + 1 == values.size() ? std::numeric_limits<double>::infinity() : between (values[i], values[i + 1]),
                                first == 0 || isKnown (values[first - 1]), i + 1 == values.size() || isKnown (values[i + 1]), first == 0 };
            const double away = std::max ({ 0.0, found.low - now, now - found.high });
            if (best && away >= nearest) continue;
            nearest = away;
            best = found;
        }
        return best;
    }
};

}   // namespace tactus::host
