// SPDX-License-Identifier: MIT
#include "class_code.hpp"
#include "setting_code.hpp"
#include "tick_code.hpp"

#include <tactus/run/log/run_head.hpp>

#include <algorithm>
#include <set>

namespace tactus::host
{

namespace
{
constexpr const char* license = "// SPDX-License-Identifier: MIT\n";

std::string title (const Exported& e)
{
    auto text = comment (e.graph.name.empty() ? e.stem : e.graph.name);
    if (! e.graph.about.empty()) text += ": " + comment (e.graph.about);
    return text;
}

/// A value in a comment: "0.4 N, at least 0.0".
std::string rangeOf (const ExportedParameter& p)
{
    const auto& s = *p.sheet;
    if (! s.choices.empty())
    {
        std::vector<std::string> all;
        for (std::size_t i = 0; i < s.choices.size(); ++i)
            all.push_back (std::to_string (i) + " " + std::string (s.choices[i]));
        return listText (all);
    }
    const auto unit = s.unit.kind == UnitRule::Kind::fixed && ! s.unit.unit.symbol.empty() ? std::string (s.unit.unit.symbol) + "; " : std::string {};
    return unit + std::string (s.about);
}

std::string enumOf (const std::string& name, const std::string& about, const std::vector<std::pair<std::string, std::string>>& all)
{
    std::string text = "    /// " + about + "\n    enum class " + name + " : std::size_t\n    {\n";
    for (const auto& [enumerator, what] : all)
        text += "        " + enumerator + ",   ///< " + comment (what) + "\n";
    return text + "    };\n\n";
}

std::string enums (const Exported& e)
{
    std::string text;
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& p : e.parameters)
        all.emplace_back (p.enumerator, p.name + ": " + rangeOf (p));
    if (! all.empty()) text += enumOf ("Param", "The parameters of the nodes.", all);
    all.clear();
    for (const auto& c : e.controls)
        all.emplace_back (c.enumerator, c.name.empty() ? c.id : c.name);
    if (! all.empty()) text += enumOf ("Control", "The controls of the patch, each from 0 to 1.", all);
    all.clear();
    for (std::size_t i = 0; i < e.hits.size(); ++i)
        all.emplace_back (e.hits[i], e.wiring.hit_names[i]);
    if (! all.empty()) text += enumOf ("Hit", "Inputs that can be hit from outside.", all);
    return text;
}

std::string inputsAndOutputs (const Exported& e)
{
    std::string text = "    /// What the devices report";
    if (! e.wiring.feed_names.empty()) text += ", and the values of inputs that are driven from outside";
    text += ".\n    struct Inputs\n    {\n";
    for (const auto& role : e.wiring.role_ports)
        text += "        tactus::Reading " + role + " {};\n";
    for (const auto& feed : e.wiring.feed_names)
        text += "        double " + feed + " = 0.0;\n";
    text += "    };\n\n    /// What the devices should apply, after the guard, and recorded values, before it.\n    struct Outputs\n    {\n";
    for (const auto& role : e.wiring.role_ports)
        text += "        tactus::Effort " + role + " {};\n";
    for (std::size_t i = 0; i < e.wiring.tap_names.size(); ++i)
    {
        const auto& tap = e.wiring.plan.taps()[i];
        const auto& name = e.wiring.tap_names[i];
        const auto count = std::to_string (tap.per_tick);
        text += "        " + (tap.samples == nullptr ? "double " + name + " = 0.0;" : "std::array<double, " + count + "> " + name + " {};");
        text += "   ///< " + comment (tap.name) + (tap.unit.empty() ? "" : ", in " + tap.unit) + "\n";
    }
    return text + "    };\n\n";
}

std::string limitsOf (const GuardLimits& l)
{
    const GuardLimits none;
    std::vector<std::string> all;
    for (const auto& [key, limit] : guard_fields)
        if (l.*limit != none.*limit) all.push_back ("." + std::string (key) + " = " + literal (l.*limit));
    if (l.dead_man_buttons != 0) all.push_back ("." + std::string (dead_man_buttons) + " = " + std::to_string (l.dead_man_buttons) + "u");
    return all.empty() ? "{}" : "{ " + listText (all) + " }";
}

std::string layoutOf (const DeviceLayout& l)
{
    std::vector<std::string> all;
    const auto add = [&] (const char* name, const std::vector<std::string>& names) {
        std::vector<std::string> quotes;
        for (const auto& n : names)
            quotes.push_back (textLiteral (n));
        if (! names.empty()) all.push_back ("." + std::string (name) + " = { " + listText (quotes) + " }");
    };
    add ("axes", l.axes);
    add ("efforts", l.efforts);
    add ("buttons", l.buttons);
    if (l.signal_inputs != 0) all.push_back (".signal_inputs = " + std::to_string (l.signal_inputs));
    if (l.signal_outputs != 0) all.push_back (".signal_outputs = " + std::to_string (l.signal_outputs));
    if (l.mechanics != DeviceMechanics {})
        all.push_back (".mechanics = { .mass = " + literal (l.mechanics.mass) + ", .damping = " + literal (l.mechanics.damping) + " }");
    if (l.brake != 0.0) all.push_back (".brake = " + literal (l.brake));
    return all.empty() ? "{}" : "{ " + listText (all) + " }";
}

std::string functions (const Exported& e)
{
    std::string text = "    /// Resets all nodes, for this many ticks per second. Returns false, and does nothing, if the rate is not above 0\n"
                       "    /// or is above max_rate_hz: the memory of the nodes is measured for that rate.\n"
                       "    bool prepare (double ticks_per_second = rate_hz) noexcept;\n\n"
                       "    /// Computes one tick. The same inputs give the same bits as in Tactus. Before prepare(), all outputs are 0.\n"
                       "    void tick (const Inputs&, Outputs&) noexcept;\n\n";
    if (! e.parameters.empty())
        text += "    /// Moves a parameter to a value in a straight line that takes 20 ms; at once before the first tick. The value is clamped to the hard\n"
                "    /// range of the parameter; for a choice, it is the number of the alternative.\n"
                "    void set (Param param, double value) noexcept { parameters.set (static_cast<std::size_t> (param), value); }\n\n"
                "    /// The value that a parameter has or moves to.\n"
                "    double get (Param param) const noexcept { return parameters.target (static_cast<std::size_t> (param)); }\n\n";
    if (! e.controls.empty())
        text += "    /// Turns a control: moves its parameters to where they belong at this position, 0 to 1. Other values have no effect.\n"
                "    void set (Control, double position) noexcept;\n\n";
    if (! e.hits.empty())
        text += "    /// Hits an input at this speed, in m/s, on the next tick on which its node runs.\n"
                "    void strike (Hit hit, double speed) noexcept { hits[static_cast<std::size_t> (hit)].strike (speed); }\n\n";
    if (e.roles.empty()) return text;
    text += "    /// The device was not ticked for this time, in s, before the next tick.\n"
            "    void loseTime (double seconds) noexcept { lost_s = seconds > 0.0 ? seconds : 0.0; }\n\n";
    const std::pair<const char*, const char*> stops[] {
        { "halt", "Brings all efforts to zero smoothly, and keeps them there until resume()." },
        { "resume", "Ends a halt." },
        { "emergencyStop", "Like halt, but only rearm() ends it." },
        { "rearm", "Ends an emergency stop and every other stop that a guard has latched." },
    };
    for (const auto& [name, about] : stops)
    {
        text += std::string ("    /// ") + about + "\n    void " + name + "() noexcept\n    {\n";
        for (const auto& role : e.wiring.role_names)
            text += "        " + role + ".guard." + name + "();\n";
        text += "    }\n\n";
    }
    return text;
}

std::string rolesOf (const Exported& e)
{
    std::string text;
    for (std::size_t i = 0; i < e.roles.size(); ++i)
    {
        text += "    /// The device in the role " + comment (e.roles[i].name) + ": what it has, and its guard, with the limits of the patch.\n"
                                                                                "    /// Change the layout, and tighten the limits, before prepare().\n";
        text += wrapped ("    ", "tactus::exported::Role " + e.wiring.role_names[i] + " {",
                         { limitsOf (e.roles[i].limits), layoutOf (e.roles[i].layout) }, "};");
        text += "\n";
    }
    return text;
}

bool hasState (const Exported& e)
{
    return ! e.wiring.kept.empty() || std::ranges::any_of (e.wiring.nodes, [] (const ExportedNode& n) { return n.is_inner && n.is_read; });
}

std::string state (const Exported& e)
{
    if (! hasState (e)) return {};
    std::string text = "    /// What lasts from one tick to the next, apart from the nodes.\n    struct State\n    {\n";
    for (const auto& [type, name] : e.wiring.kept)
        text += "        " + type + " " + name + (type == "double" ? " = 0.0" : type == "std::uint64_t" ? " = 0"
                                                                                                        : " {}")
                + ";\n";
    for (const auto& n : e.wiring.nodes)
        if (n.is_inner && n.is_read) text += "        " + n.type + "::Outputs " + n.name + "_out {};\n";
    return text + "    };\n\n    State state {};\n";
}

std::string members (const Exported& e)
{
    std::string text = "private:\n" + state (e) + "    std::uint64_t ticks = 0;\n";
    if (! e.roles.empty()) text += "    double lost_s = 0.0;\n";
    if (! e.parameters.empty())
    {
        std::set<std::size_t> with;
        for (const auto& p : e.parameters)
            with.insert (p.node);
        text += "    tactus::exported::Parameters<" + std::to_string (e.parameters.size()) + ", " + std::to_string (with.size()) + "> parameters {};\n";
    }
    if (! e.hits.empty()) text += "    std::array<tactus::exported::Hits, " + std::to_string (e.hits.size()) + "> hits {};\n";
    text += "\n    // The nodes of the patch.\n";
    for (const auto& n : e.wiring.nodes)
        text += "    " + n.type + " " + n.name + " {};   // " + comment (e.wiring.flat (n).path) + "\n";
    return text;
}

std::string header (const Exported& e)
{
    std::set<std::string> headers { "tactus/run/generated/exported_graph.hpp", "tactus/run/generated/exported_memory.hpp" };
    for (const auto& n : e.wiring.nodes)
        headers.insert (n.header);
    std::string text = std::string (license) + "// " + title (e) + "\n//\n// Written by `" + e.program + " export` from " + comment (e.file)
                       + ". README.md says how to use it.\n#pragma once\n\n";
    for (const auto& h : headers)
        text += "#include <" + h + ">\n";
    text += "\n#include <array>\n#include <cstddef>\n#include <cstdint>\n\n/// " + title (e) + "\n///\n"
            + "/// All functions are for one thread, the one that ticks. An object must not be moved, because nodes point to their devices.\nclass "
            + e.class_name + " : public tactus::exported::Memory<" + std::to_string (e.memory.prepared) + ">\n{\npublic:\n"
            + "    static constexpr double rate_hz = " + literal (e.wiring.plan.rateHz()) + ";   ///< the rate of the patch\n"
            + "    static constexpr double max_rate_hz = rate_hz;\n\n";
    text += inputsAndOutputs (e) + enums (e);
    text += "    " + e.class_name + "() = default;\n    " + e.class_name + " (const " + e.class_name + "&) = delete;\n    " + e.class_name
            + "& operator= (const "
            + e.class_name + "&) = delete;\n\n";
    return text + functions (e) + rolesOf (e) + members (e) + "};\n";
}

/// A comment with the source that the patch states for a number.
std::string sourceOf (const Exported& e, const ExportedParameter& p)
{
    const auto ui = e.graph.extra.find ("ui");
    if (ui == e.graph.extra.end() || ! ui->is_object()) return {};
    const auto sources = ui->find ("sources");
    if (sources == ui->end() || ! sources->is_object()) return {};
    const auto source = sources->find (p.name);
    return source != sources->end() && source->is_string() ? "   // " + comment (source->get<std::string>()) : std::string {};
}

/// The notes that the author has put next to the nodes of a patch.
void addNotes (std::string& text, const Json& extra)
{
    if (! extra.is_object() || ! extra.contains ("ui") || ! extra.at ("ui").is_object() || ! extra.at ("ui").contains ("notes")) return;
    const auto& notes = extra.at ("ui").at ("notes");
    if (! notes.is_array()) return;
    for (const auto& note : notes)
        if (note.is_object() && note.contains ("text") && note.at ("text").is_string())
            text += "// - " + comment (note.at ("text").get<std::string>()) + "\n";
}

std::string notesOf (const graph::Graph& graph)
{
    std::string text;
    addNotes (text, graph.extra);
    addNotes (text, graph.root.extra);
    for (const auto& [name, patch] : graph.graphs)
        addNotes (text, patch.extra);
    return text.empty() ? text : "// Notes in the patch:\n" + text;
}

std::string prepareNode (const Exported& e, const ExportedNode& n, SettingCode& settings)
{
    const auto& wiring = e.wiring;
    const auto& flat = wiring.flat (n);
    const auto& type = wiring.type (n);
    const auto& instance = wiring.plan.instances()[n.instance];
    std::string text = "\n    // " + comment (flat.path) + ": " + std::string (type.info.id) + "\n";
    bool is_first = true;
    for (std::size_t i = n.parameters; i < e.parameters.size() && &wiring.nodes[e.parameters[i].node] == &n; ++i)
    {
        const auto& p = e.parameters[i];
        if (is_first) text += "    parameters.of (" + n.name + ", " + std::to_string (i) + ");\n";
        is_first = false;
        const auto member = n.name + ".params." + PlanNames::memberOf (*p.sheet, p.slot);
        text += "    parameters.place (" + member + ", ";
        if (! p.sheet->choices.empty())
            text += std::to_string (static_cast<int> (p.value)) + ", " + std::to_string (p.sheet->choices.size()) + ");   // "
                    + std::string (p.sheet->choices[static_cast<std::size_t> (p.value)]) + "\n";
        else
            text += literal (p.value) + ", " + literal (p.sheet->limits.hard.min) + ", " + literal (p.sheet->limits.hard.max)
                    + (p.sheet->limits.off_at_zero ? ", true);" : ");") + sourceOf (e, p) + "\n";
        if (instance.isDriven (p.knob)) text += "    parameters.drive (" + std::to_string (i) + ");\n";
    }
    for (std::size_t i = 0; i < flat.settings.size(); ++i)
    {
        const std::string id (type.settings[i].id);
        text += "    " + n.name + ".settings." + id + " = " + settings.of (type.settings[i], flat.settings[i], n.name + "_" + id) + ";\n";
    }
    return text;
}

/// Tells a node about the device of its role, if it has the hook for that.
std::string meet (const Exported& e, const ExportedNode& n)
{
    const auto& type = e.wiring.type (n);
    for (std::size_t i = 0; i < e.roles.size(); ++i)
    {
        if (e.roles[i].name != e.wiring.flat (n).role) continue;
        if (type.bind) return "    " + n.name + ".bind (" + e.wiring.role_names[i] + ".state);\n";
        if (type.learn) return "    " + n.name + ".learn (" + e.wiring.role_names[i] + ".state.layout.mechanics);\n";
    }
    return {};
}

std::string prepare (const Exported& e, SettingCode& settings)
{
    std::string text = "bool " + e.class_name + "::prepare (double ticks_per_second) noexcept\n{\n    using tactus::exported::start;\n"
                                                "    if (! (ticks_per_second > 0.0 && ticks_per_second <= max_rate_hz)) return false;\n"
                                                "    ticks = 0;\n";
    if (hasState (e)) text += "    tactus::exported::renew (state);\n";
    std::vector<std::string> names;
    for (const auto& n : e.wiring.nodes)
        names.push_back (n.name);
    text += filled (wrapped ("    ", "renewAll (", names, ");"), { { "renewAll ( ", "renewAll (" }, { " );", ");" } });
    if (! e.parameters.empty()) text += "    parameters.prepare (ticks_per_second);\n";
    if (! e.hits.empty()) text += "    hits.fill ({});\n";
    if (! e.roles.empty()) text += "    lost_s = 0.0;\n";
    for (const auto& role : e.wiring.role_names)
        text += "    " + role + ".prepare (1.0 / ticks_per_second);\n";
    for (const auto& n : e.wiring.nodes)
    {
        const double speed = e.wiring.plan.flat().speed (e.wiring.flat (n).section);
        text += prepareNode (e, n, settings) + meet (e, n);
        text += "    start (" + n.name + ", ticks_per_second" + (speed == 1.0 ? "" : " * " + literal (speed)) + ");\n";
    }
    text += "\n";
    for (const auto& role : e.wiring.role_names)
        text += "    " + role + ".meet();\n";
    for (const auto& n : e.wiring.nodes)
        text += meet (e, n);
    return text + "    return true;\n}\n\n";
}

std::string setControl (const Exported& e)
{
    if (e.controls.empty()) return {};
    std::string text = "void " + e.class_name + "::set (Control control, double position) noexcept\n{\n"
                                                "    if (! (position >= 0.0 && position <= 1.0)) return;\n"
                                                "    const auto turn = [this, position] (Param param, double low, double high) noexcept {\n"
                                                "        set (param, position == 0.0 ? low : low + position * (high - low));\n    };\n"
                                                "    switch (control)\n    {\n";
    for (const auto& c : e.controls)
    {
        text += "    case Control::" + c.enumerator + ":\n";
        for (const auto& to : c.to)
            text += "        turn (Param::" + e.parameters[to.parameter].enumerator + ", " + literal (to.low) + ", " + literal (to.high) + ");\n";
        text += "        break;\n";
    }
    return text + "    }\n}\n\n";
}

std::string tick (const Exported& e, const std::string& body)
{
    const bool reads = ! e.roles.empty() || ! e.wiring.feed_names.empty(), writes = ! e.roles.empty() || ! e.wiring.tap_names.empty();
    std::string text = "void " + e.class_name + "::tick (const Inputs& " + (reads ? "in" : "") + ", Outputs& " + (writes ? "out" : "") + ") noexcept\n{\n";
    if (! e.roles.empty()) text += "    if (! " + e.wiring.role_names.front() + ".isReady())\n    {\n        out = {};\n        return;\n    }\n";
    if (! e.parameters.empty()) text += "    parameters.tick();\n";
    if (! e.hits.empty()) text += "    for (auto& hit : hits)\n        hit.poll();\n";
    for (std::size_t i = 0; i < e.roles.size(); ++i)
        text += "    " + e.wiring.role_names[i] + ".read (in." + e.wiring.role_ports[i] + ");\n";
    text += body + "\n    ++ticks;\n";
    for (std::size_t i = 0; i < e.roles.size(); ++i)
    {
        std::vector<std::string> sinks;
        for (const auto& sink : e.wiring.plan.roles()[i].sinks)
            sinks.push_back (e.wiring.nodeOf (sink.node)->name + ".effort()");
        const auto effort = sinks.empty() ? "{}" : "tactus::exported::total<" + std::to_string (sinks.size()) + "> ({ " + listText (sinks) + " })";
        text += "    out." + e.wiring.role_ports[i] + " = " + e.wiring.role_names[i] + ".write (" + effort + ", lost_s);\n";
    }
    if (! e.roles.empty()) text += "    lost_s = 0.0;\n";
    for (std::size_t i = 0; i < e.wiring.tap_names.size(); ++i)
        if (e.wiring.plan.taps()[i].samples == nullptr)
            text += "    out." + e.wiring.tap_names[i] + " = " + e.wiring.valueAt (e.wiring.plan.taps()[i].value) + ";\n";
    return text + "}\n";
}
}   // namespace

ClassFiles classFiles (const Exported& e)
{
    ClassFiles files;
    const auto body = TickCode (e.wiring).statements();   // first, because it finds out which outputs are read
    const auto space = e.stem + "_data";
    SettingCode settings { space };
    const auto prepared = prepare (e, settings);
    files.header = header (e);
    if (settings.usesData())
        files.data = filled (R"(// SPDX-License-Identifier: MIT
// The constant tables of @FILE@.
#pragma once

#include <tactus/kit/geometry/surface.hpp>
#include <tactus/run/generated/exported_memory.hpp>

#include <array>

namespace @SPACE@
{

@DATA@}   // namespace @SPACE@
)",
                             { { "@FILE@", comment (e.file) }, { "@SPACE@", space }, { "@DATA@", settings.data() } });
    files.source = std::string (license) + notesOf (e.graph) + "#include \"" + e.stem + ".hpp\"\n";
    if (settings.usesData()) files.source += "#include \"" + space + ".hpp\"\n";
    files.source += "\nusing tactus::exported::sumOf;\n";
    files.source += "\n" + prepared + setControl (e) + tick (e, body);
    return files;
}

}   // namespace tactus::host
