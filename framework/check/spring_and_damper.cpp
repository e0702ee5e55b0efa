// SPDX-License-Identifier: MIT
#include "spring_and_damper.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::check
{

SpringAndDamper springAndDamper (std::span<const double> response, double period_s)
{
    constexpr double rounding = 1e-6;   // relative error of a measured slope
    const double settled = response.empty() ? 0.0 : response.back();
    double most = 0.0, damping = 0.0;
    for (const double now : response)
        most = std::max (most, std::abs (now));
    std::vector<double> excess (response.size(), 0.0), spring (std::max<std::size_t> (response.size(), 1), 1.0);
    for (std::size_t k = 0; k < response.size(); ++k)
    {
        const double rest = response[k] - settled;
        const bool is_excess = rest * settled >= 0.0;
        if (is_excess && std::abs (rest) > rounding * most) excess[k] = rest;
        if (! is_excess) spring[k] = response[k] / settled;
        damping += period_s * excess[k];
    }
    SpringAndDamper both { .stiffness = settled, .damping = damping, .period_s = period_s, .spring = std::move (spring) };
    both.damper.assign (both.spring.size(), 0.0);
    if (damping != 0.0)
        for (std::size_t k = 0; k < excess.size(); ++k)
            both.damper[k] = excess[k] / damping;
    else
    {
        const auto first = std::ranges::find_if (both.spring, [] (double v) { return std::abs (v) > rounding; });
        both.damper[static_cast<std::size_t> (first - both.spring.begin())] = 1.0 / period_s;
    }
    return both;
}

std::vector<double> SpringAndDamper::response (double stiffness_n_m, double damping_ns_m) const
{
    std::vector<double> all;
    for (std::size_t k = 0; k < spring.size(); ++k)
        all.push_back (stiffness_n_m * spring[k] + damping_ns_m * damper[k]);
    return all;
}

double SpringAndDamper::load (double stiffness_n_m, double damping_ns_m, double delay_ticks) const
{
    double late = 0.5 + delay_ticks;   // ticks
    for (const double part : spring)
        late += std::max (0.0, 1.0 - part);
    return std::abs (stiffness_n_m) * late * period_s + std::abs (damping_ns_m);
}

}   // namespace tactus::check
