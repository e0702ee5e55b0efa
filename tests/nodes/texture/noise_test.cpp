// SPDX-License-Identifier: MIT
#include <tactus/nodes/texture/noise.hpp>

#include <support/no_allocation.hpp>
#include <support/property.hpp>
#include <support/rig.hpp>
#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <vector>

using namespace tactus;
using nodes::TextureNoise;
using Model = TextureNoise::Model;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double rate_hz = 1000.0;

TextureNoise sounding (std::vector<Model> models, double tick_rate_hz = rate_hz, int seed = 1)
{
    TextureNoise node;
    node.settings = { .models = std::move (models), .seed = seed };
    REQUIRE (node.problem() == "");
    node.prepare ({ .rate_hz = tick_rate_hz });
    return node;
}

Model model (double speed, double force, std::vector<double> coefficients, double variance, double rate = rate_hz)
{
    return { speed, force, rate, std::move (coefficients), variance };
}

/// Coefficients of the filter with these reflection coefficients: stable if all are below 1 in size.
std::vector<double> coefficientsOf (const std::vector<double>& reflections)
{
    std::vector<double> a;
    for (const double k : reflections)
    {
        auto next = a;
        for (std::size_t j = 0; j < a.size(); ++j)
            next[j] = a[j] - k * a[a.size() - 1 - j];
        next.push_back (k);
        a = next;
    }
    return a;
}

std::vector<double> randomReflections (std::mt19937& random, int most, double largest)
{
    std::vector<double> reflections (random() % static_cast<unsigned> (most + 1));
    for (auto& k : reflections)
        k = std::uniform_real_distribution { -largest, largest }(random);
    return reflections;
}

std::vector<double> heard (TextureNoise& node, std::size_t ticks, double speed = 0.1, double force = 1.0)
{
    std::vector<double> all;
    for (std::size_t k = 0; k < ticks; ++k)
        all.push_back (node.tick ({ speed, force }).value);
    return all;
}

double meanSquare (const std::vector<double>& values)
{
    double sum = 0.0;
    for (const double v : values)
        sum += v * v;
    return sum / static_cast<double> (values.size());
}

/// The autocovariance of a process with these coefficients and a variance of 1, from its impulse response.
std::vector<double> covariance (const std::vector<double>& a, std::size_t lags)
{
    std::vector<double> h (6000);
    for (std::size_t n = 0; n < h.size(); ++n)
    {
        h[n] = n == 0 ? 1.0 : 0.0;
        for (std::size_t k = 0; k < a.size() && k < n; ++k)
            h[n] += a[k] * h[n - 1 - k];
    }
    std::vector<double> c (lags);
    for (std::size_t lag = 0; lag < lags; ++lag)
        for (std::size_t n = lag; n < h.size(); ++n)
            c[lag] += h[n] * h[n - lag];
    return c;
}

/// Power density over frequency, 0 to half the rate, by averaged periodograms. White noise of variance 1 has 1 everywhere.
std::vector<double> spectrum (const std::vector<double>& values, std::size_t length)
{
    std::vector<double> window (length), power (length / 2 + 1);
    double window_energy = 0.0;
    for (std::size_t i = 0; i < length; ++i)
    {
        const double angle = 2.0 * M_PI * static_cast<double> (i) / static_cast<double> (length);
        window[i] = 0.35875 - 0.48829 * std::cos (angle) + 0.14128 * std::cos (2.0 * angle) - 0.01168 * std::cos (3.0 * angle);   // Blackman and Harris
        window_energy += window[i] * window[i];
    }
    Eigen::FFT<double> fft;
    std::vector<std::complex<double>> bins;
    std::size_t segments = 0;
    for (std::size_t from = 0; from + length <= values.size(); from += length / 2, ++segments)
    {
        std::vector<double> piece (length);
        for (std::size_t i = 0; i < length; ++i)
            piece[i] = window[i] * values[from + i];
        fft.fwd (bins, piece);
        for (std::size_t i = 0; i < power.size(); ++i)
            power[i] += std::norm (bins[i]) / window_energy;
    }
    for (auto& p : power)
        p /= static_cast<double> (segments);
    return power;
}

