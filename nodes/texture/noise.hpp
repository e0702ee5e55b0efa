// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>
#include <framework/random.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace tactus::nodes
{

/// The hiss and rumble of a real surface, from recordings of a tool dragged over it.
///
///     y_n = sum_k a_k y_(n-k) + e_n,   e ~ N (0, variance)        at `rate`
///     value = gain y
///
/// Each model is what was heard at one speed and one normal force. In between, their reflection coefficients and the
/// logarithms of their variances are interpolated: a filter is stable if all reflection coefficients are below 1 in size,
/// so every one in between is, at any order and however fast the hand changes its mind. (Between the a_k there are
/// unstable ones.) A model of lower order has reflection coefficients 0 to fill it up.
///
/// The filter is a normalised lattice: stage m turns its forward and backward signals by an angle,
///
///     f_(m-1) = c f_m + k b_(m-1),   b_m = c b_(m-1) - k f_m,   c = sqrt (1 - k^2),   y = sqrt (P) f_0
///
/// which keeps their energy whatever k does meanwhile, and P = variance / prod (1 - k^2) is the variance of y.
///
/// Source: Culbertson, Unwin & Kuchenbecker 2014; Romano & Kuchenbecker 2012. Lattice: Gray & Markel 1975.
///
/// Departures from the papers
///  - They interpolate line spectral frequencies between three models. Here reflection coefficients, on the grid of all
///    speeds and forces there are: bilinear between four. A place of the grid without a model has the nearest one's.
///  - Silence below a threshold of speed is a fade here, so that a stroke does not begin and end in a step.
///
/// Good to know
///  - Signs: y_n = 1.6 y_(n-1) - 0.8 y_(n-2) + e_n has the coefficients [1.6, -0.8]. Tools that print the denominator
///    1 - 1.6 z^-1 + 0.8 z^-2 have them negated.
///  - Outside the speeds and forces of the models the nearest holds. Below the lowest speed above 0 it fades, in
///    proportion to speed, to silence at rest; so does force, to silence out of contact. (No model with a speed above 0:
///    below 1 mm/s. None with a force above 0: below 10 mN.)
///  - All models have one rate. If the graph has another, the noise is made at its own and read between its samples by a
///    windowed sinc: flat to 0.4 of the lower of both rates, gone (-60 dB) from half of it on. That is what a graph slower
///    than the models cannot carry. It comes 18 samples of the slower one late, but grows, fades and falls silent at once.
///  - It knows speed but no position: back and forth over the same place sounds different each time.
///  - The same seed gives the same noise on every run. It gives energy: keep it small against the contact's own force.
struct TextureNoise
{
    struct Model
    {
        double speed = 0.1;
        double force = 1.0;
        double rate = 1000.0;
        std::vector<double> coefficients { 1.2, -0.6 };   // a resonance at 110 Hz
        double variance = 2e-3;

        static constexpr std::tuple fields {
            field (&Model::speed, "speed", unit::speed, "it was recorded at", { .hard = { 0, inf }, .usual = { 0, 0.5 } }),
            field (&Model::force, "force", unit::newton, "it was recorded at, normal to the surface", { .hard = { 0, inf }, .usual = { 0, 5 } }),
            field (&Model::rate, "rate", unit::hertz, "of its samples; the same for all models", { .hard = { 10, 1e5 }, .usual = { 500, 20000 } }),
            field (&Model::coefficients, "coefficients", unit::count, "a_1, a_2, …: what the next sample keeps of the last ones"),
            field (&Model::variance, "variance", Unit { Quantity::any, { 2, 2, -4 }, "N2" }, "of what comes new with each sample", { .hard = { 1e-30, 1e30 }, .usual = { 1e-8, 1 } }),
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
        .summary = "Noise as a real surface makes it, for each speed and force.",
        .source = "Culbertson, Unwin & Kuchenbecker 2014; Romano & Kuchenbecker 2012",
    };

    static constexpr std::tuple ports {
        input (&Inputs::speed, "speed", unit::speed, "of the tool over the surface; its sign does not matter"),
        input (&Inputs::normal_force, "normal_force", unit::newton, "the tool is pressed on with"),
        param (&Params::gain, "gain", unit::gain, "of the output", { .usual = { 0, 4 } }),
        setting (&Settings::models, "models", unit::count, "what was heard at each speed and force; none is silent"),
        setting (&Settings::seed, "seed", unit::count, "which noise", { .hard = { 0, 2147483647 }, .usual = { 1, 1000 } }),
        output (&Outputs::value, "value", unit::newton, "force of the vibration"),
    };

    Params params;
    Settings settings;

    std::string problem() const;
    std::string warning (const Setup&) const;
    void prepare (const Setup&);
    void adopt (const TextureNoise&) noexcept;

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.speed, in.normal_force) || grid.empty()) return {};

        const double speed = std::abs (in.speed), force = std::max (in.normal_force, 0.0);
        if (speed != at.speed || force != at.force) move (speed, force);
        const double value = params.gain * at.amplitude * (same_rate ? step() : resampled());
        return { .value = finiteOrZero (value) };
    }

