// SPDX-License-Identifier: GPL-3.0-or-later
#include "stem_plan.hpp"

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace tactus::host
{

namespace
{
std::vector<int> mixersIn (const std::vector<SinkMix>& mixes)
{
    std::set<int> all;
    for (const auto& m : mixes)
        all.insert (m.mixers.begin(), m.mixers.end());
    return { all.begin(), all.end() };
}

/// The layers that the setting `names` of a mixer lists.
std::vector<std::string> namesOf (const plan::FlatNode& mixer)
{
    std::vector<std::string> names (1);
    const auto& rows = mixer.type->settings;
    const auto row = std::ranges::find (rows, std::string_view ("names"), &SettingSheet::id);
    const auto* text = row == rows.end() ? nullptr : std::get_if<std::string> (&mixer.settings[static_cast<std::size_t> (row - rows.begin())]);
    for (const char c : text == nullptr ? std::string() : *text)
        if (c == ',')
            names.emplace_back();
        else if (c != ' ' || ! names.back().empty())
            names.back() += c;
    return names;
}

/// A text as a part of a file name: lower case letters, digits and underscores.
std::string asName (std::string_view text)
{
    std::string name;
    for (const char c : text)
    {
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        const char plain = is_letter ? c : c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a')
                                                                : '_';
        if (plain != '_' || (! name.empty() && name.back() != '_')) name += plain;
    }
    while (name.ends_with ('_'))
        name.pop_back();
    return name.substr (0, 60);
}

/// Finds the stems of a plan, one kind after the other.
class Planner
{
public:
    Planner (const Plan& p, StemPlan& m) : plan (p), made (m) {}

    void run()
    {
        const auto mixes = sinkMixes (plan.flat());
        addMixes (mixes);
        for (const int m : mixersIn (mixes))
            made.mixers.emplace_back (plan, m);
        addLayers (mixes);
        addUnmixed (mixes);
    }

private:
    const Plan& plan;
    StemPlan& made;
    std::set<std::string> names;

    std::size_t add (std::string kind, const std::string& name, std::string role)
    {
        auto file = name;
        for (int i = 2; ! names.insert (file).second; ++i)
            file = name + "_" + std::to_string (i);
        made.stems.push_back ({ .to = { .file = file + ".wav", .kind = std::move (kind) }, .role = std::move (role) });
        return made.stems.size() - 1;
    }

    void addChannel (std::size_t stem, const std::string& name, std::vector<std::pair<const Tap*, double>> from)
    {
        auto& s = made.stems[stem];
        if (s.channels.empty() && ! from.empty()) s.to.unit = from.front().first->unit;
        made.channels.push_back ({ stem, s.channels.size(), std::move (from) });
        s.channels.emplace_back();
        s.to.channels.push_back (name);
    }

    /// A file with the actuators of each role, in the order of their numbers, and a file for each of them.
    void addMixes (const std::vector<SinkMix>& mixes)
    {
        const auto& flat = plan.flat();
        struct Actuator
        {
            std::string name;
            std::vector<std::pair<const Tap*, double>> from;
        };
        std::map<std::string, std::map<std::pair<int, std::string>, Actuator>> roles;
        for (const auto& m : mixes)
        {
            const auto& node = flat.node (m.sink);
            const std::string port (flat.sheet (m.input).id);
            const auto parts = tapsOf (plan, m.name);
            for (std::size_t c = 0; c < parts.size(); ++c)
            {
                const auto& tap = plan.taps()[parts[c]];
                // Forces come first, then torques, the axes by their names and the channels by their numbers.
                std::pair<int, std::string> place { port == "force" ? 0 : port == "torque" ? 3
                                                                                           : 6,
                                                    {} };
                std::string called = port == "torque" ? "torque_" : "";
                if (parts.size() == 3)
                {
                    place.first += static_cast<int> (c);
                    called += "xyz"[c];
                }
                else if (const auto* axis = std::get_if<std::string> (&node.settings.front()))
                {
                    called = asName (*axis);
                    place.second = *axis;
                }
                else if (const auto* channel = std::get_if<double> (&node.settings.front()))
                {
                    called = "channel_" + numberText (*channel);
                    place.first += static_cast<int> (*channel);
                }
                auto& actuator = roles[node.role][place];
                actuator.name = called;
                actuator.from.emplace_back (&tap, 1.0);
            }
        }
        for (const auto& [role, actuators] : roles)
        {
            const auto name = roles.size() > 1 ? "mix_" + asName (role) : std::string ("mix");
            const auto whole = add ("mix", name, role);
            made.stems[whole].to.label = role;
            for (const auto& [place, a] : actuators)
                addChannel (whole, a.from.front().first->name, a.from);
            for (const auto& [place, a] : actuators)
                if (actuators.size() > 1)
                {
                    const auto one = add ("axis", name + "_" + a.name, role);
                    made.stems[one].to.label = a.name;
                    addChannel (one, a.from.front().first->name, a.from);
                }
        }
    }

    std::string roleOf (const SinkMix& m) const { return plan.flat().node (m.sink).role; }

    void addLayers (const std::vector<SinkMix>& mixes)
    {
        for (std::size_t m = 0; m < made.mixers.size(); ++m)
        {
            const auto& mixer = made.mixers[m];
            const auto to = std::ranges::find_if (mixes, [&] (const SinkMix& s) { return std::ranges::count (s.mixers, mixer.node) > 0; });
            const auto called = namesOf (plan.flat().node (mixer.node));
            for (int i = 0; i < mixer.layers; ++i)
            {
                const auto label = static_cast<std::size_t> (i) < called.size() ? called[static_cast<std::size_t> (i)] : std::string();
                auto name = "layer_" + (made.mixers.size() > 1 ? asName (mixer.path) + "_" : std::string()) + std::to_string (i + 1);
                if (! asName (label).empty()) name += "_" + asName (label);
                const auto stem = add ("layer", name, roleOf (*to));
                auto& s = made.stems[stem];
                s.to.label = label;
                s.to.from = mixer.path + ".in[" + std::to_string (i) + "]";
                s.to.unit = mixer.unit();
                for (std::size_t c = 0; c < mixer.width; ++c)
                    s.to.channels.push_back (mixer.width > 1 ? s.to.from + "." + "xyz"[c] : s.to.from);
                s.channels.resize (mixer.width);
                made.layers.push_back ({ stem, m, i });
            }
        }
    }

    void addUnmixed (const std::vector<SinkMix>& mixes)
    {
        for (const auto& m : mixes)
            for (const auto& u : m.unmixed)
            {
                const auto parts = u.from.empty() ? std::vector<std::size_t> {} : tapsOf (plan, u.from);
                if (parts.empty()) continue;
                const auto stem = add ("not_mixed", "not_mixed_" + asName (u.from), roleOf (m));
                made.stems[stem].to.from = u.from;
                made.stems[stem].to.label = plan.flat().nameOf (plan.flat().wires[u.wire].to);
                for (const int n : u.through)
                    made.stems[stem].to.not_applied.push_back (plan.flat().node (n).path);
                for (const auto p : parts)
                    addChannel (stem, plan.taps()[p].name, { { &plan.taps()[p], plan.flat().wires[u.wire].gain } });
            }
    }
};
}   // namespace

StemPlan::StemPlan (const Plan& plan) { Planner (plan, *this).run(); }

std::vector<std::string> stemPorts (const plan::Flat& flat)
{
    const auto mixes = sinkMixes (flat);
    std::vector<std::string> ports;
    const auto add = [&] (const std::string& port) {
        if (! port.empty() && std::ranges::count (ports, port) == 0) ports.push_back (port);
    };
    for (const auto& m : mixes)
    {
        add (m.name);
        for (const auto& u : m.unmixed)
            add (u.from);
    }
    for (const int m : mixersIn (mixes))
    {
        for (int i = 0; i < flat.node (m).list_size; ++i)
            add (flat.nameOf (portOf (flat, m, Role::input, "in", i)));
        add (flat.nameOf (portOf (flat, m, Role::output, "out")));
    }
    return ports;
}

}   // namespace tactus::host
