// SPDX-License-Identifier: GPL-3.0-or-later
#include "checked_roles.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid/physics.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/sessions/numbers_device.hpp>
#include <host/devices/sessions/role_fits.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

/// Reads --device: each option gives a role the numbers of a device, a hand, or both.
class Choices
{
public:
    Choices (const LoadedGraph& g, const fs::path& f, const hid::LoadedProfiles& p) : graph (g.graph), folder (f), profiles (p) {}

    std::vector<CheckedRole> read (const Plan& plan, const std::vector<std::string>& options)
    {
        for (const auto& role : plan.roles())
            roles.push_back (fromGraph (role.name));
        for (const auto& option : options)
            take (option);
        return std::move (roles);
    }

private:
    const graph::Graph& graph;
    fs::path folder;
    const hid::LoadedProfiles& profiles;
    std::vector<CheckedRole> roles {};

    CheckedRole fromGraph (const std::string& role) const
    {
        CheckedRole r { .device = { .role = role, .name = "an unknown device" } };
        const auto* description = graph.device (role);
        if (description != nullptr) describe (r, *description, folder);
        return r;
    }

    void describe (CheckedRole& r, const Json& description, const fs::path& from) const
    {
        if (const auto numbers = check::numbersOf (description, from))
        {
            r.device.numbers = *numbers;
            r.device.name = "sim";
            r.device.simulated = check::simulationOf (description, from);
        }
        else if (isPluginDevice (description))
            r.device = { .role = r.device.role, .name = nameOf (description) };   // its numbers are known when it is open
        else if (hid::isHid (description) && description.contains ("profile") && description.at ("profile").is_string())
            if (const auto profile = hid::profileNamed (profiles, description.at ("profile").asString())) take (r, *profile);
    }

    static void take (CheckedRole& r, const hid::Profile& profile)
    {
        r.device.numbers = hid::numbersOf (profile);
        r.device.name = profile.id;
        r.device.simulated.reset();
    }

    void take (const std::string& option)
    {
        const auto equals = option.find ('=');
        const auto name = option.substr (0, equals), what = equals == option.npos ? std::string() : option.substr (equals + 1);
        const auto role = std::ranges::find (roles, name, [] (const CheckedRole& r) { return r.device.role; });
        if (role == roles.end())
        {
            std::vector<std::string> names;
            for (const auto& r : roles)
                names.push_back (r.device.role);
            fail (Message::error ("device/unknown_role", "--device " + option, "the graph has no role " + quote (name) + didYouMean (name, names),
                                  "write ROLE=PROFILE or ROLE=FILE.json"));
        }
        if (const auto profile = hid::profileNamed (profiles, what)) return take (*role, *profile);
        if (what.ends_with (".json") && takeProfileFile (*role, what)) return;
        if (what.find_first_of (":.") == what.npos && what != "sim" && ! findDriver (what)) failOnProfile (option, what);

        Messages notes;   // none: profiles are taken above
        auto parsed = orFail (host::parseDeviceOption (
            option, graph.devices, folder, [this]() -> const hid::LoadedProfiles& { return profiles; }, notes));
        describe (*role, parsed.description, parsed.folder);
        if (const auto driver = parsed.description.value ("driver", std::string()); driver == "gesture" || driver == "trace" || driver == "sim")
            role->hand = check::HandChoice { role->device.role, std::move (parsed.description), std::move (parsed.folder) };
    }

    [[noreturn]] void failOnProfile (const std::string& option, const std::string& what) const
    {
        std::vector<std::string> ids;
        for (const auto& p : profiles.profiles)
            ids.push_back (p->id);
        fail (Message::error ("device/option", "--device " + option, "there is no profile " + quote (what) + didYouMean (what, ids),
                              "write the id of a profile, sim, gesture:NAME, trace:FILE.csv, DRIVER:PORT, or a .json file with a profile or a device"));
    }

    /// False if the file is not a profile; it may then be the description of a device.
    static bool takeProfileFile (CheckedRole& role, const std::string& file)
    {
        const auto text = readFile (fs::path (file));
        if (! text) fail (Message::error ("device/unreadable", file, "the file cannot be read: " + text.error().text, "check its name and permissions"));
        const auto json = Json::tryParse (*text);
        if (! json || ! json->is_object() || json->contains ("driver")) return false;
        const auto loaded = hid::readProfileText (*text);
        if (! loaded.profile)
            for (const auto& m : loaded.messages)
                if (m.severity == Message::Severity::error) fail (Message::error (m.id, file + ", " + m.where, m.text, m.remedy));
        take (role, *loaded.profile);
        return true;
    }
};

std::vector<check::HandChoice> handsOf (const std::vector<CheckedRole>& roles)
{
    std::vector<check::HandChoice> hands;
    for (const auto& r : roles)
        if (r.hand) hands.push_back (*r.hand);
    return hands;
}

std::vector<check::Reach> reachesOf (const std::vector<CheckedRole>& roles)
{
    std::vector<check::Reach> reaches;
    for (const auto& r : roles)
        if (const auto& box = r.device.numbers.workspace) reaches.push_back ({ r.device.role, box->min, box->max });
    return reaches;
}

fs::path folderOf (const std::string& file) { return fs::path (file).parent_path(); }
}   // namespace

CheckedGraph::CheckedGraph (const std::string& f, const std::vector<std::string>& devices, const std::vector<std::string>& sets, double rate_hz)
    : file (f), loaded (loadGraph (file)), profiles (hid::loadProfileLibrary()),
      subject { loaded.graph,
                catalogue(),
                { .rate_hz = rate_hz, .overrides = readSets (sets), .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } } },
      plan ([this] {
          refuseErrors (loaded.messages);
          auto compiled = compile (subject.graph, subject.catalogue, subject.options);
          refuseErrors (compiled.messages);
          return std::move (compiled.plan);
      }()),
      roles (Choices { loaded, folderOf (file), profiles }.read (*plan, devices))
{
}

check::HandMotion CheckedGraph::motion (double duration_s) const
{
    return bounded (check::recordMotion (subject, handsOf (roles), folderOf (file), duration_s));
}

check::HandMotion CheckedGraph::sweep (double duration_s) const
{
    if (duration_s <= 0.0) duration_s = 4.0;
    std::vector<std::unique_ptr<check::SweepDevice>> sweeps;
    std::vector<check::Hand> hands;
    for (const auto& r : roles)
    {
        const auto& box = r.device.numbers.workspace;
        const Vec3 min = box ? box->min : Vec3 (Vec3::Constant (-0.05)), max = box ? box->max : Vec3 (Vec3::Constant (0.05));
        sweeps.push_back (std::make_unique<check::SweepDevice> (min, max, duration_s));
        hands.push_back ({ r.device.role, *sweeps.back() });
    }
    const auto ticks = static_cast<std::size_t> (duration_s * plan->rateHz());
    return bounded ({ .motion = check::recordMotion (plan, hands, ticks) });
}

void CheckedGraph::refuseErrors (const Messages& messages) const
{
    if (report (messages, loaded, file) > 0) throw Stop {};
}

/// The motion, if no tool runs away in it.
check::HandMotion CheckedGraph::bounded (check::RecordedMotion recorded) const
{
    std::ranges::move (check::divergence (recorded.motion, reachesOf (roles)), std::back_inserter (recorded.messages));
    refuseErrors (recorded.messages);
    return std::move (recorded.motion);
}

}   // namespace tactus::host
