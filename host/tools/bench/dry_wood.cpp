// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.hpp"
#include "kernels.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/nodes/deform/plane.hpp>

#include <string_view>

namespace tactus::bench
{

std::string_view dryWoodText() noexcept;   // graphs/dry_wood.json, written by embed.cmake

namespace
{
/// The preset as one would write it without a framework.
class DryWoodByHand final : public Variant
{
public:
    DryWoodByHand()
    {
        board.params.stiffness = 2000.0;
        board.params.damping = 0.3;
        board.settings.window = 1e-3;
        drag.params = { .mu = 0.4, .d_max = 7e-4, .static_ratio = 1.5, .reference_load = 0.9 };
        touch.params.window = 2e-4;
        grain.params = { .amplitude = 0.06, .spatial_frequency = 1200.0 };
        hand.bind (device);
        motor.bind (device);
        start (board), start (drag), start (grain);
    }

    void tick (const double* in) noexcept override
    {
        device.reading.position = { in[0], in[1], in[2] };

        const Vec3 p = hand.tick ({}).position;
        const auto wood = board.tick ({ p });
        const Vec3 rub = drag.tick ({ .position = p, .normal_force = wood.resistance }).force;
        const Vec3 ridges = touch.tick ({ wood.depth }).gain * grain.tick ({ p }).force;
        motor.tick ({ .force = wood.force + rub + ridges });
    }

    std::vector<double> outputs() const override
    {
        const Vec3 f = motor.effort().force;
        return { f.x(), f.y(), f.z() };
    }

private:
    DeviceState device;
    nodes::DevicePosition hand;
    nodes::Plane board;
    nodes::ElastoPlastic drag;
    nodes::ContactWindow touch;
    nodes::Grating grain;
    nodes::DeviceForce motor;
};
}   // namespace

std::vector<Contest> dryWoodContests()
{
    const auto g = readGraph (dryWoodText()).graph;
    return { { "dry_wood_plan/hand", "plan", "hand-written", "dry wood", planOf (g), make<DryWoodByHand>, strokeOver (g), 1e-12 } };
}

}   // namespace tactus::bench
