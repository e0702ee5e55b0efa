// SPDX-License-Identifier: GPL-3.0-or-later
// The wiring of the reference graph, with kernels of a few instructions. They are in a header, because fused code includes them.
#include "bench.hpp"
#include "light_nodes.hpp"

#include <tactus/nodes/device/force.hpp>
#include <tactus/nodes/device/position.hpp>

namespace tactus::bench
{

namespace
{
class LightByHand final : public Variant
{
public:
    LightByHand()
    {
        hand.bind (device);
        motor.bind (device);
    }

    void tick (const double* in) noexcept override;

    std::vector<double> outputs() const override
    {
        const Vec3 f = motor.effort().force;
        return { f.x(), f.y(), f.z() };
    }

private:
    DeviceState device;
    nodes::DevicePosition hand;
    light::Speed motion;
    light::Floor foam;
    light::Drag drag;
    light::Ridges ribs, warp, weft;
    light::Noise hiss;
    light::Window touch;
    light::Landing landing;
    light::Shock thud;
    light::Ring wood;
    light::Passivity calm;
    light::Limit limit;
    nodes::DeviceForce motor;
};

void LightByHand::tick (const double* in) noexcept
{
    device.reading.position = { in[0], in[1], in[2] };

    const Vec3 p = hand.tick ({}).position;
    const double speed = motion.tick ({ p }).speed;
    const auto floor = foam.tick ({ p });
    const Vec3 rub = drag.tick ({ .position = p, .normal = floor.normal, .normal_force = floor.resistance }).force;

    const Vec3 cloth = ribs.tick ({ p }).force + warp.tick ({ p }).force + weft.tick ({ p }).force;
    const Vec3 felt = touch.tick ({ floor.depth }).gain * cloth;

    const auto landed = landing.tick ({ -p.z() });
    const double shock = thud.tick ({ landed.hit }).resistance, ring = wood.tick ({ landed.hit }).value;
    const double bump = shock + ring + hiss.tick ({ .speed = speed, .normal_force = floor.resistance }).value;

    const Vec3 all = floor.force + rub + felt + bump * floor.normal;
    const Vec3 braked = calm.tick ({ .position = p, .force = all, .contact = landed.contact }).force;
    motor.tick ({ .force = limit.tick ({ .in = braked, .contact = landed.contact }).out });
}

/// The types of nodes that replace the large kernels of the reference graph.
const std::map<std::string, std::string, std::less<>> light_types {
    { "motion.velocity", "light.speed" },
    { "deform.surface", "light.floor" },
    { "friction.elasto_plastic", "light.drag" },
    { "texture.grating", "light.ridges" },
    { "texture.noise", "light.noise" },
    { "contact.window", "light.window" },
    { "contact.impact", "light.landing" },
    { "shock.hunt_crossley", "light.shock" },
    { "vibration.modal", "light.ring" },
    { "safety.passivity", "light.passivity" },
    { "hold.predictive", "light.limit" },
};

graph::Graph lightGraph()
{
    auto g = reference();
    g.controls.clear();
    for (auto& node : g.root.nodes)
        if (const auto type = light_types.find (node.type); type != light_types.end())
        {
            node.type = type->second;
            node.params = node.settings = Json::object();
        }
    return g;
}

Catalogue lightTypes()
{
    using namespace light;
    return catalogue().with ({ describe<Speed>(), describe<Floor>(), describe<Drag>(), describe<Ridges>(), describe<Noise>(), describe<Window>(),
                               describe<Landing>(), describe<Shock>(), describe<Ring>(), describe<Passivity>(), describe<Limit>() });
}
}   // namespace

std::vector<Contest> lightContests()
{
    const auto plan = [] { return std::make_unique<Planned> (lightGraph(), CompileOptions {}, lightTypes()); };
    const auto* about = "reference graph with light kernels";
    return { { "light_plan/hand", "plan", "hand-written", about, plan, make<LightByHand>, strokeOver (reference()) } };
}

}   // namespace tactus::bench
