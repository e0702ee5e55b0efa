// SPDX-License-Identifier: GPL-3.0-or-later
// A recording of a board that rang after a shock, if it is present, and the mode fitted to it. Plots go to
// build/figures/.

#include "program.hpp"

#include <host/tools/figures/plot.hpp>
#include <support/property.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/text/number_text.hpp>

#include <catch2/catch.hpp>

#include <Eigen/QR>
#include <unsupported/Eigen/FFT>
#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <span>

using namespace tactus;
using Eigen::Index;

namespace
{
constexpr double turn = 2.0 * std::numbers::pi;

/// One decaying tone: amplitude e^(-decay t) sin (2 pi frequency t + phase), with t from the start of the analysed
/// window.
struct Tone
{
    double frequency, decay, amplitude, phase;   // in Hz, 1/s, the unit of the signal, and rad

    double operator() (double t) const { return amplitude * std::exp (-decay * t) * std::sin (turn * frequency * t + phase); }
};

struct Identified
{
    Tone tone;
    std::vector<double> drift;   // drift of the gauge, of the same length as the signal
};

/// Fits the signal as the sum of a decaying tone and a slow polynomial. The unknowns are frequency and decay; for given
/// values of these, the rest is linear.
class ToneFit
{
public:
    static constexpr int slow_terms = 7;

    ToneFit (std::span<const double> signal, double dt_s)
        : dt (dt_s), y (Eigen::Map<const Eigen::VectorXd> (signal.data(), static_cast<Index> (signal.size()))) {}

    // Required by Eigen's optimiser.
    using Scalar = double;
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum
    {
        InputsAtCompileTime = Eigen::Dynamic,
        ValuesAtCompileTime = Eigen::Dynamic
    };
    Index inputs() const { return 2; }
    Index values() const { return y.size(); }

    int operator() (const Eigen::VectorXd& x, Eigen::VectorXd& residual) const
    {
        const auto terms = basis (x[0], x[1]);
        residual = terms * solved (terms) - y;
        return 0;
    }

    Identified at (double frequency, double decay) const
    {
        const auto terms = basis (frequency, decay);
        const Eigen::VectorXd amounts = solved (terms), slow = terms.rightCols (slow_terms) * amounts.tail (slow_terms);
        return { .tone = { frequency, decay, std::hypot (amounts[0], amounts[1]), std::atan2 (amounts[1], amounts[0]) }, .drift { slow.begin(), slow.end() } };
    }

private:
    /// A decaying sine and cosine, and powers of the time rescaled to run from -1 to 1.
    Eigen::MatrixXd basis (double frequency, double decay) const
    {
        Eigen::MatrixXd terms (y.size(), 2 + slow_terms);
        for (Index i = 0; i < y.size(); ++i)
        {
            const double t = dt * static_cast<double> (i), u = 2.0 * static_cast<double> (i) / static_cast<double> (y.size() - 1) - 1.0;
            terms (i, 0) = std::exp (-decay * t) * std::sin (turn * frequency * t);
            terms (i, 1) = std::exp (-decay * t) * std::cos (turn * frequency * t);
            for (int power = 0; power < slow_terms; ++power)
                terms (i, 2 + power) = std::pow (u, power);
        }
        return terms;
    }

    Eigen::VectorXd solved (const Eigen::MatrixXd& terms) const { return terms.householderQr().solve (y); }