/// The power density sigma^2 / |A|^2 of a model, at a fraction of the models' rate.
double density (const Model& m, double fraction)
{
    std::complex<double> A = 1.0;
    for (std::size_t k = 0; k < m.coefficients.size(); ++k)
        A -= m.coefficients[k] * std::polar (1.0, -2.0 * M_PI * fraction * static_cast<double> (k + 1));
    return m.variance / std::norm (A);
}

const Model rumble = model (0.1, 1.0, { 1.2, -0.6 }, 2e-3);
const Model hiss = model (0.1, 1.0, coefficientsOf ({ -0.3, -0.4, 0.2, -0.1 }), 5e-3);
}   // namespace

TEST_CASE ("texture noise: it is the process that its coefficients describe", "[nodes][texture]")
{
    test::property ("each sample is the weighted sum of the last ones plus new noise of the given variance", [] (unsigned seed) {
        std::mt19937 random { seed };
        const auto a = coefficientsOf (randomReflections (random, 12, 0.9));
        const double variance = std::pow (10.0, std::uniform_real_distribution { -6.0, 0.0 }(random));
        auto node = sounding ({ model (0.1, 1.0, a, variance) }, rate_hz, 7);
        const auto y = heard (node, 100);
        double size = 0.0;
        for (const double c : a)
            size += std::abs (c);
        for (const double v : y)
            size = std::max (size, std::abs (v));

        Random noise { 7 };
        for (std::size_t k = 0; k < a.size(); ++k)
            noise.normal();   // the initial state of the node used these up
        for (std::size_t n = 0; n < y.size(); ++n)
        {
            double fresh = y[n];
            for (std::size_t k = 0; k < a.size() && k < n; ++k)
                fresh -= a[k] * y[n - 1 - k];
            const double expected = std::sqrt (variance) * noise.normal();
            if (n >= a.size()) RC_ASSERT (std::abs (fresh - expected) <= 1e-10 * (1.0 + size));
        }
    });
}

TEST_CASE ("texture noise: it has the variance of the process, starting at the first sample", "[nodes][texture]")
{
    test::property ("over a long run", [] (unsigned seed) {
        std::mt19937 random { seed };
        const auto a = coefficientsOf (randomReflections (random, 6, 0.8));
        const auto c = covariance (a, 400);
        auto node = sounding ({ model (0.1, 1.0, a, 0.01) }, rate_hz, static_cast<int> (seed % 1000));
        const std::size_t ticks = 4000;
        double squares = 0.0;   // the mean square of a Gaussian process has the variance 2 squares / ticks
        for (std::size_t lag = 0; lag < c.size(); ++lag)
            squares += (lag == 0 ? 1.0 : 2.0) * c[lag] * c[lag];
        const double deviation = std::sqrt (2.0 * squares / static_cast<double> (ticks));
        RC_ASSERT (std::abs (meanSquare (heard (node, ticks)) / 0.01 - c[0]) < 6.0 * deviation);
    });

    double first = 0.0;
    for (int seed = 0; seed < 2000; ++seed)
    {
        auto node = sounding ({ rumble }, rate_hz, seed);
        first += std::pow (node.tick ({ 0.1, 1.0 }).value, 2) / 2000.0;
    }
    CHECK (first == Approx (rumble.variance * covariance (rumble.coefficients, 1)[0]).epsilon (0.15));
}

TEST_CASE ("texture noise: it has the spectrum of the process", "[nodes][texture]")
{
    for (const Model& m : { rumble, hiss })
    {
        auto node = sounding ({ m });
        const auto power = spectrum (heard (node, 128 * 1000), 128);
        for (std::size_t i = 2; i + 2 < power.size(); ++i)
            REQUIRE (power[i] == Approx (density (m, static_cast<double> (i) / 128.0)).epsilon (0.15));
    }
}