private:
    static constexpr std::size_t most_models = 1024, highest_order = 256;

    /// A model as it is interpolated.
    struct Shape
    {
        std::vector<double> reflections;   // as many as the highest order
        double log_variance = 0.0;
    };

    /// Where a number lies between two of a sorted list.
    struct Between
    {
        std::size_t below = 0, above = 0;
        double part = 0.0;
    };

    static Between find (const std::vector<double>& sorted, double v) noexcept
    {
        const auto above = static_cast<std::size_t> (std::ranges::lower_bound (sorted, v) - sorted.begin());
        if (above == 0) return {};
        if (above == sorted.size()) return { above - 1, above - 1, 0.0 };
        return { above - 1, above, (v - sorted[above - 1]) / (sorted[above] - sorted[above - 1]) };
    }

    /// Takes the filter to another speed and force.
    void move (double speed, double force) noexcept
    {
        const Between s = find (speeds, speed), f = find (forces, force);
        const auto corner = [&] (std::size_t i, std::size_t j) -> const Shape&
        { return shapes[grid[i * forces.size() + j]]; };
        const Shape *a = &corner (s.below, f.below), *b = &corner (s.above, f.below), *c = &corner (s.below, f.above), *d = &corner (s.above, f.above);
        const double wa = (1.0 - s.part) * (1.0 - f.part), wb = s.part * (1.0 - f.part), wc = (1.0 - s.part) * f.part, wd = s.part * f.part;

        double left = 1.0;   // of the variance, when each stage has told what it knew beforehand
        for (std::size_t i = 0; i < stages.size(); ++i)
        {
            const double k = wa * a->reflections[i] + wb * b->reflections[i] + wc * c->reflections[i] + wd * d->reflections[i];
            const double rest = (1.0 - k) * (1.0 + k);
            stages[i].k = k;
            stages[i].c = std::sqrt (rest);
            left *= rest;
        }
        const double log_variance = wa * a->log_variance + wb * b->log_variance + wc * c->log_variance + wd * d->log_variance;
        const double fade = std::min (1.0, speed / full_speed) * std::min (1.0, force / full_force);
        at = { speed, force, fade * std::exp (0.5 * log_variance) / std::sqrt (left) };
    }

    /// The next sample at the models' rate, of variance 1.
    double step() noexcept
    {
        double f = random.normal(), b = 0.0;
        for (std::size_t i = stages.size(); i-- > 0;)
        {
            Stage& stage = stages[i];
            b = stage.c * stage.b - stage.k * f;
            f = stage.c * f + stage.k * stage.b;
            if (i + 1 < stages.size()) stages[i + 1].b = b;
        }
        if (! stages.empty()) stages[0].b = f;
        return f;
    }

    /// The next sample at the tick's rate.
    double resampled() noexcept
    {
        for (phase += ratio; phase >= 1.0; phase -= 1.0)
        {
            newest = newest + 1 < recent.size() ? newest + 1 : 0;
            recent[newest] = step();
        }
        double sum = 0.0;
        std::size_t i = newest;
        for (double distance = phase; distance < 2.0 * reach; distance += 1.0)
        {
            const double place = std::abs (distance - reach) / reach * static_cast<double> (kernel.size() - 2);
            const auto entry = static_cast<std::size_t> (place);
            sum += recent[i] * std::lerp (kernel[entry], kernel[entry + 1], place - static_cast<double> (entry));
            i = i > 0 ? i - 1 : recent.size() - 1;
        }
        return sum;
    }

    static std::vector<double> reflectionsOf (std::vector<double> coefficients);
    void prepareResampling (double tick_rate_hz);

    struct Stage
    {
        double k = 0.0, c = 1.0;
        double b = 0.0;   // backward signal of the stage before, one sample ago
    };

    struct Place
    {
        double speed = std::numeric_limits<double>::quiet_NaN(), force = 0.0;   // nowhere yet
        double amplitude = 0.0;                                                 // N
    };

    std::vector<double> speeds, forces;   // of the models, sorted
    std::vector<std::size_t> grid;        // which model stands for each speed and force, force by force
    std::vector<Shape> shapes;
    double full_speed = 0.0, full_force = 0.0;

    Random random;
    std::vector<Stage> stages;
    Place at;

    bool same_rate = true;
    double ratio = 1.0;           // models' samples a tick
    double reach = 0.0;           // of the kernel to either side, in models' samples
    std::vector<double> kernel;   // from its middle outwards
    std::vector<double> recent;   // models' samples, round and round
    std::size_t newest = 0;
    double phase = 0.0;   // of the tick after the newest, in models' samples
};

