// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/node/generic.hpp>

/// Nodes with the ports that the reference graph wires, but of a few instructions each. They model nothing: with them, a tick consists
/// mostly of what the framework does around its nodes.
namespace tactus::bench::light
{

constexpr Info infoOf (std::string_view id) { return { .id = id, .name = id, .summary = "A few instructions, for the bench.", .source = "definition" }; }

/// A stand-in for motion.velocity.
struct Speed
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };
    using Params = Empty;
    struct Outputs
    {
        double speed = 0.0;
    };
    static constexpr Info info = infoOf ("light.speed");
    static constexpr std::tuple ports { input (&Inputs::position, "position", unit::metre, "position"),
                                        output (&Outputs::speed, "speed", unit::speed, "of x") };
    Params params;
    Outputs tick (const Inputs& in) noexcept
    {
        const double step = in.position.x() - before;
        before = in.position.x();
        return { 4000.0 * step };
    }

private:
    double before = 0.0;
};

/// A stand-in for deform.surface.
struct Floor
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };
    using Params = Empty;
    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        double resistance = 0.0;
        double depth = 0.0;
        Vec3 normal = Vec3::UnitZ();
    };
    static constexpr Info info = infoOf ("light.floor");
    static constexpr std::tuple ports { input (&Inputs::position, "position", unit::metre, "position"),
                                        output (&Outputs::force, "force", unit::newton, "upwards"),
                                        output (&Outputs::resistance, "resistance", unit::newton, "its magnitude"),
                                        output (&Outputs::depth, "depth", unit::metre, "below 0"),
                                        output (&Outputs::normal, "normal", unit::gain, "upwards") };
    Params params;
    Outputs tick (const Inputs& in) noexcept
    {
        const double depth = std::max (0.0, -in.position.z()), push = 500.0 * depth;
        return { .force = { 0.0, 0.0, push }, .resistance = push, .depth = depth };
    }
};

/// A stand-in for friction.elasto_plastic.
struct Drag
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero(), normal = Vec3::UnitZ();
        double normal_force = 1.0;
    };
    using Params = Empty;
    struct Outputs
    {
        Vec3 force = Vec3::Zero();
    };
    static constexpr Info info = infoOf ("light.drag");
    static constexpr std::tuple ports { input (&Inputs::position, "position", unit::metre, "position"),
                                        input (&Inputs::normal, "normal", unit::gain, "out of the floor"),
                                        input (&Inputs::normal_force, "normal_force", unit::newton, "on the floor"),
                                        output (&Outputs::force, "force", unit::newton, "against the motion") };
    Params params;
    Outputs tick (const Inputs& in) noexcept
    {
        const double along = in.position.dot (in.normal), slid = along - before;
        before = along;
        return { .force = in.normal_force * slid * in.position };
    }

private:
    double before = 0.0;
};

/// A stand-in for texture.grating.
struct Ridges
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };
    using Params = Empty;
    struct Outputs
    {
        Vec3 force = Vec3::Zero();
    };
    static constexpr Info info = infoOf ("light.ridges");
    static constexpr std::tuple ports { input (&Inputs::position, "position", unit::metre, "position"),
                                        output (&Outputs::force, "force", unit::newton, "towards the origin") };
    Params params;
    Outputs tick (const Inputs& in) noexcept { return { .force = -2.0 * in.position }; }
};

/// A stand-in for texture.noise.
struct Noise
{
    struct Inputs
    {
        double speed = 0.0, normal_force = 0.0;
    };
    using Params = Empty;
    struct Outputs
    {
        double value = 0.0;
    };
    static constexpr Info info = infoOf ("light.noise");
    static constexpr std::tuple ports { input (&Inputs::speed, "speed", unit::speed, "speed"),
                                        input (&Inputs::normal_force, "normal_force", unit::newton, "load"),
                                        output (&Outputs::value, "value", unit::newton, "their product") };
    Params params;
    Outputs tick (const Inputs& in) noexcept { return { in.speed * in.normal_force }; }
};