TEST_CASE ("texture noise: between models the logarithm of the variance is interpolated, and outside, the nearest model holds", "[nodes][texture]")
{
    // A model without coefficients passes its noise on, so the size of each sample is known exactly.
    const auto corners = [] (double v, double f) { return std::exp (3.0 * v + 0.5 * f); };
    std::vector<Model> models;
    for (const double v : { 0.05, 0.2, 0.4 })
        for (const double f : { 0.5, 2.0 })
            models.push_back (model (v, f, {}, corners (v, f)));
    std::reverse (models.begin(), models.end());

    test::property ("at any speed and force", [&] (unsigned seed) {
        std::mt19937 random { seed };
        auto node = sounding (models);
        node.params.gain = 2.0;
        Random noise { 1 };
        for (int k = 0; k < 20; ++k)
        {
            const double v = std::uniform_real_distribution { 0.0, 0.6 }(random), f = std::uniform_real_distribution { -0.5, 3.0 }(random);
            const double fade = std::min (1.0, v / 0.05) * std::clamp (f / 0.5, 0.0, 1.0);
            const double size = 2.0 * fade * std::sqrt (corners (std::clamp (v, 0.05, 0.4), std::clamp (f, 0.5, 2.0)));
            const double value = node.tick ({ random() % 2 ? v : -v, f }).value, expected = size * noise.normal();
            RC_ASSERT (std::abs (value - expected) <= 1e-12 * (1.0 + size));
        }
    });

    // a grid point without a model uses its nearest model
    const std::vector<Model> three { model (0.1, 1.0, {}, 1.0), model (0.2, 1.0, {}, 2.0), model (0.1, 4.0, {}, 3.0) };
    auto node = sounding (three);
    Random noise { 1 };
    const double at_hole = node.tick ({ 0.2, 4.0 }).value / noise.normal();
    CHECK ((at_hole == Approx (std::sqrt (2.0)) || at_hole == Approx (std::sqrt (3.0))));
    CHECK (node.tick ({ 0.1, 4.0 }).value / noise.normal() == Approx (std::sqrt (3.0)));
}

TEST_CASE ("texture noise: every model in between is stable, however fast speed and force change", "[nodes][texture]")
{
    test::property ("random models of different orders, inside, at the edges and far outside", [] (unsigned seed) {
        std::mt19937 random { seed };
        std::vector<Model> models;
        std::vector<double> largest (20);
        for (int i = 0; i < 6; ++i)
        {
            const auto reflections = randomReflections (random, 20, 0.97);
            for (std::size_t k = 0; k < reflections.size(); ++k)
                largest[k] = std::max (largest[k], std::abs (reflections[k]));
            models.push_back (model (0.1 * (i % 3), 1.0 + i / 3, coefficientsOf (reflections), 0.01));
        }
        TextureNoise node;
        node.settings.models = models;
        RC_PRE (node.problem().empty());   // because of rounding, a model with a sharp resonance may count as unstable
        node.prepare ({ .rate_hz = rate_hz });

        double bound = 0.01;   // of the variance: every stage has its largest reflection coefficient
        for (const double k : largest)
            bound /= 1.0 - k * k;
        std::uniform_real_distribution<double> speed { -0.1, 0.4 }, force { 0.5, 3.0 };
        double v = 0.1, f = 1.0, energy = 0.0;
        for (int k = 0; k < 2000; ++k)
        {
            if (random() % 3 == 0) v = random() % 10 ? speed (random) : 1e6;
            if (random() % 3 == 0) f = random() % 10 ? force (random) : 1e6;
            energy += std::pow (node.tick ({ v, f }).value, 2) / 2000.0;
        }
        RC_ASSERT (energy < 3.0 * bound);
    });
}

