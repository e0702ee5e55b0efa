// SPDX-License-Identifier: GPL-3.0-or-later
#include "wire_rules.hpp"

#include <array>

namespace tactus::host
{

Unit unitOf (Quantity q) noexcept
{
    constexpr std::array units { unit::metre, unit::radian, unit::speed, unit::newton, unit::torque, unit::joule, unit::hit, unit::kilogram,
                                 unit::stiffness, unit::damping, unit::hertz, unit::per_second, unit::per_metre, unit::gain, unit::state };
    for (const auto& u : units)
        if (u.quantity == q) return u;
    return {};
}

bool addsUp (Quantity q) noexcept { return q == Quantity::force || q == Quantity::torque || q == Quantity::hit; }

Result<> checkWireByComponent (const WireEnd& from, const WireEnd& to)
{
    const auto refuse = [] (std::string why) { return Message::error ("wire/refused", {}, std::move (why)); };
    if (from.port->role != Role::output) return refuse ("a wire starts at an output");
    if (to.port->role == Role::output) return refuse ("a wire ends at an input or a parameter");
    if (to.port->isChoice()) return refuse ("a list of choices cannot be wired");

    const auto unitAt = [] (const WireEnd& e) -> std::optional<Unit> {
        if (e.port->unit.kind == UnitRule::Kind::fixed) return e.port->unit.unit;
        if (e.quantity != Quantity::any) return unitOf (e.quantity);
        return std::nullopt;
    };
    const auto a = unitAt (from), b = unitAt (to);
    if (a && b && a->dimension != b->dimension) return refuse (std::string (a->symbol) + " does not fit " + std::string (b->symbol));
    return {};
}

Result<> checkWire (const WireEnd& from, const WireEnd& to)
{
    auto checked = checkWireByComponent (from, to);
    if (! checked || from.port->width == to.port->width) return checked;
    return Message::error ("wire/refused", {}, from.port->width == 3 ? "a vector does not fit a scalar" : "a scalar does not fit a vector");
}

}   // namespace tactus::host
