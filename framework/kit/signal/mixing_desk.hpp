// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/list.hpp>
#include <tactus/kit/vec3.hpp>

#include <tactus/kit/math/math.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tactus
{

struct DeskParams
{
    List gain { 1.0 };
    List mute;
    List solo;
    List priority;
    double duck_db = 12.0;
    double ceiling = 0.0;
};

/// The channels of a mixing desk: what gain, mute, solo and priority do to each layer of an effect. The layers of layer.mix are doubles,
/// those of layer.mix_vectors are vectors. The level of a vector is its length.
template <typename Layer>
class MixingDesk
{
public:
    void prepare (double dt_s) noexcept
    {
        ramp = dt_s / 10e-3;
        attack = -math::expm1 (-dt_s / 5e-3);
        release = -math::expm1 (-dt_s / 100e-3);
        decay = math::exp (-dt_s / 50e-3);
        fading = math::exp (-dt_s / 2.0);
        forget();
    }

    void update (const DeskParams& params, int inputs) noexcept
    {
        any_solo = false;
        for (int i = 0; i < inputs; ++i)
            any_solo = any_solo || params.solo[i] > 0.5;
        ducked = math::pow (10.0, -params.duck_db / 20.0);
    }

    /// Continues from the state of another desk. Call it after prepare().
    void adopt (const MixingDesk& old) noexcept
    {
        channels = old.channels;
        loudest = old.loudest;
        limit = old.limit;
        limiting = old.limiting;
        limits = old.limits;
        earlier = old.earlier;
        way = old.way;
        started = old.started;
    }

    /// The outputs of a node that mixes: `out`, `level` and `reduction`. If something is not finite, they are 0, and the desk is reset.
    template <typename Outputs>
    Outputs mix (const InputList<Layer>& in, const DeskParams& params) noexcept
    {
        Outputs out { .level = { 0.0, in.size() } };   // every path returns this object, so that its list is not copied
        if (! mixed (in, params, out))
        {
            forget();
            out = {};
        }
        return out;
    }

    /// The factor on a layer in the last mix, before the ceiling: gain, mute, solo and ducking.
    double factor (int i, const DeskParams& params) const noexcept { return channels[at (i)].duck * channels[at (i)].open * params.gain[i]; }

    void serialize (auto& archive) { archive (channels, loudest, limit, limiting, limits, earlier, way, started); }

private:
    struct Channel
    {
        double open = 1.0;    // the ramp of mute and solo
        double level = 0.0;   // the level after this ramp
        double duck = 1.0;
    };

    static double magnitude (double v) noexcept { return std::abs (v); }
    static double magnitude (const Vec3& v) noexcept { return length (v); }

    static void clear (double& v) noexcept { v = 0.0; }
    static void clear (Vec3& v) noexcept { v.setZero(); }

    /// The sum, limited to the ceiling. `loud` is its magnitude.
    static double limited (double sum, double ceiling, double) noexcept { return std::copysign (ceiling, sum); }

    /// Keeps the direction. The margin allows for rounding errors, which could make the vector longer than the ceiling.
    static Vec3 limited (const Vec3& sum, double ceiling, double loud) noexcept { return (sum / loud) * (ceiling * (1.0 - margin (0.0))); }

    bool isOpen (const DeskParams& params, int i) const noexcept { return ! (params.mute[i] > 0.5) && (! any_solo || params.solo[i] > 0.5); }

    /// True if a layer of higher priority sounds.
    bool isDucked (const DeskParams& params, int i, int size) const noexcept
    {
        for (int j = 0; j < size; ++j)
            if (params.priority[j] > params.priority[i] && channels[at (j)].level > audible * loudest) return true;
        return false;
    }

    template <typename Outputs>
    bool mixed (const InputList<Layer>& in, const DeskParams& params, Outputs& out) noexcept;

    void forget() noexcept
    {
        channels = {};
        loudest = limit = limiting = earlier = way = 0.0;
        limits = started = false;
    }

    /// A decaying peak. It becomes 0 before it becomes subnormal.
    static double fall (double level, double factor) noexcept { return level > 1e-300 ? level * factor : 0.0; }

    static constexpr double audible = 0.01;   // share of `loudest` above which a channel sounds

    std::array<Channel, list_capacity> channels;
    double loudest = 0.0;
    double limit = 0.0;      // the last ceiling that was one
    double limiting = 0.0;   // share of the ceiling: it fades as a mute does
    bool limits = false;     // in the last tick, there was a ceiling

    // Another ceiling came while one faded: the limit at that time, and the share of the way from there that is left.
    double earlier = 0.0, way = 0.0;

    double ramp = 1.0, attack = 1.0, release = 1.0, decay = 0.0, fading = 0.0;   // per tick
    double ducked = 1.0;
    bool any_solo = false;
    bool started = false;
};

/// Returns false if something is not finite.
template <typename Layer>
template <typename Outputs>
bool MixingDesk<Layer>::mixed (const InputList<Layer>& in, const DeskParams& params, Outputs& out) noexcept
{
    if (! isFinite (in)) return false;

    const int size = in.size();
    std::array<Layer, list_capacity> heard;
    loudest = fall (loudest, fading);
    for (int i = 0; i < size; ++i)
    {
        Channel& c = channels[at (i)];
        const double target = isOpen (params, i) ? 1.0 : 0.0;
        c.open = started ? std::clamp (target, c.open - ramp, c.open + ramp) : target;

        const Layer x = c.open * (params.gain[i] * in[i]);
        const double level = magnitude (x);
        if (! isFinite (x) || ! isFinite (level)) return false;
        heard[at (i)] = x;
        c.level = std::max (level, fall (c.level, decay));
        loudest = std::max (loudest, c.level);
        out.level[i] = c.level;
    }

    Layer sum;
    clear (sum);
    for (int i = 0; i < size; ++i)
    {
        Channel& c = channels[at (i)];
        const double target = isDucked (params, i, size) ? ducked : 1.0;
        c.duck += (target < c.duck ? attack : release) * (target - c.duck);
        if (std::abs (target - c.duck) < 1e-9) c.duck = target;
        sum += c.duck * heard[at (i)];
    }
    const double loud = magnitude (sum);
    if (! isFinite (sum) || ! isFinite (loud)) return false;

    const double target = params.ceiling > 0.0 ? 1.0 : 0.0;
    if (target > 0.0)
    {
        if (! limits)
        {
            way = started && limiting > 0.0 ? 1.0 : 0.0;
            earlier = limit;
        }
        way = std::max (0.0, way - ramp);
        limit = (1.0 - way) * params.ceiling + way * earlier;
    }
    limits = target > 0.0;
    limiting = started ? std::clamp (target, limiting - ramp, limiting + ramp) : target;
    started = true;
    out.out = sum;
    if (limiting > 0.0 && loud > limit)
    {
        out.out = limited (sum, limit, loud);
        double left = limit;
        if (limiting < 1.0)
        {
            out.out = limiting * out.out + (1.0 - limiting) * sum;
            left = limiting * limit + (1.0 - limiting) * loud;
        }
        out.reduction = 20.0 / std::numbers::ln10 * (math::log (loud) - math::log (left));   // the quotient of the two may overflow
    }
    return true;
}

}   // namespace tactus