TEST_CASE ("texture noise: it is silent at rest and out of contact, and grows from there without a step", "[nodes][texture]")
{
    for (const double tick_rate : { rate_hz, 4000.0 })
    {
        auto node = sounding ({ rumble }, tick_rate);
        const std::pair<double, double> silent[] { { 0.0, 1.0 }, { 0.1, 0.0 }, { 0.1, -1.0 }, { 0.0, 0.0 }, { not_a_number, 1.0 }, { 0.1, inf }, { inf, 1.0 } };
        for (const auto& [speed, force] : silent)
        {
            CHECK (node.tick ({ 0.1, 1.0 }).value != 0.0);
            CHECK (node.tick ({ speed, force }).value == 0.0);
        }
        // below the lowest speed of the models, the noise is proportional to the speed; the same applies to the force
        auto slow = node, light = node, both = node;
        for (int k = 0; k < 50; ++k)
        {
            const double full = node.tick ({ 0.1, 1.0 }).value;
            REQUIRE (slow.tick ({ 0.01, 1.0 }).value == Approx (0.1 * full).margin (1e-12));
            REQUIRE (light.tick ({ 0.1, 0.02 }).value == Approx (0.02 * full).margin (1e-12));
            REQUIRE (both.tick ({ 1e-9, 1e-9 }).value == Approx (0.0).margin (1e-12));
        }
    }

    // models recorded at rest do not sound at rest
    auto still = sounding ({ model (0.0, 0.0, {}, 1.0) });
    CHECK (still.tick ({ 0.0, 1.0 }).value == 0.0);
    CHECK (still.tick ({ 0.1, 0.0 }).value == 0.0);
    CHECK (still.tick ({ 1e-3, 1e-2 }).value != 0.0);
}

TEST_CASE ("texture noise: at a different rate it has the same spectrum, without images or aliases", "[nodes][texture]")
{
    for (const double tick_rate : { 4000.0, 2700.0, 1200.0 })   // faster than the rate of the models (1 kHz): no images may appear
    {
        auto node = sounding ({ hiss }, tick_rate);
        const auto power = spectrum (heard (node, 256 * 500), 256);
        for (std::size_t i = 4; i < power.size(); ++i)
        {
            const double f = static_cast<double> (i) / 256.0 * tick_rate;
            INFO (f << " Hz at " << tick_rate);
            if (f < 390.0) REQUIRE (power[i] * rate_hz / tick_rate == Approx (density (hiss, f / rate_hz)).epsilon (0.2));
            if (f > 500.0 + 4.0 * tick_rate / 256.0) REQUIRE (power[i] < 1e-5 * density (hiss, 0.5));
        }
    }

    for (const double tick_rate : { 500.0, 270.0 })   // slower than the rate of the models: nothing may alias
    {
        const Model low = model (0.1, 1.0, { 1.9, -0.95 }, 1e-3);   // about 35 Hz
        auto node = sounding ({ low }, tick_rate);
        const auto power = spectrum (heard (node, 256 * 500), 256);
        for (std::size_t i = 4; static_cast<double> (i) / 256.0 < 0.39; ++i)
            REQUIRE (power[i] * rate_hz / tick_rate == Approx (density (low, static_cast<double> (i) / 256.0 * tick_rate / rate_hz)).epsilon (0.3));

        const Model high = model (0.1, 1.0, { -1.9, -0.95 }, 1e-3);   // about 465 Hz
        auto silent = sounding ({ high }, tick_rate);
        auto as_made = sounding ({ high });
        CHECK (meanSquare (heard (silent, 20'000)) < 1e-3 * meanSquare (heard (as_made, 20'000)));
    }
}

TEST_CASE ("texture noise: the same seed gives the same noise, a different seed gives different noise", "[nodes][texture]")
{
    for (const double tick_rate : { rate_hz, 2700.0 })
    {
        auto a = sounding ({ rumble }, tick_rate, 3), b = sounding ({ rumble }, tick_rate, 3), c = sounding ({ rumble }, tick_rate, 4);
        const auto first = heard (a, 500);
        CHECK (first == heard (b, 500));
        CHECK (first != heard (c, 500));
    }
}