/// A stand-in for contact.window.
struct Window
{
    struct Inputs
    {
        double depth = 0.0;
    };
    using Params = Empty;
    struct Outputs
    {
        double gain = 0.0;
    };
    static constexpr Info info = infoOf ("light.window");
    static constexpr std::tuple ports { input (&Inputs::depth, "depth", unit::metre, "depth"), output (&Outputs::gain, "gain", unit::gain, "up to 1") };
    Params params;
    Outputs tick (const Inputs& in) noexcept { return { std::min (1.0, 5000.0 * in.depth) }; }
};

/// A stand-in for contact.impact.
struct Landing
{
    struct Inputs
    {
        double depth = 0.0;
    };
    using Params = Empty;
    struct Outputs
    {
        double hit = 0.0;
        double contact = 0.0;
    };
    static constexpr Info info = infoOf ("light.landing");
    static constexpr std::tuple ports { input (&Inputs::depth, "depth", unit::metre, "depth"), output (&Outputs::hit, "hit", unit::hit, "at the touch"),
                                        output (&Outputs::contact, "contact", unit::state, "1 in contact") };
    Params params;
    Outputs tick (const Inputs& in) noexcept
    {
        const double contact = in.depth > 0.0 ? 1.0 : 0.0, hit = (contact - before) * contact;
        before = contact;
        return { .hit = hit, .contact = contact };
    }

private:
    double before = 0.0;
};

/// The number that the decaying kernels below add on each tick, so that they never reach subnormal numbers, which take much longer to compute with.
inline constexpr double little = 1e-9;

/// A stand-in for shock.hunt_crossley.
struct Shock
{
    struct Inputs
    {
        double hit = 0.0;
    };
    using Params = Empty;
    struct Outputs
    {
        double resistance = 0.0;
    };
    static constexpr Info info = infoOf ("light.shock");
    static constexpr std::tuple ports { input (&Inputs::hit, "hit", unit::hit, "hit"), output (&Outputs::resistance, "resistance", unit::newton, "decays") };
    Params params;
    Outputs tick (const Inputs& in) noexcept { return { left = 0.9 * left + in.hit + little }; }

private:
    double left = 0.0;
};

/// A stand-in for vibration.modal.
struct Ring
{
    using Inputs = Shock::Inputs;
    using Params = Empty;
    struct Outputs
    {
        double value = 0.0;
    };
    static constexpr Info info = infoOf ("light.ring");
    static constexpr std::tuple ports { input (&Inputs::hit, "hit", unit::hit, "hit"), output (&Outputs::value, "value", unit::newton, "decays") };
    Params params;
    Outputs tick (const Inputs& in) noexcept { return { left = 0.99 * left + in.hit + little }; }

private:
    double left = 0.0;
};

/// A stand-in for safety.passivity.
struct Passivity
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero(), force = Vec3::Zero();
        double contact = 1.0;
    };
    using Params = Empty;
    struct Outputs
    {
        Vec3 force = Vec3::Zero();
    };
    static constexpr Info info = infoOf ("light.passivity");
    static constexpr std::tuple ports { input (&Inputs::position, "position", unit::metre, "position"),
                                        input (&Inputs::force, "force", unit::newton, "force"), input (&Inputs::contact, "contact", unit::state, "contact"),
                                        output (&Outputs::force, "force", unit::newton, "braked") };
    Params params;
    Outputs tick (const Inputs& in) noexcept { return { .force = in.force - in.contact * in.position }; }
};

/// A stand-in for hold.predictive.
struct Limit
{
    struct Inputs
    {
        Vec3 in = Vec3::Zero();
        double contact = 1.0;
    };
    using Params = Empty;
    using Outputs = Out<Vec3>;
    static constexpr Info info = infoOf ("light.limit");
    static constexpr std::tuple ports { input (&Inputs::in, "in", unit::newton, "force"), input (&Inputs::contact, "contact", unit::state, "contact"),
                                        output (&Outputs::out, "out", unit::newton, "half of it without contact") };
    Params params;
    Outputs tick (const Inputs& in) noexcept { return { .out = (0.5 + 0.5 * in.contact) * in.in }; }
};

}   // namespace tactus::bench::light
