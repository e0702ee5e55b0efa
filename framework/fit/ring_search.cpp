// SPDX-License-Identifier: MIT
#include "ring_search.hpp"
#include "ring_sums.hpp"

#include <tactus/kit/at.hpp>
#include <tactus/kit/math/math.hpp>

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace tactus::detail
{

namespace
{
using Eigen::VectorXd;

/// Decays times the length of the signal. Between them, a tone loses at most 8 % of its power over the noise.
constexpr double ring_decays[] { 0.0, 2.0, 6.0, 18.0, 54.0, 162.0, 486.0 };

/// A spectrum of the signal weighted with e^(-decay n), as power over that of white noise of variance 1.
std::vector<double> weightedSpectrum (const VectorXd& signal, double decay)
{
    const auto n = static_cast<std::size_t> (decay > 0.0 ? std::min (static_cast<double> (signal.size()), std::ceil (6.0 / decay)) : static_cast<double> (signal.size()));
    std::vector<double> weighted (std::bit_ceil (n + n / 4), 0.0);
    const double factor = math::exp (-decay);
    double weight = 1.0, squares = 0.0;
    for (std::size_t i = 0; i < n; ++i, weight *= factor)
    {
        weighted[i] = weight * signal[static_cast<Index> (i)];
        squares += weight * weight;
    }
    std::vector<Complex> lines;
    Eigen::FFT<double> transform;
    transform.SetFlag (Eigen::FFT<double>::HalfSpectrum);
    transform.fwd (lines, weighted);
    std::vector<double> power;
    for (const auto& line : lines)
        power.push_back (std::norm (line) / squares);
    return power;
}
}   // namespace

ResidualSpectrum::ResidualSpectrum (const VectorXd& residual, double least)
{
    const auto n = static_cast<double> (residual.size());
    constexpr double of_power = 0.693147;   // the median of the power of noise, over its mean
    const auto bands = static_cast<std::size_t> (std::clamp (n / 2.0 / 64.0, 1.0, 48.0));
    const double lines_per_band = n / 2.0 / static_cast<double> (bands);
    limit = thresholdOf (n) * (1.0 + 2.5 / std::sqrt (lines_per_band));
    double most = 0.0;
    for (const double decay : ring_decays)
    {
        const auto power = weightedSpectrum (residual, decay / n);
        const double step = std::numbers::pi / static_cast<double> (power.size() - 1);
        if (floors.empty())
            for (std::size_t b = 0; b < bands; ++b)
            {
                std::vector<double> band (power.begin() + static_cast<std::ptrdiff_t> (b * power.size() / bands),
                                          power.begin() + static_cast<std::ptrdiff_t> ((b + 1) * power.size() / bands));
                const auto middle = band.begin() + static_cast<std::ptrdiff_t> (band.size() / 2);
                std::ranges::nth_element (band, middle);
                floors.push_back (std::max (least, *middle / of_power));
            }
        const double lowest = std::max (1.5 * 2.0 * std::numbers::pi, decay) / n;
        for (auto i = static_cast<std::size_t> (std::ceil (lowest / step)); i + 1 < power.size(); ++i)
        {
            const double angle = step * static_cast<double> (i);
            if (power[i] > most && power[i] > limit * floorAt (angle))
            {
                most = power[i];
                loudest_angle = angle;
            }
            if (found && power[i] < found->score * least) continue;
            const double score = power[i] / floorAt (angle);
            if (score > limit && (! found || score > found->score)) found = HiddenTone { { -std::max (decay, 0.7) / n, angle }, score };
        }
    }
}

double ResidualSpectrum::thresholdOf (double rows) { return math::log (2000.0 * rows); }

double ResidualSpectrum::floorAt (double angle) const
{
    const double place = std::clamp (angle / std::numbers::pi * static_cast<double> (floors.size()) - 0.5, 0.0, static_cast<double> (floors.size() - 1));
    const auto below = static_cast<std::size_t> (place);
    const double share = place - static_cast<double> (below);
    return below + 1 < floors.size() ? (1.0 - share) * floors[below] + share * floors[below + 1] : floors[below];
}

namespace
{
constexpr int most_ring_steps = 30;
}   // namespace

RingModel withoutFaint (const VectorXd& signal, RingModel model, const std::function<double (double)>& floor, double least, const FitCourse* course)
{
    while (! model.tones.empty() && ! isCancelled (course))
    {
        auto scores = model.gains();
        for (std::size_t k = 0; k < scores.size(); ++k)
            scores[k] *= 0.5 / floor (model.tones[k].rate.imag());
        const auto weakest = std::ranges::min_element (scores);
        if (*weakest > least) break;
        auto rates = model.allRates();
        rates.erase (rates.begin() + (weakest - scores.begin()));
        model = fitRing (signal, rates, model.drift.size(), most_ring_steps, course);
    }
    return model;
}

FoundRing searchRing (const VectorXd& signal, Index drift, int most_tones, double least, FitCourse* course)
{
    constexpr double hysteresis = 0.8;   // a tone that was found may lose a little
    RingModel model = fitRing (signal, {}, drift, most_ring_steps, course);
    while (! isCancelled (course))
    {
        const VectorXd residual = signal - model.values();
        const ResidualSpectrum spectrum (residual, least);
        if (! spectrum.strongest()) return { std::move (model), true };
        if (static_cast<int> (model.tones.size()) >= most_tones) break;
        setShare (course, 0.8 * static_cast<double> (model.tones.size() + 1) / (most_tones + 1));
        auto rates = model.allRates();
        rates.push_back (fitRing (residual, { spectrum.strongest()->rate }, 0, most_ring_steps, course).tones.front().rate);
        auto next = withoutFaint (
            signal, fitRing (signal, rates, drift, most_ring_steps, course), [&] (double angle) { return spectrum.floorAt (angle); }, hysteresis * spectrum.threshold(),
            course);
        if (! (next.sum < model.sum)) break;
        model = std::move (next);
    }
    return { std::move (model), false };
}

}   // namespace tactus::detail