//==============================================================================
// Implementation below.

inline std::string TextureNoise::problem() const
{
    const auto& models = settings.models;
    if (models.size() > most_models) return "there are " + std::to_string (models.size()) + " models; there may be " + std::to_string (most_models);
    for (std::size_t i = 0; i < models.size(); ++i)
    {
        const Model& m = models[i];
        const std::string which = "model " + std::to_string (i);
        if (! isFinite (m.speed, m.force) || m.speed < 0.0 || m.force < 0.0) return which + " needs a speed and a force of at least 0";
        if (! (m.rate > 0.0) || ! isFinite (m.rate)) return which + " needs a rate above 0 Hz";
        if (m.rate != models[0].rate) return which + " has another rate than model 0; all need the same";
        if (! (m.variance > 0.0) || ! isFinite (m.variance)) return which + " needs a variance above 0; a smaller gain makes it softer";
        if (m.coefficients.size() > highest_order) return which + " has " + std::to_string (m.coefficients.size()) + " coefficients; there may be " + std::to_string (highest_order);
        if (reflectionsOf (m.coefficients).size() != m.coefficients.size())
            return which + " is not stable: it would grow for ever. Are the signs of its coefficients those of y_n = a_1 y_(n-1) + …?";
        for (std::size_t j = 0; j < i; ++j)
            if (models[j].speed == m.speed && models[j].force == m.force) return which + " has the speed and the force of model " + std::to_string (j);
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
        if (std::sqrt (variance) > loud) return "model " + std::to_string (i) + " makes " + std::to_string (std::lround (std::min (std::sqrt (variance), 1e15))) + " N on average: its coefficients are at the edge of stability, or its variance is not in N2";
    }
    return {};
}

