// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/lattice.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/kit/random.hpp>
#include <tactus/kit/signal/stream_resampler.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace tactus::nodes
{

/// The hiss and rumble of a real surface, from recordings of a tool dragged over it.
///
///     y_n = sum_k a_k y_(n-k) + e_n,   e ~ N (0, variance)        at `rate`
///     value = gain y
///
/// Each model describes what was recorded at one speed and one normal force. Between models, their reflection coefficients and
/// the logarithms of their variances are interpolated. A filter is stable if all its reflection coefficients are below 1 in
/// size, so every interpolated one is stable, at any order and however fast the hand moves. (Interpolating the a_k could give an
/// unstable filter.) A model of lower order is padded with reflection coefficients of 0.
///
/// The filter is a normalised lattice: stage m rotates its forward and backward signals by an angle,
///
///     f_(m-1) = c f_m + k b_(m-1),   b_m = c b_(m-1) - k f_m,   c = sqrt (1 - k^2),   y = sqrt (P) f_0
///
/// which keeps their energy while k moves. P = variance / prod (1 - k^2) is the variance of y.
///
/// Source: Culbertson, Unwin & Kuchenbecker 2014; Romano & Kuchenbecker 2012. Lattice: Gray & Markel 1975.
///
/// Departures from the papers
///  - They interpolate line spectral frequencies between three models. This node interpolates reflection coefficients,
///    bilinearly between four models, on the grid of all speeds and forces. A grid point without a model uses the nearest one.
///  - In the papers, the noise stops below a speed threshold. Here it fades, so that a stroke does not begin and end in a step.
///
/// Good to know
///  - Signs: y_n = 1.6 y_(n-1) - 0.8 y_(n-2) + e_n has the coefficients [1.6, -0.8]. Tools that print the denominator
///    1 - 1.6 z^-1 + 0.8 z^-2 give them negated.
///  - Outside the speeds and forces of the models the nearest one is used. Below the lowest speed above 0 the noise fades in
///    proportion to speed, to silence at rest. Force fades the same way, to silence out of contact. (If no model has a speed
///    above 0, the fade is below 1 mm/s; if none has a force above 0, below 10 mN.)
///  - All models have the same rate. If the graph has a different rate, the noise is made at its own rate and read between its
///    samples by a windowed sinc: flat up to 0.4 of the lower of the two rates; -60 dB from half of it upwards. A graph slower than
///    the models loses what is above that. The noise is 18 samples of the slower rate late, but grows, fades and falls silent
///    immediately.
///  - It depends on speed, not on position: back and forth over the same place sounds different each time.
///  - The same seed gives the same noise on every run. It adds energy: keep it small compared with the contact's
///    own force.
struct TextureNoise
{
    struct Model
    {
        double speed = 0.1;
        double force = 1.0;
        double rate = 1000.0;
        std::vector<double> coefficients { 1.2, -0.6 };   // a resonance at 110 Hz
        double variance = 2e-3;

        static constexpr Unit square_newton { Quantity::any, { 2, 2, -4 }, "N2" };

        static constexpr std::tuple fields {
            field (&Model::speed, "speed", unit::speed, "speed of the recording", { .hard = { 0, inf }, .usual = { 0, 0.5 } }),
            field (&Model::force, "force", unit::newton, "force of the recording, normal to the surface", { .hard = { 0, inf }, .usual = { 0, 5 } }),
            field (&Model::rate, "rate", unit::hertz, "rate of its samples; the same for all models", { .hard = { 10, 1e5 }, .usual = { 500, 20000 } }),
            field (&Model::coefficients, "coefficients", unit::count, "a_1, a_2, …: the weights of the last samples in the next one"),
            field (&Model::variance, "variance", square_newton, "variance of the noise e in each sample", { .hard = { 1e-30, 1e30 }, .usual = { 1e-8, 1 } }),
        };
    };

    struct Inputs
    {
        double speed = 0.0;
        double normal_force = 0.0;
    };

    struct Params
    {
        double gain = 1.0;
    };

    struct Settings
    {
        std::vector<Model> models = std::vector<Model> (1);
        int seed = 1;
    };

    struct Outputs
    {
        double value = 0.0;
    };

    static constexpr Info info {
        .id = "texture.noise",
        .name = "Recorded texture",
        .summary = "The hiss and rumble of a real surface, from recordings at several speeds and forces.",
        .source = "Culbertson, Unwin & Kuchenbecker 2014; Romano & Kuchenbecker 2012",
        .keywords = "roughness data-driven noise",
    };

    static constexpr std::tuple ports {
        input (&Inputs::speed, "speed", unit::speed, "speed of the tool over the surface; the sign does not matter"),
        input (&Inputs::normal_force, "normal_force", unit::newton, "force that presses the tool onto the surface"),
        param (&Params::gain, "gain", unit::gain, "gain of the output", { .usual = { 0, 4 } }),
        setting (&Settings::models, "models", unit::count, "one for each recorded speed and force; without models the node is silent"),
        setting (&Settings::seed, "seed", unit::count, "number that selects the noise", { .hard = { 0, 2147483647.0 }, .usual = { 1, 1000 } }),
        output (&Outputs::value, "value", unit::newton, "force of the vibration"),
    };

    Params params;
    Settings settings;

    Cost cost() const;
    std::string problem() const;
    std::string warning (const Setup&) const;
    void prepare (const Setup&);
    void adopt (const TextureNoise&) noexcept;

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.speed, in.normal_force) || grid.empty()) return {};

        const double speed = std::abs (in.speed), force = std::max (in.normal_force, 0.0);
        if (speed != now.speed || force != now.force) move (speed, force);
        const double value = params.gain * now.amplitude * resampler ([this] { return lattice (random.normal()); });
        return { .value = finiteOrZero (value) };
    }

    void serialize (auto& archive) { archive (random, lattice, resampler, now); }

