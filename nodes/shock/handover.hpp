// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <numbers>

namespace tactus::nodes
{

/// One contact for the hand: the measured one while the tool lies still or presses, the played shock while it bounces.
///
/// From a hit until the shock has ended, the measured position is ignored and only the played force acts. Then the contact takes
/// over again. The force does not jump at either change:
///
///     resistance = max (0, s + r w)      s: `shock` on a hit and while `shock` is above 0, else `contact`
///     r = last resistance - s            when s changes from one to the other
///     w = (1 + cos (pi t / fade)) / 2    t: time since that change; w is 0 after `fade`
///
/// So the force starts from its last value, and the difference fades to 0 within `fade`. For a contact with a spring, handing back
/// means that the surface starts where the tool is when the shock ends, and moves back to its place within `fade`.
///
/// Wire plane.resistance (or surface.resistance) into `contact`, shock.hunt_crossley's resistance into `shock`, and the same hit into
/// `hit` as into the player. Use the output in place of the contact's: for the force along the normal, and as the normal force of
/// friction.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 6: a shock is over before the hand can respond, so it can
/// be played while the measured position is ignored. The law of the handover is our own: the bumpless transfer of control
/// engineering, with a raised cosine.
///
/// Energy: it stores none, but a surface that moves does work. Handing back to a contact gives the tool at most the energy that
/// the contact stores at the deepest point that the tool reaches within `fade`. The played shock, too, can give energy that the hand
/// did not put in. So this node is not passive, even if its inputs are. With `fade` infinite, the surface stays where the tool was at
/// the end of the shock until the tool leaves, and handing back gives no energy.
///
/// Good to know
///  - A touch without a hit, for example one slower than contact.impact's min_speed, is rendered by the measured contact alone.
///  - A hit while the shock sounds changes nothing here; the player adds the hits.
///  - The per-tick change of the output is at most that of the rendered input plus pi/2 |r| T / fade.
///  - A `contact` or `shock` below 0 counts as 0.
struct Handover
{
    struct Inputs
    {
        double contact = 0.0;
        double shock = 0.0;
        double hit = 0.0;
    };

    struct Params
    {
        double fade = 0.02;
    };

    struct Outputs
    {
        double resistance = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "shock.handover",
        .name = "Shock handover",
        .summary = "Hands over from a contact to a played shock and back without a jump of the force.",
        .source = "Hayward 2007, section 6; law of the handover: own",
        .keywords = "collision",
    };

    static constexpr std::tuple ports {
        input (&Inputs::contact, "contact", unit::newton, "resistance of the measured contact"),
        input (&Inputs::shock, "shock", unit::newton, "resistance of the played shock"),
        input (&Inputs::hit, "hit", unit::hit, "the hit that starts the shock"),
        param (&Params::fade, "fade", unit::second, "duration of the change from one force to the other", { .hard = { 1e-3, inf }, .usual = { 0.005, 0.2 } }),
        output (&Outputs::resistance, "resistance", unit::newton, "force out of the object"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 contact, 2 shock: the measured contact is ignored"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { dt = setup.dt_s(); }

    void adopt (const Handover& old) noexcept
    {
        source = old.source;
        last = old.last;
        difference = old.difference;
        faded = old.faded;
    }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.contact, in.shock))
        {
            source = Source::none;
            difference = 0.0;
            return { .state = -1.0 };
        }

        const double contact = std::max (0.0, in.contact), shock = std::max (0.0, in.shock);
        const bool is_hit = in.hit > 0.0 && isFinite (in.hit);
        const auto now = is_hit || shock > 0.0 ? Source::shock : Source::contact;
        const double rendered = now == Source::shock ? shock : contact;
        if (source != Source::none && now != source)
            begin (last - rendered);
        else
            faded = std::min (1.0, faded + dt / params.fade);
        if (now == Source::contact && contact == 0.0 && difference < 0.0) difference = 0.0;   // the tool has left: the surface returns to its place at once
        source = now;

        const double left = faded < 1.0 ? 0.5 * (1.0 + math::cos (std::numbers::pi * faded)) : 0.0;
        last = std::max (0.0, rendered + difference * left);
        if (! isFinite (last)) last = rendered;
        const bool is_open = now == Source::contact && last == 0.0 && contact == 0.0;
        return { .resistance = last, .state = now == Source::shock ? 2.0 : (is_open ? 0.0 : 1.0) };
    }

    void serialize (auto& archive) { archive (source, last, difference, faded); }

private:
    enum class Source
    {
        none,   // before the first finite sample
        contact,
        shock
    };

    void begin (double from) noexcept
    {
        difference = isFinite (from) ? from : 0.0;
        faded = 0.0;
    }

    double dt = 1.0 / Setup {}.rate_hz;   // s
    Source source = Source::none;
    double last = 0.0;         // the last output, N
    double difference = 0.0;   // r, N
    double faded = 1.0;        // t / fade, at most 1
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Handover);
