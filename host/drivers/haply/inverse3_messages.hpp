// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>
#include <tactus/text/json.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace tactus::host
{

/// The state of an arm and its grip.
struct Inverse3State
{
    Vec3 position = Vec3::Zero(), rotation = Vec3::Zero();   ///< the rotation is 0 without a grip
    std::uint32_t buttons = 0;
    bool is_idle = false;   ///< the arm says that it renders no force
};

/// The messages that pass between Haply's service and a program: JSON, as its public description says. The same text gives the same state. [one thread]
class Inverse3Messages
{
public:
    static constexpr std::array<const char*, 4> buttons { "a", "b", "c", "home" };      ///< of a grip, by bit
    static constexpr auto question = R"({"session":{"force_render_full_state":{}}})";   ///< asks a service that does not send the first message for its state

    /// Takes what the person asks for: "device_id", "grip" and "spelling". Returns what is wrong with it; empty: nothing.
    std::string configure (const Json& description);

    bool hasGrip() const noexcept { return ! grip.empty(); }

    /// Finds the arm in the first message of a service. Returns why there is none; empty if there is.
    std::string readInventory (std::string_view message);

    const std::string& arm() const noexcept { return id; }   ///< which arm that is

    /// Reads where the arm is, after readInventory(). Returns what is wrong with the message; empty: nothing.
    std::string read (std::string_view message, Inverse3State&) const;

    std::string push (const Vec3& newtons) const;   ///< a force, for one tick of the service
    std::string probe() const;                      ///< asks where the arm is

private:
    const Json* armIn (const Json& message) const;
    std::string command (const std::string& text) const;

    std::string wanted_id, grip, spelling = "values";
    std::string id;   // of the arm
};

}   // namespace tactus::host
