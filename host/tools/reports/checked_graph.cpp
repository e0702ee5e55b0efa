// SPDX-License-Identifier: MIT
#include "checked_graph.hpp"
#include "refusal.hpp"

#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid/physics.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/sessions/numbers_device.hpp>
#include <host/devices/sessions/role_fits.hpp>
#include <host/devices/trial/trial.hpp>
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
        rate_hz = plan.rateHz();
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
    double rate_hz = 0.0;

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
            refuse (Message::error ("device/unknown_role", "--device " + option, "the graph has no role " + quote (name) + didYouMean (name, names),
                                    "write ROLE=PROFILE or ROLE=FILE.json"));
        }
        if (const auto profile = hid::profileNamed (profiles, what)) return take (*role, *profile);
        if (what.ends_with (".json") && takeProfileFile (*role, what)) return;
        if (what.find_first_of (":.") == what.npos && what != "sim" && ! findDriver (what)) failOnProfile (option, what);

        Messages notes;   // none: profiles are taken above
        auto parsed = orRefuse (host::parseDeviceOption (
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
        refuse (Message::error ("device/option", "--device " + option, "there is no profile " + quote (what) + didYouMean (what, ids),
                                "write the id of a profile, sim, gesture:NAME, trace:FILE.csv, DRIVER:PORT, or a .json file with a profile or a device"));
    }

    /// False if the file is neither a profile nor the report of a trial; it may then be the description of a device.
    bool takeProfileFile (CheckedRole& role, const std::string& file) const
    {
        const auto text = readFile (fs::path (file));
        if (! text) refuse (Message::error ("device/unreadable", file, "the file cannot be read: " + text.error().text, "check its name and permissions"));
        const auto json = Json::tryParse (*text);
        if (! json || ! json->is_object() || json->contains ("driver")) return false;
        if (json->value ("format", Json()) == Json ("tactus-trial"))
        {
            const auto numbers = trialNumbers (*json, rate_hz);
            if (! numbers) refuse (numbers.error());
            role.device.numbers = *numbers;
            role.device.name = file;
            role.device.simulated.reset();
            return true;
        }
        const auto loaded = hid::readProfileText (*text);
        if (! loaded.profile)
            for (const auto& m : loaded.messages)
                if (m.severity == Message::Severity::error) refuse (Message::error (m.id, file + ", " + m.where, m.text, m.remedy));
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

}   // namespace

CheckedGraph::CheckedGraph (LoadedGraph l, std::string f, Assets& assets, const Options& options)
    : file (std::move (f)), loaded (std::move (l)), profiles (hid::loadProfileLibrary()),
      subject { loaded.graph,
                catalogue(),
                { .rate_hz = options.rate_hz, .overrides = options.overrides, .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } } },
      plan ([this] {
          refuseErrors (loaded.messages);
          auto compiled = compile (subject.graph, subject.catalogue, subject.options);
          refuseErrors (std::move (compiled.messages));
          return std::move (compiled.plan);
      }()),
      roles (Choices { loaded, loaded.graph.folder, profiles }.read (*plan, options.devices))
{
}

check::HandMotion CheckedGraph::motion (double duration_s)
{
    return bounded (check::recordMotion (subject, handsOf (roles), loaded.graph.folder, duration_s));
}

check::HandMotion CheckedGraph::sweep (double duration_s)
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

/// Keeps the messages, with their place in the file, and refuses if one of them is an error.
void CheckedGraph::refuseErrors (Messages messages)
{
    for (auto& m : messages)
    {
        const bool in_graph = m.where.empty() || m.where.starts_with ('/');
        if (file.empty() || ! in_graph || (! m.file.empty() && m.file != file)) continue;
        m.file = file;
        if (m.line > 0) continue;
        const auto at = loaded.positionOf (m.where);
        m.line = at.line;
        m.column = at.column;
    }
    const bool is_wrong = hasErrors (messages);
    std::ranges::move (messages, std::back_inserter (warnings));
    if (is_wrong) throw Refusal { takeWarnings() };
}

/// The motion, if no tool runs away in it.
check::HandMotion CheckedGraph::bounded (check::RecordedMotion recorded)
{
    std::ranges::move (check::divergence (recorded.motion, reachesOf (roles)), std::back_inserter (recorded.messages));
    refuseErrors (std::move (recorded.messages));
    return std::move (recorded.motion);
}

}   // namespace tactus::host
