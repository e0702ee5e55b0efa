// SPDX-License-Identifier: GPL-3.0-or-later
#include "shadow_mixer.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
template <typename Layer>
struct Mixed
{
    Layer out {};
    List level;
    double reduction = 0.0;
};
}   // namespace

plan::PortRef portOf (const plan::Flat& flat, int node, Role role, std::string_view id, int index)
{
    const auto& rows = flat.node (node).ports (role);
    return { .node = node, .role = role, .port = static_cast<int> (std::ranges::find (rows, id, &PortSheet::id) - rows.begin()), .index = index };
}

std::vector<std::size_t> tapsOf (const Plan& plan, const std::string& port)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < plan.taps().size(); ++i)
        if (isPartOf (plan.taps()[i].name, port)) found.push_back (i);
    return found;
}

ShadowMixer::ShadowMixer (const Plan& plan, int n)
    : node (n), path (plan.flat().node (n).path), width (plan.flat().node (n).type->info.id == std::string_view ("layer.mix_vectors") ? 3 : 1)
{
    const auto& flat = plan.flat();
    const auto& of = flat.node (node);
    layers = of.list_size;
    for (int i = 0; i < layers; ++i)
        for (const auto tap : tapsOf (plan, flat.nameOf (portOf (flat, node, Role::input, "in", i))))
            in.push_back (&plan.taps()[tap]);
    for (const auto tap : tapsOf (plan, flat.nameOf (portOf (flat, node, Role::output, "out"))))
        out.push_back (&plan.taps()[tap]);
    const double speed = flat.speed (of.section);
    times = std::max (1, static_cast<int> (std::lround (speed)));
    period = std::max (1, static_cast<int> (std::lround (1.0 / speed)));
    numbers.prepare (1.0 / (plan.rateHz() * speed));
    vectors.prepare (1.0 / (plan.rateHz() * speed));
    const auto& instance = plan.instances()[static_cast<std::size_t> (node)];
    const auto knob = [&] (std::string_view id) {
        const auto row = static_cast<std::size_t> (portOf (flat, node, Role::param, id).port);
        return instance.param (plan::Knobs::indexOf (*of.type, row, 0));
    };
    given = { knob ("gain"), knob ("mute"), knob ("solo"), knob ("priority"), knob ("duck_db"), knob ("ceiling") };
    values.resize (in.size());
    for (const auto& v : values)
        sources.push_back (&v);
    made.resize (static_cast<std::size_t> (times) * in.size());
}

template <typename Layer>
void ShadowMixer::mix (MixingDesk<Layer>& desk, const DeskParams& params, int t)
{
    const auto mixed = desk.template mix<Mixed<Layer>> (InputList<Layer> (sources.data(), layers), params);
    const bool is_whole = std::ranges::all_of (values, [] (double v) { return std::isfinite (v); });
    auto* const to = made.data() + static_cast<std::size_t> (t) * in.size();
    for (int i = 0; i < layers; ++i)
        for (std::size_t c = 0; c < width; ++c)
        {
            const auto k = static_cast<std::size_t> (i) * width + c;
            to[k] = is_whole ? desk.factor (i, params) * values[k] * std::pow (10.0, -mixed.reduction / 20.0) : 0.0;
        }
    for (std::size_t c = 0; c < width && c < out.size(); ++c)
    {
        double sum = 0.0;
        for (int i = 0; i < layers; ++i)
            sum += to[static_cast<std::size_t> (i) * width + c];
        const double real = out[c]->sample (t, times);
        if (! std::isfinite (sum) || ! std::isfinite (real)) continue;
        difference = std::max (difference, std::abs (real - sum));
        peak = std::max (peak, std::abs (real));
    }
}

void ShadowMixer::tick (std::uint64_t number)
{
    DeskParams params;
    for (int i = 0; i < layers; ++i)
    {
        params.gain[i] = given[0][i];
        params.mute[i] = given[1][i];
        params.solo[i] = given[2][i];
        params.priority[i] = given[3][i];
    }
    params.duck_db = *given[4];
    params.ceiling = *given[5];
    if (number % static_cast<std::uint64_t> (period) != 0) return;
    numbers.update (params, layers);
    vectors.update (params, layers);
    for (int t = 0; t < times; ++t)
    {
        for (std::size_t k = 0; k < in.size(); ++k)
            values[k] = in[k]->sample (t, times);
        width == 3 ? mix (vectors, params, t) : mix (numbers, params, t);
    }
}

double ShadowMixer::part (int layer, std::size_t component, int i, int n) const
{
    const auto t = static_cast<std::size_t> (((i + 1) * times + n - 1) / n - 1);
    return made[t * in.size() + static_cast<std::size_t> (layer) * width + component];
}

}   // namespace tactus::host
