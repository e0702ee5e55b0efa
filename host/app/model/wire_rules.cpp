// SPDX-License-Identifier: GPL-3.0-or-later
#include "wire_rules.hpp"
#include "quantity_text.hpp"

#include <host/app/text/filled.hpp>

#include <algorithm>
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

namespace
{
/// "length (m)", "gain"
std::string described (const Unit& u)
{
    std::string text (name (u.quantity));
    std::ranges::replace (text, '_', ' ');
    return u.symbol == "1" ? text : text + " (" + unitShown (std::string (u.symbol)) + ")";
}
}   // namespace

Result<> checkWireByComponent (const WireEnd& from, const WireEnd& to)
{
    const auto refuse = [] (const juce::String& why) { return Message::error ("wire/refused", {}, why.toStdString()); };
    if (from.port->role != Role::output) return refuse (TRANS ("A wire starts at an output"));
    if (to.port->role == Role::output) return refuse (TRANS ("A wire ends at an input or a parameter"));
    if (to.port->isChoice()) return refuse (TRANS ("A list of choices cannot be wired"));

    const auto unitAt = [] (const WireEnd& e) -> std::optional<Unit> {
        if (e.port->unit.kind == UnitRule::Kind::fixed) return e.port->unit.unit;
        if (e.quantity != Quantity::any) return unitOf (e.quantity);
        return std::nullopt;
    };
    const auto a = unitAt (from), b = unitAt (to);
    if (a && b && a->dimension != b->dimension)
    {
        const auto why = filled (TRANS ("%1 cannot drive %2"), described (*a), described (*b));
        return refuse (why.substring (0, 1).toUpperCase() + why.substring (1));
    }
    return {};
}

Result<> checkWire (const WireEnd& from, const WireEnd& to)
{
    auto checked = checkWireByComponent (from, to);
    if (! checked || from.port->width == to.port->width) return checked;
    return Message::error ("wire/refused", {},
                           (from.port->width == 3 ? TRANS ("A vector cannot drive a number") : TRANS ("A number cannot drive a vector")).toStdString());
}

}   // namespace tactus::host