    double dt;
    Eigen::VectorXd y;
};

/// The strongest frequency above 200 Hz, interpolated between spectral lines by a parabola through their logarithms.
double strongest (std::span<const double> signal, double dt)
{
    std::vector<double> windowed (signal.begin(), signal.end());
    for (std::size_t i = 0; i < windowed.size(); ++i)
        windowed[i] *= 0.5 - 0.5 * std::cos (turn * static_cast<double> (i) / static_cast<double> (windowed.size()));
    std::vector<std::complex<double>> lines;
    Eigen::FFT<double>().fwd (lines, windowed);

    const double step = 1.0 / (dt * static_cast<double> (windowed.size()));
    std::size_t peak = static_cast<std::size_t> (200.0 / step) + 1;
    for (std::size_t i = peak; i < windowed.size() / 2; ++i)
        if (std::abs (lines[i]) > std::abs (lines[peak])) peak = i;
    const double below = std::log (std::abs (lines[peak - 1])), here = std::log (std::abs (lines[peak])), above = std::log (std::abs (lines[peak + 1]));
    return step * (static_cast<double> (peak) + 0.5 * (below - above) / (below - 2.0 * here + above));
}

/// An estimate of the decay: the logarithm of the energy ratio of the first and second halves.
double decayBetweenHalves (std::span<const double> signal, double dt)
{
    const auto energy = [] (std::span<const double> part) {
        double sum = 0.0;
        for (const double v : part)
            sum += v * v;
        return sum;
    };
    const auto half = signal.size() / 2;
    return std::log (energy (signal.first (half)) / energy (signal.last (half))) / (2.0 * dt * static_cast<double> (half));
}

Identified identify (std::span<const double> signal, double dt)
{
    const ToneFit fit { signal, dt };
    Eigen::NumericalDiff<ToneFit> with_slopes { fit };
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<ToneFit>> search { with_slopes };
    Eigen::VectorXd x (2);
    x << strongest (signal, dt), decayBetweenHalves (signal, dt);
    search.minimize (x);
    return fit.at (x[0], x[1]);
}

double rms (std::span<const double> signal)
{
    double squares = 0.0;
    for (const double v : signal)
        squares += v * v;
    return std::sqrt (squares / static_cast<double> (signal.size()));
}

/// Renders the ring of one mode with `tactus render`; the mode is hit once, on tick `at`.
std::vector<double> rendered (const Tone& tone, double hit, std::size_t at, std::size_t ticks, double dt)
{
    const test::Scratch scratch;
    auto feed = TableWriter::create (scratch.path ("feed.csv"), std::vector<std::string> { "ring.hit" });
    REQUIRE (feed);
    for (std::size_t i = 0; i < ticks; ++i)
        REQUIRE (feed->row (std::vector { i == at ? hit : 0.0 }));
    REQUIRE (feed->commit());

    const auto json = R"({ "format": "tactus-graph", "version": 1, "name": "Board", "nodes": {
        "ring": { "type": "vibration.modal", "settings": { "modes": [{ "frequency": )"
                      + numberText (tone.frequency) + R"(, "decay": )" + numberText (tone.decay) + R"(, "amplitude": 1 }] } } }, "wires": [] })";
    const auto graph = scratch.write ("graph.json", json);
    const auto ran = test::runTactus ({ "render", graph, "--feed", scratch.path ("feed.csv"),
                                        "--rate", std::to_string (std::lround (1.0 / dt)), "--record", "ring.value", "--out", scratch.path ("out.csv") });
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    const auto table = readTable (std::filesystem::path (scratch.path ("out.csv")));
    REQUIRE (table);
    REQUIRE (table->rows() == ticks);

    std::vector<double> value;
    for (std::size_t r = 0; r < ticks; ++r)
        value.push_back (table->at (r, 1));
    return value;
}

struct Recording
{
    double dt = 0.0;              // s
    std::vector<double> signal;   // g
};

Recording readRecording (const std::string& path)
{
    Recording r;
    std::ifstream in (path);
    std::string line;
    std::getline (in, line);
    double t = 0.0, first = 0.0, g = 0.0;
    while (in >> t >> g)
    {
        if (r.signal.empty()) first = t;
        r.signal.push_back (g);
    }
    r.dt = (t - first) / static_cast<double> (r.signal.size() - 1);
    return r;
}

std::string figure (const std::string& name)
{
    const auto folder = std::filesystem::path (TACTUS_SOURCE_DIR) / "build" / "figures";
    std::filesystem::create_directories (folder);
    return (folder / name).string();
}
}   // namespace

TEST_CASE ("the fit recovers a decaying tone under noise and drift", "[cli]")
{
    test::property ("frequency within 0.1 %, decay within 2 %, amplitude within 2 %", [] {
        const Tone tone { .frequency = 1.0 * *rc::gen::inRange (400, 3000),
                          .decay = 1.0 * *rc::gen::inRange (15, 90),
                          .amplitude = 100.0,
                          .phase = 0.1 * *rc::gen::inRange (-30, 30) };
        std::mt19937 random { *rc::gen::arbitrary<std::uint32_t>() };
        std::normal_distribution<double> noise { 0.0, 1.0 };
        const double dt = 5e-5, slant = 0.1 * *rc::gen::inRange (-100, 100);
        std::vector<double> signal;
        for (int i = 0; i < 1000; ++i)
            signal.push_back (tone (dt * i) + slant * (1.0 - 2e-3 * i) + noise (random));

        const auto found = identify (signal, dt).tone;
        RC_ASSERT (std::abs (found.frequency / tone.frequency - 1.0) < 0.001);
        RC_ASSERT (std::abs (found.decay / tone.decay - 1.0) < 0.02);
        RC_ASSERT (std::abs (found.amplitude / tone.amplitude - 1.0) < 0.02);
    });
}

// Long because it is one scenario whose steps depend on each other: window, fit, render, comparison and plot.
TEST_CASE ("a board that rang after a shock matches one mode of vibration.modal", "[data]")
{
    const auto folder = test::sharedData ("shock_highrate_shm");
    if (folder.empty()) return;
    const auto recording = readRecording (folder + "/acc_pcb_a0.txt");
    const auto& signal = recording.signal;
    const double dt = recording.dt;
    REQUIRE (signal.size() > 5000);
    REQUIRE (dt == Approx (2e-5));

    // Above half of the peak, the ring is not a single mode yet; below a twentieth, it is lost in the drift.
    const double most = *std::ranges::max_element (signal);
    const auto lastAbove = [&signal] (double level) {
        const auto last = std::find_if (signal.rbegin(), signal.rend(), [level] (double v) { return std::abs (v) > level; });
        return static_cast<std::size_t> (last.base() - signal.begin());
    };
    const std::size_t from = lastAbove (0.5 * most), to = lastAbove (0.05 * most);
    const auto window = std::span (signal).subspan (from, to - from);
    const auto found = identify (window, dt);
    const auto& tone = found.tone;
    CHECK (tone.frequency == Approx (805.0).epsilon (0.02));
    CHECK (tone.decay == Approx (44.0).epsilon (0.20));

    // A hit starts a sine at a zero crossing. Of the last ten crossings before the window, take the one nearest to a tick.
    const double period = 1.0 / tone.frequency;
    double zero = 0.0, apart = 1.0;
    for (int i = 0; i < 10; ++i)
    {
        const double ticks = (-tone.phase / (turn * tone.frequency) - i * period) / dt;
        if (ticks > 0.0 || std::abs (ticks - std::round (ticks)) >= apart) continue;
        zero = std::round (ticks);
        apart = std::abs (ticks - zero);
    }
    const auto at = static_cast<std::size_t> (static_cast<double> (from) + zero);
    const auto ring = rendered (tone, tone.amplitude * std::exp (-tone.decay * dt * zero), at, signal.size(), dt);

    std::vector<double> recorded, left;
    for (std::size_t i = 0; i < window.size(); ++i)
    {
        recorded.push_back (window[i] - found.drift[i]);
        left.push_back (recorded.back() - ring[from + i]);
    }
    const double part = rms (left) / rms (recorded);
    WARN ("ring-down: " << tone.frequency << " Hz, decay " << tone.decay << " 1/s, over " << 1e3 * dt * static_cast<double> (window.size())
                        << " ms from " << 1e3 * dt * static_cast<double> (from) << " ms; residual " << 100.0 * part << " % rms");
    CHECK (part < 0.06);

    // A fit of the rendered ring gives the same tone.
    const auto again = identify (std::span (ring).subspan (from, to - from), dt).tone;
    CHECK (again.frequency == Approx (tone.frequency).epsilon (1e-4));
    CHECK (again.decay == Approx (tone.decay).epsilon (1e-3));

    const auto series = [&] (const std::string& label, std::size_t first, std::size_t last, std::size_t origin, const auto& value) {
        host::Series s { .label = label };
        for (std::size_t i = first; i < last; ++i)
        {
            s.x.push_back (dt * (static_cast<double> (i) - static_cast<double> (origin)));
            s.y.push_back (value (i));
        }
        return s;
    };
    const auto heard = [&] (std::size_t i) { return signal[i]; };
    const auto level = [&] (std::size_t i) { return recorded[i - from]; };
    const auto made = [&] (std::size_t i) { return ring[i]; };
    host::Figure picture { .title = "A board after a shock, recorded and synthesised" };
    const auto cycles = static_cast<std::size_t> (6.0 * period / dt);
    picture.panels.push_back ({ .title = "as recorded", .x = { "time", "s" }, .y = { "acceleration", "g" }, .series = {} });
    picture.panels.back().series = { series ("recorded", at, signal.size(), 0, heard), series ("vibration.modal", at, signal.size(), 0, made) };
    for (const std::size_t first : { from, from + (to - from) / 2, to - cycles })
    {
        picture.panels.push_back ({ .title = "six cycles from " + std::to_string (std::lround (1e3 * dt * static_cast<double> (first)))
                                             + " ms, without drift",
                                    .x = { "time from there", "s" },
                                    .y = { "acceleration", "g" },
                                    .series = {} });
        picture.panels.back().series = { series ("recorded", first, first + cycles, first, level),
                                         series ("vibration.modal", first, first + cycles, first, made) };
        picture.panels.back().series[0].style = host::Series::Style::points;
    }
    REQUIRE (host::writeFigure (picture, figure ("ring_down.png")));
}