private:
    static constexpr std::size_t most_models = 1024, highest_order = 256;

    /// A model in the form that is interpolated.
    struct Shape
    {
        std::vector<double> reflections;   // padded with 0 to the highest order of all models
        double log_variance = 0.0;
    };

    /// A number's position between two entries of a sorted list.
    struct Between
    {
        std::size_t below = 0, above = 0;
        double part = 0.0;
    };

    static Between find (const std::vector<double>& sorted, double v) noexcept
    {
        const auto above = at (std::ranges::lower_bound (sorted, v) - sorted.begin());
        if (above == 0) return {};
        if (above == sorted.size()) return { above - 1, above - 1, 0.0 };
        return { above - 1, above, (v - sorted[above - 1]) / (sorted[above] - sorted[above - 1]) };
    }

    /// Moves the filter to a different speed and force.
    void move (double speed, double force) noexcept
    {
        const Between s = find (speeds, speed), f = find (forces, force);
        const auto corner = [this] (std::size_t i, std::size_t j) -> const Shape& { return shapes[grid[i * forces.size() + j]]; };
        const Shape &a = corner (s.below, f.below), &b = corner (s.above, f.below), &c = corner (s.below, f.above), &d = corner (s.above, f.above);
        const double wa = (1.0 - s.part) * (1.0 - f.part), wb = s.part * (1.0 - f.part), wc = (1.0 - s.part) * f.part, wd = s.part * f.part;

        const double *ka = a.reflections.data(), *kb = b.reflections.data(), *kc = c.reflections.data(), *kd = d.reflections.data();
        const double left = lattice.set ([=] (std::size_t i) noexcept { return wa * ka[i] + wb * kb[i] + wc * kc[i] + wd * kd[i]; });
        const double log_variance = wa * a.log_variance + wb * b.log_variance + wc * c.log_variance + wd * d.log_variance;
        const double fade = std::min (1.0, speed / full_speed) * std::min (1.0, force / full_force);
        now = { speed, force, fade * math::exp (0.5 * log_variance) / std::sqrt (left) };
    }

    std::vector<std::size_t> nearestModels() const;

    struct State
    {
        double speed = std::numeric_limits<double>::quiet_NaN(), force = 0.0;   // nan: not set yet
        double amplitude = 0.0;                                                 // N
    };

    std::vector<double> speeds, forces;   // speeds and forces of the models, sorted
    std::vector<std::size_t> grid;        // by speed, then force: index of the model
    std::vector<Shape> shapes;
    double full_speed = 0.0, full_force = 0.0;   // from this speed and force up, the noise does not fade

    Random random;
    Lattice lattice;
    StreamResampler resampler;
    State now;
};

//==============================================================================
// Implementation below.

/// The stability of each model is checked, and for each pair of a speed and a force the nearest model is searched.
inline Cost TextureNoise::cost() const
{
    constexpr double work_per_product = 2.0, work_per_distance = 3.0;
    if (settings.models.size() > most_models) return {};   // a problem
    std::set<double> all_speeds, all_forces;
    double products = 0.0, numbers = 0.0;
    for (const Model& m : settings.models)
    {
        all_speeds.insert (m.speed);
        all_forces.insert (m.force);
        const auto order = static_cast<double> (std::min (m.coefficients.size(), highest_order));
        products += order * order;
        numbers += order;
    }
    const auto pairs = static_cast<double> (all_speeds.size()) * static_cast<double> (all_forces.size());
    return { .work = work_per_product * products + work_per_distance * pairs * static_cast<double> (settings.models.size()),
             .memory = 8.0 * (pairs + numbers) };
}

