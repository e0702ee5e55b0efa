// SPDX-License-Identifier: MIT
#include "inverse3_messages.hpp"

#include <host/drivers/websocket/member.hpp>
#include <tactus/text/json_text.hpp>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <optional>

namespace tactus::host
{

namespace
{
/// The finite number there.
std::optional<double> numberAt (const Json* from, const char* key)
{
    const auto* at = member (from, key);
    if (at == nullptr || ! at->is_number()) return std::nullopt;
    const double number = at->get<double>();
    return std::isfinite (number) ? std::optional (number) : std::nullopt;
}

std::optional<Vec3> vectorAt (const Json* from)
{
    const auto x = numberAt (from, "x"), y = numberAt (from, "y"), z = numberAt (from, "z");
    if (! x || ! y || ! z) return std::nullopt;
    return Vec3 { *x, *y, *z };
}

/// The rotation vector of a quaternion, of any length but 0.
std::optional<Vec3> rotationAt (const Json* from)
{
    const auto v = vectorAt (from);
    const auto w = numberAt (from, "w");
    if (! v || ! w) return std::nullopt;
    const double sine = std::hypot ((*v)[0], (*v)[1], (*v)[2]);
    if (! std::isfinite (sine) || (sine == 0.0 && *w == 0.0)) return std::nullopt;
    const double sign = *w < 0.0 ? -1.0 : 1.0;   // the shorter way round
    const double angle = sign * 2.0 * std::atan2 (sine, sign * *w);
    return Vec3 (*v / (sine > 0.0 ? sine : 1.0) * angle);
}
}   // namespace

std::string Inverse3Messages::configure (const Json& description)
{
    wanted_id = textAt (description, "device_id");
    grip = textAt (description, "grip");
    spelling = member (description, "spelling") != nullptr ? textAt (description, "spelling") : "values";
    if (! grip.empty() && grip != "wireless" && grip != "wired") return "\"grip\" is wireless or wired, or left out";
    if (spelling != "values" && spelling != "vector") return "\"spelling\" is values (the service up to 3.1) or vector (since 3.5)";
    return {};
}

std::string Inverse3Messages::readInventory (std::string_view message)
{
    const auto all = readJson (message).root;
    const auto* arms = member (all, "inverse3");
    if (arms == nullptr || ! arms->is_array() || arms->size() == 0) return "the service knows no Inverse3";
    id = wanted_id;
    if (id.empty())
    {
        if (arms->size() > 1) return "the service knows several Inverse3: choose one with \"device_id\"";
        id = textAt ((*arms)[0], "device_id");
    }
    const auto* arm = armIn (all);
    if (arm == nullptr) return "the service knows no Inverse3 with the id " + id;
    for (const char c : id)
        if (! std::isalnum (static_cast<unsigned char> (c)) && c != '-' && c != '_') return "the id of the Inverse3 has characters that no id has";
    const auto* calibrated = member (member (arm, "status"), "calibrated");
    if (calibrated != nullptr && *calibrated == Json (false)) return "the Inverse3 is not calibrated";
    return {};
}

std::string Inverse3Messages::read (std::string_view message, Inverse3State& to) const
{
    const auto text = readJson (message);
    if (! text.messages.empty()) return "the service sent something that is not JSON";
    const auto* arm = armIn (text.root);
    if (arm == nullptr) return "the service no longer knows the Inverse3 " + id;
    Inverse3State state;
    const auto* of_arm = member (arm, "state");
    const auto position = vectorAt (member (of_arm, "cursor_position"));
    if (! position) return "the service does not say where the cursor is";
    state.position = *position;
    state.is_idle = textAt (*of_arm, "control_mode") == "idle";
    if (hasGrip())
    {
        const auto* grips = member (text.root, grip == "wireless" ? "wireless_verse_grip" : "verse_grip");
        const auto* of_grip = grips != nullptr && grips->is_array() && grips->size() > 0 ? member ((*grips)[0], "state") : nullptr;
        const auto rotation = rotationAt (member (of_grip, "orientation"));
        if (! rotation) return "the service does not say how the grip is held";
        state.rotation = *rotation;
        const auto* pressed = member (of_grip, "buttons");
        for (std::size_t i = 0; i < buttons.size(); ++i)
            if (const auto* down = member (pressed, buttons[i]); down != nullptr && *down == Json (true)) state.buttons |= 1u << i;
    }
    to = state;
    return {};
}

std::string Inverse3Messages::push (const Vec3& newtons) const
{
    std::array<char, 160> text {};
    std::snprintf (text.data(), text.size(), R"("set_cursor_force":{"%s":{"x":%.15g,"y":%.15g,"z":%.15g}})", spelling.c_str(), newtons[0], newtons[1],
                   newtons[2]);
    return command (text.data());
}

std::string Inverse3Messages::probe() const { return command (R"("probe_position":{})"); }

std::string Inverse3Messages::command (const std::string& text) const
{
    return R"({"inverse3":[{"device_id":")" + id + R"(","commands":{)" + text + "}}]}";
}

const Json* Inverse3Messages::armIn (const Json& message) const
{
    const auto* arms = member (message, "inverse3");
    if (arms == nullptr || ! arms->is_array()) return nullptr;
    for (const auto& arm : *arms)
        if (textAt (arm, "device_id") == id) return &arm;
    return nullptr;
}

}   // namespace tactus::host