TEST_CASE ("texture noise: with new models the noise continues", "[nodes][texture]")
{
    for (const double tick_rate : { rate_hz, 4000.0 })
    {
        auto old = sounding ({ rumble }, tick_rate);
        heard (old, 103);

        // a model of higher order that describes the same process
        auto padded = rumble;
        padded.coefficients.resize (6);
        auto young = sounding ({ padded }, tick_rate, 99);
        young.adopt (old);
        REQUIRE (heard (young, 200) == heard (old, 200));

        // a louder model: the same wave, louder
        auto louder = rumble;
        louder.variance *= 4.0;
        auto loud = sounding ({ louder }, tick_rate);
        loud.adopt (old);
        for (int k = 0; k < 100; ++k)
            REQUIRE (loud.tick ({ 0.1, 1.0 }).value == Approx (2.0 * old.tick ({ 0.1, 1.0 }).value).margin (1e-12));
    }
}

TEST_CASE ("texture noise: it reads its models from a file's records", "[nodes][texture]")
{
    const auto type = describe<TextureNoise>();
    Rig rig { type, rate_hz };
    rig.set ("models", Records { { 0.1, 1.0, rate_hz, rumble.coefficients, rumble.variance } });
    rig.set ("seed", 5.0);
    CHECK (rig.problem() == "");
    rig.prepare();
    auto node = sounding ({ rumble }, rate_hz, 5);
    for (int k = 0; k < 100; ++k)
    {
        rig.input ("speed", 0.1).input ("normal_force", 1.0).tick();
        REQUIRE (rig.out ("value") == node.tick ({ 0.1, 1.0 }).value);
    }
}

TEST_CASE ("texture noise: models it cannot play are refused with a sentence", "[nodes][texture]")
{
    const auto refused = [] (const std::vector<Model>& models) {
        TextureNoise node;
        node.settings.models = models;
        return ! node.problem().empty();
    };
    CHECK_FALSE (refused ({}));
    CHECK_FALSE (refused ({ rumble }));
    CHECK_FALSE (refused ({ model (0.1, 1.0, coefficientsOf ({ 0.999, -0.999, 0.999 }), 1.0) }));
    for (const auto& a : { std::vector { 1.0 }, { -1.5 }, { 0.5, 1.0 }, { 2.0, -0.9 }, { not_a_number }, { inf, 0.5 } })
        CHECK (refused ({ model (0.1, 1.0, a, 1.0) }));
    for (const double bad : { 0.0, -1.0, not_a_number, inf })
    {
        CHECK (refused ({ model (0.1, 1.0, {}, bad) }));
        CHECK (refused ({ model (0.1, 1.0, {}, 1.0, bad) }));
        if (bad != 0.0) CHECK (refused ({ model (bad, 1.0, {}, 1.0) }));
        if (bad != 0.0) CHECK (refused ({ model (0.1, bad, {}, 1.0) }));
    }
    CHECK (refused ({ rumble, rumble }));
    CHECK (refused ({ rumble, model (0.2, 1.0, {}, 1.0, 2000.0) }));
    CHECK (refused ({ model (0.1, 1.0, std::vector<double> (257), 1.0) }));

    std::vector<Model> many;
    for (int i = 0; i < 1025; ++i)
        many.push_back (model (0.1 * i, 1.0, {}, 1.0));
    CHECK (refused (many));
    many.pop_back();
    CHECK_FALSE (refused (many));
}

TEST_CASE ("texture noise: no input breaks it, and a tick allocates nothing", "[nodes][texture]")
{
    test::property ("the output is finite", [] {
        auto node = sounding ({ rumble, model (0.2, 3.0, { 0.5 }, 1e30) }, *rc::gen::element (10.0, 1000.0, 48'000.0));
        node.params.gain = *rc::gen::element (0.0, 1.0, -1e300);
        for (int k = 0; k < 40; ++k)
        {
            const auto any = [] { return *rc::gen::element (0.0, 0.1, 0.15, -1.0, 1e300, -1.7e308, 5e-324, not_a_number, inf); };
            const TextureNoise::Inputs in { any(), any() };
            const NoAllocation watch;
            const double value = node.tick (in).value;
            const bool allocated = watch.allocations() > 0;
            RC_ASSERT (isFinite (value) && ! allocated);
        }
    });
}