inline std::string TextureNoise::problem() const
{
    const auto& models = settings.models;
    if (models.size() > most_models) return "there are " + std::to_string (models.size()) + " models; there can be at most " + std::to_string (most_models);
    for (std::size_t i = 0; i < models.size(); ++i)
    {
        const Model& m = models[i];
        const auto which = "model " + std::to_string (i), order = std::to_string (m.coefficients.size());
        if (! isFinite (m.speed, m.force) || m.speed < 0.0 || m.force < 0.0) return which + " needs a speed and a force of at least 0";
        if (! (m.rate > 0.0) || ! isFinite (m.rate)) return which + " needs a rate above 0 Hz";
        if (m.rate != models[0].rate) return which + " has a different rate from model 0; all models need the same rate";
        if (! (m.variance > 0.0) || ! isFinite (m.variance)) return which + " needs a variance above 0; to make it softer, lower the gain";
        if (m.coefficients.size() > highest_order) return which + " has " + order + " coefficients; there can be at most " + std::to_string (highest_order);
        if (reflectionsOf (m.coefficients).size() != m.coefficients.size())
            return which + " is not stable: it would grow without limit. Do the signs of its coefficients follow y_n = a_1 y_(n-1) + …?";
        for (std::size_t j = 0; j < i; ++j)
            if (models[j].speed == m.speed && models[j].force == m.force) return which + " has the same speed and force as model " + std::to_string (j);
    }
    return {};
}

inline std::string TextureNoise::warning (const Setup&) const
{
    constexpr double loud = 100.0;   // N
    for (std::size_t i = 0; i < settings.models.size(); ++i)
    {
        double variance = settings.models[i].variance;
        for (const double k : reflectionsOf (settings.models[i].coefficients))
            variance /= (1.0 - k) * (1.0 + k);
        if (std::sqrt (variance) > loud)
            return "model " + std::to_string (i) + " has an RMS force of " + std::to_string (std::lround (std::min (std::sqrt (variance), 1e15)))
                   + " N: its coefficients are at the edge of stability, or its variance is not in N2";
    }
    return {};
}

/// The nearest model for each speed and force. Distances are scaled by the range of all speeds and of all forces. If several
/// models are equally near, the first one is used.
inline std::vector<std::size_t> TextureNoise::nearestModels() const
{
    const auto& models = settings.models;
    std::vector<std::size_t> all;
    for (const double speed : speeds)
        for (const double force : forces)
        {
            const double wide = std::max (speeds.back() - speeds.front(), 1e-9), high = std::max (forces.back() - forces.front(), 1e-9);
            const auto distance = [&] (const Model& m) { return math::hypot ((m.speed - speed) / wide, (m.force - force) / high); };
            all.push_back (at (std::ranges::min_element (models, {}, distance) - models.begin()));
        }
    return all;
}

inline void TextureNoise::prepare (const Setup& setup)
{
    const auto& models = settings.models;
    std::size_t order = 0;
    shapes.clear();
    speeds.clear();
    forces.clear();
    for (const Model& m : models)
    {
        shapes.push_back ({ reflectionsOf (m.coefficients), math::log (m.variance) });
        speeds.push_back (m.speed);
        forces.push_back (m.force);
        order = std::max (order, m.coefficients.size());
    }
    for (Shape& shape : shapes)
        shape.reflections.resize (order);
    for (auto* axis : { &speeds, &forces })
    {
        std::ranges::sort (*axis);
        axis->erase (std::unique (axis->begin(), axis->end()), axis->end());
    }
    grid = nearestModels();

    const auto lowest = [] (const std::vector<double>& sorted, double if_none) {
        const auto found = std::ranges::upper_bound (sorted, 0.0);
        return found == sorted.end() ? if_none : *found;
    };
    full_speed = lowest (speeds, 1e-3);
    full_force = lowest (forces, 1e-2);

    random = Random { static_cast<std::uint64_t> (settings.seed) };
    lattice.start (order, [this] { return random.normal(); });
    now = {};
    resampler.prepare (models.empty() ? 1.0 : models[0].rate / setup.rate_hz);
    if (resampler.passesThrough()) return;
    if (! grid.empty()) move (speeds.front(), forces.front());
    resampler.fill ([this] { return lattice (random.normal()); });
}

/// The noise continues: stages that both filters have keep their signals, which have variance 1 whatever the coefficients are. A
/// new seed takes effect only at the next start.
inline void TextureNoise::adopt (const TextureNoise& old) noexcept
{
    random = old.random;
    lattice.adopt (old.lattice);
    resampler.adopt (old.resampler);
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::TextureNoise);
