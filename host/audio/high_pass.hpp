// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nodes/filter/biquad.hpp>

#include <optional>

namespace tactus::host::audio
{

/// Keeps away from a speaker what it cannot play and only pushes its cone: a Butterworth high-pass of second order, or
/// nothing. [tick thread, once it is made]
class HighPass
{
public:
    HighPass (double cutoff_hz, double rate_hz)
    {
        if (cutoff_hz <= 0.0) return;
        filter.emplace();
        filter->params.kind = nodes::BiquadFilter::Kind::high;
        filter->params.cutoff = cutoff_hz;
        filter->prepare ({ .rate_hz = rate_hz });
        filter->update();
    }

    double operator() (double in) noexcept { return filter ? filter->tick ({ .in = in }).out : in; }

private:
    std::optional<nodes::BiquadFilter> filter;
};

}   // namespace tactus::host::audio
