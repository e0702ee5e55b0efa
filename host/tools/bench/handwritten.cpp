// SPDX-License-Identifier: GPL-3.0-or-later
// The reference graph as one would write it without a framework: the kernels are called one after another, values are passed in local
// variables, and sums and products are computed where they are needed. Alone in its file, because the compiler inlines less of it if there is other
// code: 7746 instructions instead of 7656.
#include "bench.hpp"
#include "kernels.hpp"

#include <tactus/run/device/make_device.hpp>
#include <tactus/run/guard.hpp>

namespace tactus::bench
{

namespace
{
class Handwritten : public Variant
{
public:
    Handwritten() : k (device) {}

    void tick (const double* in) noexcept override;

    std::vector<double> outputs() const override
    {
        const Vec3 f = k.motor.effort().force;
        return { f.x(), f.y(), f.z() };
    }

protected:
    DeviceState device;
    Kernels k;
};

/// The same, followed by the guard of the preset's device, which exported code contains.
class Guarded final : public Handwritten
{
public:
    Guarded()
    {
        const auto made = makeDevice (reference().devices.front().second, {});
        guard.prepare (made.limits, kernel_setup.dt_s(), made.device->layout());
    }

    void tick (const double* in) noexcept override
    {
        Handwritten::tick (in);
        given = guard (k.motor.effort(), device.reading);
    }

    std::vector<double> outputs() const override { return { given.force.x(), given.force.y(), given.force.z() }; }

private:
    Guard guard;
    Effort given;
};

void Handwritten::tick (const double* in) noexcept
{
    device.reading.position = { in[0], in[1], in[2] };

    const Vec3 p = k.hand.tick ({}).position;
    const double speed = k.motion.tick ({ .position = p }).speed;
    const auto foam = k.foam.tick ({ .position = p });
    const Vec3 drag = k.drag.tick ({ .position = p, .normal = foam.normal, .normal_force = foam.resistance }).force;

    const Vec3 cloth = k.ribs.tick ({ p }).force + k.warp.tick ({ p }).force + k.weft.tick ({ p }).force;
    const Vec3 felt = k.touch.tick ({ foam.depth }).gain * cloth;

    const auto landing = k.landing.tick ({ -p.z() });
    const double thud = k.thud.tick ({ landing.hit }).resistance;
    const double wood = k.wood.tick ({ landing.hit }).value;
    const double bump = thud + wood + k.hiss.tick ({ .speed = speed, .normal_force = foam.resistance }).value;

    const Vec3 all = foam.force + drag + felt + bump * foam.normal;
    const Vec3 calm = k.calm.tick ({ .position = p, .force = all, .contact = landing.contact }).force;
    k.motor.tick ({ .force = k.limit.tick ({ .in = calm, .contact = landing.contact }).out });
}
}   // namespace

std::unique_ptr<Variant> handwritten() { return std::make_unique<Handwritten>(); }
std::unique_ptr<Variant> handwrittenWithGuard() { return std::make_unique<Guarded>(); }

}   // namespace tactus::bench