/// The steps of Levinson's recursion, backwards. Stops short where the model is not stable.
inline std::vector<double> TextureNoise::reflectionsOf (std::vector<double> a)
{
    const std::size_t order = a.size();
    std::vector<double> reflections (order);
    for (std::size_t m = order; m-- > 0;)
    {
        const double k = a[m];
        if (! (std::abs (k) < 1.0)) return {};
        reflections[m] = k;
        const std::vector<double> whole = a;
        for (std::size_t j = 0; j < m; ++j)
            a[j] = (whole[j] + k * whole[m - 1 - j]) / ((1.0 - k) * (1.0 + k));
    }
    return reflections;
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
        shapes.push_back ({ reflectionsOf (m.coefficients), std::log (m.variance) });
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

    // Near is measured in spans of all speeds and forces; of two as near the first counts.
    grid.clear();
    for (const double speed : speeds)
        for (const double force : forces)
        {
            const double wide = std::max (speeds.back() - speeds.front(), 1e-9), high = std::max (forces.back() - forces.front(), 1e-9);
            const auto nearest = std::ranges::min_element (models, {}, [&] (const Model& m)
                                                           { return std::hypot ((m.speed - speed) / wide, (m.force - force) / high); });
            grid.push_back (static_cast<std::size_t> (nearest - models.begin()));
        }

    const auto lowest = [] (const std::vector<double>& sorted, double if_none)
    {
        const auto found = std::ranges::upper_bound (sorted, 0.0);
        return found == sorted.end() ? if_none : *found;
    };
    full_speed = lowest (speeds, 1e-3);
    full_force = lowest (forces, 1e-2);

    // The backward signals of a lattice that has long run are independent, of variance 1.
    random = Random { static_cast<std::uint64_t> (settings.seed) };
    stages.assign (order, {});
    for (Stage& stage : stages)
        stage.b = random.normal();
    at = {};
    prepareResampling (setup.rate_hz);
}

inline void TextureNoise::prepareResampling (double tick_rate_hz)
{
    ratio = settings.models.empty() ? 1.0 : settings.models[0].rate / tick_rate_hz;
    same_rate = ratio == 1.0;
    kernel.clear();
    recent.clear();
    newest = 0;
    phase = 0.0;
    if (same_rate) return;

    constexpr double zeros = 16.2, beta = 5.65;   // 18 samples of the slower rate to either side; 60 dB under this Kaiser window
    constexpr std::size_t entries = 1 << 13;
    const double cutoff = 0.45 * std::min (1.0, 1.0 / ratio);   // per models' sample
    reach = 0.5 * zeros / cutoff;
    const auto bessel = [] (double v)   // I_0; std::cyl_bessel_i is not everywhere
    {
        double sum = 1.0, term = 1.0;
        for (int k = 1; k < 30; ++k)
            sum += term *= 0.25 * v * v / (k * k);
        return sum;
    };
    for (std::size_t i = 0; i < entries; ++i)
    {
        const double r = static_cast<double> (i) / static_cast<double> (entries - 1), phase_angle = std::numbers::pi * zeros * r;
        kernel.push_back (2.0 * cutoff * (i == 0 ? 1.0 : std::sin (phase_angle) / phase_angle) * bessel (beta * std::sqrt (1.0 - r * r)) / bessel (beta));
    }
    kernel.push_back (0.0);

    recent.resize (static_cast<std::size_t> (std::ceil (2.0 * reach)) + 1);
    if (! grid.empty()) move (speeds.front(), forces.front());
    for (double& sample : recent)
        sample = step();
    newest = recent.size() - 1;
}

/// The noise goes on, through as many stages as there are: a stage of variance 1 follows upon one of variance 1. A new
/// seed is for the next start.
inline void TextureNoise::adopt (const TextureNoise& old) noexcept
{
    random = old.random;
    for (std::size_t i = 0; i < std::min (stages.size(), old.stages.size()); ++i)
        stages[i].b = old.stages[i].b;
    if (ratio != old.ratio) return;
    std::ranges::copy (old.recent, recent.begin());
    newest = old.newest;
    phase = old.phase;
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::TextureNoise);
