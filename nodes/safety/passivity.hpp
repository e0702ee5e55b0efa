// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <algorithm>

namespace tactus::nodes
{

/// Observes the energy that a virtual object has given to the hand, and brakes until it is paid back.
///
/// A hard wall computed from samples gives back more energy than it took, and buzzes. The observer counts the work of the hand
/// against the force as it was held. Whenever the balance is negative, the controller adds a damper:
///
///     E_n   = E_(n-1) - f_out(n-1) . dp_n                       observer, dp_n = p_n - p_(n-1)
///     alpha = min (-E T / |dp|^2, alpha_max)  if E < 0 and |dp| > 1e-9 m, else 0
///     f_out = f - alpha dp / T                                  controller
///
/// Source: Hannaford & Ryu 2002; Hayward, "Physically-Based Haptic Synthesis" (2007), section 1.
///
/// Departures from Hannaford and Ryu
///  - Pairing. The force held while the tool moved by dp_n is the force of the previous sample. `pairing: zoh` counts that force,
///    which is exact. `pairing: backward` is, as far as we know, theirs: f(n) with dp_n:
///        E_n = E_(n-1) - f_n . dp_n + alpha_(n-1) |dp_(n-1)|^2 / T
///    It credits a spring with sigma dp^2 / 2 per sample, as much as the hold leaks, so it does not see the leak: against a
///    buzzing wall it does nothing (see the test).
///  - Cap. Without one the damper itself is too much for the sampled mass, and the controller diverges: in 11 of 12 swept cases,
///    to 1e6 N. The bound is B + 2 M / T for a device of mass M and damping B, less with a wall behind it. alpha_max 0 means
///    mass / (2 T). More than 1.8 mass / T is never applied, whatever alpha_max is: at 2 mass / T a wall of 8000 N/m is calm for a
///    few seconds, and then throws the hand back with kilonewtons.
///
/// What to expect: a buzz of millimetres shrinks to a tenth or less (K = 3000 N/m, B = 0.5 N s/m, M = 0.1 kg, T = 1 ms,
/// a hand of 1.5 N: from 12 to 0.13 mm in 3 s), not to silence. With a cap, E dips below 0 for a while and then recovers.
///
/// Good to know
///  - `energy` is E before the correction of this sample.
///  - `contact` 0 resets the energy; without that, energy taken by real dampers could be given back later. Any other value keeps
///    the balance running.
///  - On the first sample, and after a fault, the force passes unchanged. A fault gives no force and keeps the energy; the motion
///    during the fault is not counted.
///  - `mass` is the mass of the device as the hand feels it. Too large a value makes the cap unsafe; with a mass of 0 the node
///    never brakes.
///  - T is the sampling period. A device with a delay needs a smaller alpha_max, and returns energy that the observer does not
///    see: it counts each force as acting from its own sample on.
///  - A change of `pairing` takes effect when `contact` is 0, after a fault, or on a restart.
///  - Limit the force after this node; the guard of the role does so in any case.
struct PassivityObserver
{
    enum class Pairing
    {
        zoh,
        backward
    };

    struct Inputs
    {
        Position position = Position::Zero();
        Vec3 force = Vec3::Zero();
        double contact = 1.0;
    };

    struct Params
    {
        double alpha_max = 0.0;
        double mass = 0.1;
        Pairing pairing = Pairing::zoh;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        double energy = 0.0;
        double alpha = 0.0;
    };

    static constexpr Info info {
        .id = "safety.passivity",
        .name = "Passivity observer and controller",
        .summary = "Brakes whenever an object has given back more energy than it took.",
        .source = "Hannaford & Ryu 2002; Hayward 2007, section 1",
        .keywords = "energy stability",
    };

    static constexpr std::string_view pairing_names[] { "zoh", "backward" };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::force, "force", unit::newton, "force f of the object on the tool"),
        input (&Inputs::contact, "contact", unit::state, "0 resets the energy"),
        param (&Params::alpha_max, "alpha_max", unit::damping, "largest damping that the node adds; 0: mass / (2 T); at most 1.8 mass / T",
               { .hard = { 0, inf }, .usual = { 0, 200 } }),
        param (&Params::mass, "mass", unit::kilogram, "mass of the device, as the hand feels it", { .hard = { 0, inf }, .usual = { 0, 1 } }),
        choice (&Params::pairing, "pairing", pairing_names, "the force that is paired with dp: the held one, or the new one"),
        output (&Outputs::force, "force", unit::newton, "f_out, force on the tool with the damper"),
        output (&Outputs::energy, "energy", unit::joule, "energy E taken from the hand since the reset, before correction"),
        output (&Outputs::alpha, "alpha", unit::damping, "damping that the node currently adds"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept
    {
        dt = setup.dt_s();
        account = {};
    }

    void adopt (const PassivityObserver& old) noexcept { account = old.account; }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.position, in.force, in.contact)) return fault();

        Account now = account;
        if (in.contact == 0.0) now.energy = 0.0;
        if (in.contact == 0.0 || ! now.known) now.pairing = params.pairing;

        const Vec3 dp = now.known ? Vec3 { in.position - now.p } : Vec3::Zero();
        const double square = dp.squaredNorm();
        if (now.known && in.contact != 0.0)
            now.energy += now.pairing == Pairing::zoh ? -now.force.dot (dp) : now.braked - in.force.dot (dp);

        const bool owes = now.energy < 0.0 && square > eps * eps;
        const double alpha = owes ? std::min (-now.energy * dt / square, cap()) : 0.0;

        now.p = in.position;
        now.force = in.force - alpha / dt * dp;
        now.braked = alpha * square / dt;
        now.known = true;
        if (! isFinite (now.force, now.energy, now.braked)) return fault();

        account = now;
        return { .force = now.force, .energy = now.energy, .alpha = alpha };
    }

    void serialize (auto& archive) { archive (account); }

private:
    static constexpr double eps = 1e-9;   // m; a shorter step carries no information

    double cap() const noexcept
    {
        const double momentum = params.mass / dt;   // the bound is twice this, plus the device's own damping
        return params.alpha_max > 0.0 ? std::min (params.alpha_max, 1.8 * momentum) : 0.5 * momentum;
    }

    Outputs fault() noexcept
    {
        account = { .energy = account.energy };
        return { .energy = account.energy };
    }

    struct Account
    {
        Position p = Position::Zero();   // position of the tool on the last sample
        Vec3 force = Vec3::Zero();       // applied on the last sample
        double energy = 0.0;             // J
        double braked = 0.0;             // energy that the damper took on the last sample, J
        Pairing pairing = Pairing::zoh;
        bool known = false;   // false until the first finite sample
    };

    double dt = 1.0 / Setup {}.rate_hz;   // s
    Account account;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::PassivityObserver);
