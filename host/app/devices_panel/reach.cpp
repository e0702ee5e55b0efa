// SPDX-License-Identifier: GPL-3.0-or-later
#include "reach.hpp"
#include "binding_choice.hpp"

#include <host/devices/hid/calibration.hpp>
#include <host/devices/hid/physics.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// The travel that a person has measured: from end to end, with 0 in the middle.
std::optional<DeviceReach> boxOfTravel (const Json& binding)
{
    Messages told_elsewhere;
    const auto calibration = hid::readCalibration (binding, told_elsewhere, false);
    if (! calibration || calibration->turns) return std::nullopt;
    Vec3 half = Vec3::Zero();
    for (const auto& [axis, travel] : calibration->travel)
        if (axis == "x" || axis == "y" || axis == "z") half[axis[0] - 'x'] = 0.5 * travel;
    if (half.isZero (0.0)) return std::nullopt;
    return DeviceReach { .min = -half, .max = half };
}
}   // namespace

std::optional<DeviceReach> boxOf (const Json& binding, const hid::LoadedProfiles& profiles)
{
    if (! binding.is_object()) return std::nullopt;
    if (const auto name = binding.find ("profile"); name != binding.end() && name->is_string())
        if (const auto profile = hid::profileNamed (profiles, name->asString())) return hid::numbersOf (*profile).workspace;
    if (binding.contains ("calibration")) return boxOfTravel (binding);
    const auto withoutHand = [] (Json b) {
        b = deviceOfBinding (std::move (b));
        b.erase ("hand");
        return b;
    };
    const auto device = withoutHand (binding);
    for (const auto& profile : profiles.profiles)
        if (hid::isNumbersOnly (*profile) && withoutHand (simulationOf (*profile, nullptr)) == device) return hid::numbersOf (*profile).workspace;
    return std::nullopt;
}

std::vector<scene::Reach> Reaches::of (const LiveRun& run)
{
    std::vector<scene::Reach> all;
    for (const auto& needs : run.needs())
    {
        const auto* binding = setup.session().session.binding (needs.role);
        const auto workspace = binding != nullptr ? run.workspaceOf (needs.role) : std::nullopt;
        if (! workspace) continue;
        auto& of_role = known[needs.role];
        if (of_role.binding != *binding) of_role = { *binding, boxOf (*binding, setup.profiles()) };
        scene::Reach reach { .role = needs.role, .origin = workspace->offset, .middle = workspace->offset };
        if (const auto& box = of_role.box)
        {
            reach.middle += workspace->scale * (workspace->axes * (0.5 * (box->min + box->max)));
            reach.half = workspace->scale * (workspace->axes * Vec3 (0.5 * (box->max - box->min)).asDiagonal());
        }
        all.push_back (std::move (reach));
    }
    return all;
}

}   // namespace tactus::host
