// SPDX-License-Identifier: MIT
#include "judging.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tactus::check::judging
{

namespace
{
double betterThan (double factor) noexcept { return std::max (1.0, Factors::better / factor); }

/// The factor that the remedy aims at: the recommended one if the condition already holds with `factor`.
double wanted (double factor, double value, double limit) noexcept { return factor * value < limit ? std::max (factor, Factors::better) : factor; }

std::string slower (double speed) { return "slower than " + text (roundedBound (speed, false), "m/s"); }

/// Sets the condition `scanning` for ridges of the frequency k, in 1/m, that a hand crosses at v, in m/s. `other`: a further remedy, if there is one.
void judgeScanning (Condition& c, double k, double v, double period_s, const DeviceNumbers& numbers, double alpha, std::string other)
{
    const double aim = wanted (alpha, k * v * period_s, 1.0);
    std::vector<std::string> ways { "strokes " + slower (1.0 / (aim * k * period_s)) };
    if (reaches (numbers, aim * k * v)) ways.push_back ("a rate " + above (aim * k * v, "Hz"));
    if (! other.empty()) ways.push_back (std::move (other));
    decide (c, alpha * k * v * period_s, 1.0, Strict::yes, betterThan (alpha), anyOf (ways));
}

/// The conditions of Table 1 for one texture.
class TextureJudge
{
public:
    TextureJudge (const Demand& d, const Texture& its, const DeviceNumbers& n, const JudgeOptions& o, std::vector<Condition>& all)
        : demand (d), t (its), numbers (n), options (o), conditions (all), period_s (periodOf (d, n))
    {
    }

    void judge()
    {
        scanning();
        lowSpeed();
        highSpeed();
        forceResolution();
        gain();
        structure();
    }

private:
    const Demand& demand;
    const Texture& t;
    const DeviceNumbers& numbers;
    const JudgeOptions& options;
    std::vector<Condition>& conditions;
    double period_s;

    Condition& add (std::string_view id, std::string_view law, std::string_view unit, std::string sentence)
    {
        return conditions.emplace_back (
            Condition { .id = id, .role = t.role, .node = demand.nodes[t.node].path, .law = law, .unit = unit, .text = std::move (sentence) });
    }

    double speed() const noexcept { return options.speed > 0.0 ? options.speed : t.speed; }

    std::string wave() const { return "k " + text (t.spatial_frequency, "1/m"); }

    void scanning()
    {
        const double alpha = options.factors.alpha, k = t.spatial_frequency, v = speed();
        auto& c = add ("scanning", "alpha k v T < 1", "1", wave() + ", v " + text (v, "m/s") + ", alpha " + text (alpha));
        const auto guards = std::ranges::count (demand.nodes, "texture.antialias", &MeasuredNode::type);
        const auto guard = std::ranges::find (demand.nodes, "texture.antialias", &MeasuredNode::type);
        const auto fades = guards == 1 ? "'" + guard->path + "'" : std::string ("a texture.antialias");   // of several, it is not known which fades this one
        const bool is_assumed = options.speed > t.speed;
        if (guards > 0 && is_assumed) c.text += ", as if it were still felt at this speed, whatever " + fades + " fades out";
        const auto other = guards == 0 ? fades : is_assumed ? std::string()
                                                            : "a lower f_max of " + fades + " if it fades this texture";
        judgeScanning (c, k, v, period_s, numbers, alpha, other);
    }

    void lowSpeed()
    {
        const double beta = options.factors.beta, k = t.spatial_frequency;
        auto& c = add ("low_speed", "beta k delta < 1", "1", wave() + ", beta " + text (beta));
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        decide (c, beta * k * numbers.quantum->value, 1.0, Strict::yes, betterThan (beta), finerSensor (wanted (beta, k * numbers.quantum->value, 1.0), k));
    }

    /// The condition is judged as printed: it equals `scanning` at a speed of one quantum per tick. At high speed, the step from tick to
    /// tick matters instead, so the text gives that step.
    void highSpeed()
    {
        const double alpha = options.factors.alpha, k = t.spatial_frequency, step = speed() * period_s;
        auto& c = add ("high_speed", "alpha k delta < 1", "1", wave() + ", alpha " + text (alpha));
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        const double sampling = options.factors.beta * k * std::max (numbers.quantum->value, step);
        c.text += ", a stroke moves " + text (1e6 * step, "um") + " per tick, and beta k times the larger of delta and this step is " + text (sampling);
        decide (c, alpha * k * numbers.quantum->value, 1.0, Strict::yes, betterThan (alpha), finerSensor (wanted (alpha, k * numbers.quantum->value, 1.0), k));
    }

    static std::string finerSensor (double factor, double k) { return "a quantum " + below (1e6 / (factor * k), "um") + ", or a coarser texture"; }

    void forceResolution()
    {
        const double gamma = options.factors.gamma;
        auto& c = add ("force_resolution", "gamma b < A", "N", "A " + text (t.amplitude, "N") + ", gamma " + text (gamma));
        if (! numbers.force_quantum) return unknown (c, 0.0, "force quantum");
        const double b = numbers.force_quantum->value;
        c.text += ", b " + text (b, "N");
        decide (c, gamma * b, t.amplitude, Strict::yes, betterThan (gamma),
                "a texture " + moreThan (gamma * b / t.amplitude) + " as strong, or a force quantum " + below (t.amplitude / gamma, "N"));
    }

    /// A is what reaches the hand, which may be less than the amplitude that is set at the node. So a remedy is a factor.
    static std::string moreThan (double factor) { return "more than " + text (roundedBound (factor, true), "times"); }

    /// The chapter bounds A k, "proportional to the slope". The slope itself is 2 pi A k, and the hold bounds it like any stiffness.
    void gain()
    {
        auto& c = add ("gain", "2 pi A k <= 2B/((2d + 1) T)", "N/m",
                       "A k " + text (t.amplitude * t.spatial_frequency, "N/m") + ", A " + text (t.amplitude, "N") + ", " + wave());
        if (! numbers.damping) return unknown (c, t.slope, "damping");
        const double limit = stiffestWall (numbers.damping->value, period_s, delayOf (numbers));
        const double rate = t.slope / limit / period_s, needed = t.slope / stiffestWall (1.0, period_s, delayOf (numbers));
        std::vector<std::string> ways;
        if (limit > 0.0) ways.push_back ("a texture " + atMost (limit / t.slope, "times") + " as strong");
        if (limit > 0.0 && reaches (numbers, rate)) ways.push_back ("a rate of " + atLeast (rate, "Hz"));
        ways.push_back ("a device with a damping of " + atLeast (needed, "N*s/m"));
        ways.emplace_back ("a coarser texture");
        decide (c, t.slope, limit, Strict::no, 1.0, anyOf (ways));
    }

    void structure()
    {
        const double v = speed(), k = t.spatial_frequency;
        auto& c = add ("structural", "v k < F_0", "Hz", wave() + ", v " + text (v, "m/s"));
        if (! numbers.first_mode) return unknown (c, v * k, "first mode");
        const double limit = numbers.first_mode->value;
        decide (c, v * k, limit, Strict::yes, 1.0,
                "strokes " + slower (limit / k) + ", a texture.antialias with f_max " + text (roundedBound (limit, false), "Hz")
                    + ", or a device whose first mode is " + above (v * k, "Hz"));
    }
};
}   // namespace

void judgeTeeth (const Demand& demand, const Stretch& s, const DeviceNumbers& numbers, const JudgeOptions& options, Condition& c)
{
    const double v = options.speed > 0.0 ? options.speed : s.speed;
    c.text = "teeth of " + text (1e6 * s.teeth, "um") + ", v " + text (v, "m/s") + ", alpha " + text (options.factors.alpha);
    const double period_s = periodOf (demand, numbers), aim = wanted (options.factors.alpha, v * period_s, s.teeth);
    judgeScanning (c, 1.0 / s.teeth, v, period_s, numbers, options.factors.alpha,
                   "teeth " + above (1e6 * aim * v * period_s, "um") + " (d_max times static_ratio - 1)");
}

void judgeTexture (const Demand& demand, const Texture& texture, const DeviceNumbers& numbers, const JudgeOptions& options, std::vector<Condition>& all)
{
    TextureJudge (demand, texture, numbers, options, all).judge();
}

}   // namespace tactus::check::judging
