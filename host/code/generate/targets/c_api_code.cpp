// SPDX-License-Identifier: MIT
#include "c_api_code.hpp"

#include <tactus/run/log/run_head.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cctype>
#include <functional>
#include <span>
#include <string_view>

namespace tactus::host
{

namespace
{
/// A member of a struct.
struct Member
{
    const char *type, *name;
    std::size_t count;   // above 1 for an array
    const char* about;
};

constexpr Member reading_members[] {
    { "double", "position", 3, "of the tool, m" },
    { "double", "rotation", 3, "rotation vector, rad" },
    { "double", "pressure", 1, "N" },
    { "double", "age", 1, "time since the device took this reading, s" },
    { "bool", "valid", 1, "false while the device has nothing to report" },
    { "uint32_t", "buttons", 1, "bit i: button i is down" },
    { "double", "true_position", 3, "of a simulated device, m" },
    { "double", "true_velocity", 3, "of a simulated device, m/s" },
    { "double", "unrendered_force", 3, "the part of the last force that the motors could not render, N" },
    { "double", "unrendered_torque", 3, "the same for the torque, N m" },
};

constexpr Member effort_members[] {
    { "double", "force", 3, "on the tool, N" },
    { "double", "torque", 3, "on the tool, N m" },
    { "double", "brake", 1, "damping of the brake, N s/m" },
};

/// The fixed members of the effort of a role; most devices have no brake.
std::span<const Member> effortMembers (const DeviceLayout& layout) { return std::span (effort_members).first (layout.brake > 0.0 ? 3 : 2); }

/// Declares members, with their comments in one column.
std::string declared (std::span<const Member> members, std::size_t column)
{
    std::string text;
    for (const auto& m : members)
    {
        auto line = std::string ("    ") + m.type + " " + m.name + (m.count > 1 ? "[" + std::to_string (m.count) + "]" : std::string()) + ";";
        line.resize (column, ' ');
        text += line + "/* " + m.about + " */\n";
    }
    return text;
}

std::size_t bytesOf (std::span<const Member> members)
{
    std::size_t bytes = 0;
    for (const auto& m : members)
    {
        const std::size_t each = m.type == std::string_view ("double") ? 8 : m.type == std::string_view ("bool") ? 1
                                                                                                                 : 4;
        bytes = (bytes + each - 1) / each * each + each * m.count;
    }
    return bytes;
}

/// "DRY_WOOD" for "dry_wood".
std::string capitals (std::string text)
{
    for (auto& c : text)
        c = static_cast<char> (std::toupper (static_cast<unsigned char> (c)));
    return text;
}

std::string cChannels (const char* name, std::size_t count, const char* about)
{
    return count == 0 ? std::string {} : std::string ("    double ") + name + "[" + std::to_string (count) + "];   /* " + about + " */\n";
}

std::string roleStructs (const Exported& e)
{
    std::string text;
    for (std::size_t i = 0; i < e.roles.size(); ++i)
    {
        const auto name = e.stem + "_" + e.wiring.role_ports[i];
        const auto& layout = e.roles[i].layout;
        text += "/* What the device in the role " + comment (e.roles[i].name) + " reports. */\ntypedef struct " + name + "_reading\n{\n"
                + declared (reading_members, 35)
                + cChannels ("axes", layout.axes.size(), "m, rad or 1")
                + cChannels ("signals", static_cast<std::size_t> (layout.signal_inputs), "signal inputs")
                + "} " + name + "_reading;\n\n/* What this device should apply. */\ntypedef struct " + name + "_effort\n{\n"
                + declared (effortMembers (layout), 24)
                + cChannels ("axes", layout.efforts.size(), "N or N m")
                + cChannels ("signals", static_cast<std::size_t> (layout.signal_outputs), "signal outputs")
                + "} " + name + "_effort;\n\n";
    }
    return text;
}

std::string cStructs (const Exported& e)
{
    std::string text = roleStructs (e) + "typedef struct " + e.stem + "_inputs\n{\n";
    for (const auto& role : e.wiring.role_ports)
        text += "    " + e.stem + "_" + role + "_reading " + role + ";\n";
    for (const auto& feed : e.wiring.feed_names)
        text += "    double " + feed + ";\n";
    if (e.wiring.role_ports.empty() && e.wiring.feed_names.empty()) text += "    char unused;\n";
    text += "} " + e.stem + "_inputs;\n\ntypedef struct " + e.stem + "_outputs\n{\n";
    for (const auto& role : e.wiring.role_ports)
        text += "    " + e.stem + "_" + role + "_effort " + role + ";\n";
    for (std::size_t i = 0; i < e.wiring.tap_names.size(); ++i)
    {
        const auto& tap = e.wiring.plan.taps()[i];
        text += "    double " + e.wiring.tap_names[i] + (tap.samples == nullptr ? "" : "[" + std::to_string (tap.per_tick) + "]") + ";   /* "
                + filled (comment (tap.name), { { "*/", "* /" } }) + (tap.unit.empty() ? "" : ", " + tap.unit) + " */\n";
    }
    if (e.wiring.role_ports.empty() && e.wiring.tap_names.empty()) text += "    char unused;\n";
    return text + "} " + e.stem + "_outputs;\n\n";
}

std::string cEnumOf (const Exported& e, const std::string& kind, const std::vector<std::string>& names)
{
    if (names.empty()) return {};
    std::vector<std::string> all;
    for (const auto& name : names)
        all.push_back (capitals (e.stem + "_" + kind) + "_" + name);
    return "typedef enum " + e.stem + "_" + kind + "\n{\n    " + listText (all, ",\n    ") + "\n} " + e.stem + "_" + kind + ";\n\n";
}

/// Text for each limit that can be tightened.
std::string forLimits (const std::function<std::string (const std::string&)>& text)
{
    std::string all;
    for (const auto& name : limitNames())
        all += text (name);
    return all;
}

std::string limitsStruct (const Exported& e)
{
    if (e.roles.empty()) return {};
    return "/* The limits of the guard of a device, in SI units, as docs/safety.md of Tactus explains them. */\ntypedef struct " + e.stem + "_limits\n{\n"
           + forLimits ([] (const std::string& key) { return "    double " + key + ";\n"; })
           + "    uint64_t dead_man_buttons;   /* bit i: button i must be held */\n} " + e.stem + "_limits;\n\n";
}

std::vector<std::string> enumerators (const auto& entries)
{
    std::vector<std::string> all;
    for (const auto& one : entries)
        all.push_back (one.enumerator);
    return all;
}

/// @S@ is the stem.
std::string cFunctions (const Exported& e)
{
    std::string text = R"(/* How many bytes of memory a graph needs, and a multiple of which number its address must be. */
size_t @S@_size (void);
size_t @S@_alignment (void);

/* Makes a graph in this memory, which must last as long as the graph: static memory, or what malloc returns. Returns NULL if it is too
   small or at a wrong address. Nothing here takes memory from a heap. */
@S@* @S@_create (void* memory, size_t size);

/* Resets all nodes, for this many ticks per second. False if the rate is not above 0 or is above @U@_MAX_RATE_HZ. */
bool @S@_prepare (@S@* graph, double ticks_per_second);

/* Inputs of a device that reports nothing yet, and zeros. */
void @S@_init (@S@_inputs* inputs);

/* Computes one tick. */
void @S@_tick (@S@* graph, const @S@_inputs* inputs, @S@_outputs* outputs);

/* Ends a graph. Its memory can be used for something else. */
void @S@_destroy (@S@* graph);

)";
    if (! e.parameters.empty())
        text += "/* Moves a parameter to a value within 20 ms; at once before the first tick. */\n"
                "void @S@_set (@S@* graph, @S@_param param, double value);\n\n"
                "/* The value that a parameter has or moves to. */\ndouble @S@_get (const @S@* graph, @S@_param param);\n\n";
    if (! e.controls.empty()) text += "/* Turns a control to a position from 0 to 1. */\nvoid @S@_turn (@S@* graph, @S@_control control, double position);\n\n";
    if (! e.hits.empty()) text += "/* Hits an input at this speed, in m/s. */\nvoid @S@_strike (@S@* graph, @S@_hit hit, double speed);\n\n";
    if (! e.roles.empty())
        text += "/* Limits that limit nothing. Set those that you want, and pass them to @S@_tighten. */\nvoid @S@_no_limits (@S@_limits* limits);\n\n"
                "/* Tightens the limits of a device. One that is looser than the patch's changes nothing. Returns false, and does nothing, after the\n"
                "   first tick since prepare. */\n"
                "bool @S@_tighten (@S@* graph, @S@_role role, const @S@_limits* limits);\n\n"
                "/* The limits of a device that hold: those of the patch, tightened. */\n"
                "void @S@_limits_of (const @S@* graph, @S@_role role, @S@_limits* limits);\n\n"
                "/* Stops, as those of the class: see @S@.hpp. */\nvoid @S@_halt (@S@* graph);\nvoid @S@_resume (@S@* graph);\n"
                "void @S@_emergency_stop (@S@* graph);\nvoid @S@_rearm (@S@* graph);\nvoid @S@_lose_time (@S@* graph, double seconds);\n\n";
    return filled (text, { { "@S@", e.stem }, { "@U@", capitals (e.stem) } });
}

std::string cHeader (const Exported& e)
{
    const auto guard = capitals (e.stem) + "_H";
    return "/* SPDX-License-Identifier: MIT */\n/* " + filled (comment (e.graph.name.empty() ? e.stem : e.graph.name), { { "*/", "* /" } })
           + " as a C interface. All functions of a graph are for one thread. */\n#ifndef " + guard + "\n#define " + guard
           + "\n\n#include <stdbool.h>\n#include <stddef.h>\n#include <stdint.h>\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n#define " + capitals (e.stem)
           + "_RATE_HZ " + literal (e.wiring.plan.rateHz()) + "\n#define " + capitals (e.stem) + "_MAX_RATE_HZ " + literal (e.wiring.plan.rateHz())
           + "\n\ntypedef struct " + e.stem + " " + e.stem + ";\n\n" + cStructs (e) + cEnumOf (e, "param", enumerators (e.parameters))
           + cEnumOf (e, "control", enumerators (e.controls))
           + cEnumOf (e, "hit", e.hits) + cEnumOf (e, "role", e.wiring.role_ports) + limitsStruct (e) + cFunctions (e)
           + "#ifdef __cplusplus\n}\n#endif\n\n#endif\n";
}

/// Statements that copy the inputs into those of the class.
std::string readInputs (const Exported& e)
{
    std::string text;
    for (std::size_t i = 0; i < e.roles.size(); ++i)
    {
        const auto from = "inputs->" + e.wiring.role_ports[i] + ".", to = "in." + e.wiring.role_ports[i] + ".";
        for (const auto& m : reading_members)
            text += "    " + to + m.name + " = " + (m.count > 1 ? "vector (" + from + m.name + ")" : from + m.name) + ";\n";
        if (! e.roles[i].layout.axes.empty()) text += "    set (" + to + "axes, " + from + "axes);\n";
        if (e.roles[i].layout.signal_inputs > 0) text += "    set (" + to + "signals, " + from + "signals);\n";
    }
    for (const auto& feed : e.wiring.feed_names)
        text += "    in." + feed + " = inputs->" + feed + ";\n";
    return text;
}

std::string writeOutputs (const Exported& e)
{
    std::string text;
    for (std::size_t i = 0; i < e.roles.size(); ++i)
    {
        const auto from = "out." + e.wiring.role_ports[i] + ".", to = "outputs->" + e.wiring.role_ports[i] + ".";
        for (const auto& m : effortMembers (e.roles[i].layout))
            for (std::size_t c = 0; c < m.count; ++c)
            {
                const auto member = m.count > 1 ? m.name + ("[" + std::to_string (c) + "]") : std::string (m.name);
                text += "    " + to + member + " = " + from + member + ";\n";
            }
        if (! e.roles[i].layout.efforts.empty()) text += "    get (" + from + "axes, " + to + "axes);\n";
        if (e.roles[i].layout.signal_outputs > 0) text += "    get (" + from + "signals, " + to + "signals);\n";
    }
    for (std::size_t i = 0; i < e.wiring.tap_names.size(); ++i)
    {
        const auto& name = e.wiring.tap_names[i];
        text += e.wiring.plan.taps()[i].samples == nullptr ? "    outputs->" + name + " = out." + name + ";\n"
                                                           : "    std::copy (out." + name + ".begin(), out." + name + ".end(), outputs->" + name + ");\n";
    }
    return text;
}

std::string optionalFunctions (const Exported& e)
{
    std::string text;
    if (! e.parameters.empty())
        text += "void @S@_set (@S@* graph, @S@_param param, double value) { graph->all.set (static_cast<@C@::Param> (param), value); }\n"
                "double @S@_get (const @S@* graph, @S@_param param) { return graph->all.get (static_cast<@C@::Param> (param)); }\n";
    if (! e.controls.empty())
        text += "void @S@_turn (@S@* graph, @S@_control control, double position) { graph->all.set (static_cast<@C@::Control> (control), position); }\n";
    if (! e.hits.empty()) text += "void @S@_strike (@S@* graph, @S@_hit hit, double speed) { graph->all.strike (static_cast<@C@::Hit> (hit), speed); }\n";
    if (! e.roles.empty())
        text += "void @S@_no_limits (@S@_limits* limits) { copyLimits (tactus::GuardLimits {}, *limits); }\n\n"
                "bool @S@_tighten (@S@* graph, @S@_role role, const @S@_limits* limits)\n{\n"
                "    auto* const tightened = roleOf (graph->all, role);\n"
                "    tactus::GuardLimits more;\n"
                "    copyLimits (*limits, more);\n"
                "    return tightened != nullptr && tightened->tighten (more);\n}\n\n"
                "void @S@_limits_of (const @S@* graph, @S@_role role, @S@_limits* limits)\n{\n"
                "    const auto* const asked = roleOf (graph->all, role);\n"
                "    copyLimits (asked != nullptr ? asked->limits() : tactus::GuardLimits {}, *limits);\n}\n\n"
                "void @S@_halt (@S@* graph) { graph->all.halt(); }\nvoid @S@_resume (@S@* graph) { graph->all.resume(); }\n"
                "void @S@_emergency_stop (@S@* graph) { graph->all.emergencyStop(); }\nvoid @S@_rearm (@S@* graph) { graph->all.rearm(); }\n"
                "void @S@_lose_time (@S@* graph, double seconds) { graph->all.loseTime (seconds); }\n";
    return text;
}

/// Functions that convert limits, and choose the role that an enumerator means.
std::string limitHelpers (const Exported& e)
{
    if (e.roles.empty()) return {};
    std::string roles;
    for (std::size_t i = 0; i < e.roles.size(); ++i)
        roles += "    case " + capitals (e.stem) + "_ROLE_" + e.wiring.role_ports[i] + ":\n        return &all." + e.wiring.role_names[i] + ";\n";
    return "\n/// Null if there is no such role.\ntemplate <typename Graph>\nauto roleOf (Graph& all, @S@_role role) noexcept -> decltype (&all."
           + e.wiring.role_names.front() + ")\n{\n    switch (role)\n    {\n" + roles + "    }\n    return nullptr;\n}\n\n"
           + "template <typename From, typename To>\nvoid copyLimits (const From& from, To& to) noexcept\n{\n"
           + forLimits ([] (const std::string& key) { return "    to." + key + " = from." + key + ";\n"; })
           + "    to.dead_man_buttons = from.dead_man_buttons;\n}\n";
}

std::string cSource (const Exported& e)
{
    const bool reads = ! e.roles.empty() || ! e.wiring.feed_names.empty(), writes = ! e.roles.empty() || ! e.wiring.tap_names.empty();
    return filled (R"(// SPDX-License-Identifier: MIT
#include "@S@.h"
#include "@S@.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>

struct @S@
{
    @C@ all {};
};

namespace
{
[[maybe_unused]] tactus::Vec3 vector (const double (&three)[3]) noexcept { return { three[0], three[1], three[2] }; }

template <std::size_t n>
[[maybe_unused]] void set (tactus::Channels& channels, const double (&values)[n]) noexcept
{
    for (std::size_t i = 0; i < n; ++i)
        channels.set (static_cast<int> (i), values[i]);
}

template <std::size_t n>
[[maybe_unused]] void get (const tactus::Channels& channels, double (&values)[n]) noexcept
{
    for (std::size_t i = 0; i < n; ++i)
        values[i] = channels[static_cast<int> (i)];
}
@LIMITS@}   // namespace

size_t @S@_size (void) { return sizeof (@S@); }
size_t @S@_alignment (void) { return alignof (@S@); }

@S@* @S@_create (void* memory, size_t size)
{
    if (memory == nullptr || size < sizeof (@S@) || reinterpret_cast<std::uintptr_t> (memory) % alignof (@S@) != 0) return nullptr;
    auto* const graph = std::construct_at (static_cast<@S@*> (memory));
    graph->all.prepare();
    return graph;
}

bool @S@_prepare (@S@* graph, double ticks_per_second) { return graph->all.prepare (ticks_per_second); }

void @S@_init (@S@_inputs* inputs)
{
    *inputs = @S@_inputs {};
@VALID@}

void @S@_tick (@S@* graph, const @S@_inputs* @INPUTS@, @S@_outputs* @OUTPUTS@)
{
    @C@::Inputs in;
    @C@::Outputs out;
@READ@    graph->all.tick (in, out);
@WRITE@}

void @S@_destroy (@S@* graph)
{
    if (graph != nullptr) std::destroy_at (graph);
}

@MORE@)",
                   { { "@VALID@",
                       [&] {
                           std::string text;
                           for (const auto& role : e.wiring.role_ports)
                               text += "    inputs->" + role + ".valid = true;\n";
                           return text;
                       }() },
                     { "@INPUTS@", reads ? "inputs" : "" },
                     { "@OUTPUTS@", writes ? "outputs" : "" },
                     { "@READ@", readInputs (e) },
                     { "@WRITE@", writeOutputs (e) },
                     { "@MORE@", filled (optionalFunctions (e), { { "@C@", e.class_name }, { "@S@", e.stem } }) },
                     { "@LIMITS@", filled (limitHelpers (e), { { "@C@", e.class_name }, { "@S@", e.stem } }) },
                     { "@C@", e.class_name },
                     { "@S@", e.stem } });
}

std::string cExample (const Exported& e)
{
    std::string move, print;
    for (const auto& role : e.wiring.role_ports)
    {
        move += "        inputs." + role + ".position[0] = 1e-5 * k;\n        inputs." + role + ".position[2] = 0.002 - 4e-6 * k;\n";
        print += "        printf (\"%d %a %a %a\\n\", k, outputs." + role + ".force[0], outputs." + role + ".force[1], outputs." + role + ".force[2]);\n";
    }
    return filled (R"(/* SPDX-License-Identifier: MIT */
/* Moves the tool sideways and down into the object, and prints the force on each tick. */
#include "@S@.h"

#include <stdio.h>
#include <stdlib.h>

int main (void)
{
    void* const memory = malloc (@S@_size()); /* or static memory */
    @S@* const graph = @S@_create (memory, @S@_size());
    @S@_inputs inputs;
    @S@_outputs outputs;
    int k;
    if (graph == NULL || ! @S@_prepare (graph, @U@_RATE_HZ)) return 1;
    @S@_init (&inputs);
    for (k = 0; k < 1000; ++k)
    {
@MOVE@        @S@_tick (graph, &inputs, &outputs);
@PRINT@    }
    @S@_destroy (graph);
    free (memory);
    return 0;
}
)",
                   { { "@MOVE@", move }, { "@PRINT@", print }, { "@S@", e.stem }, { "@U@", capitals (e.stem) } });
}
}   // namespace

CFiles cFiles (const Exported& e) { return { cHeader (e), cSource (e), cExample (e) }; }

std::size_t readingBytes (const DeviceLayout& l) { return bytesOf (reading_members) + 8 * (l.axes.size() + static_cast<std::size_t> (l.signal_inputs)); }
std::size_t effortBytes (const DeviceLayout& l) { return bytesOf (effortMembers (l)) + 8 * (l.efforts.size() + static_cast<std::size_t> (l.signal_outputs)); }

std::vector<std::string> limitNames()
{
    std::vector<std::string> all;
    for (const auto& [key, value] : guard_fields)
        if (value != &GuardLimits::workspace_scale) all.emplace_back (key);
    return all;
}

}   // namespace tactus::host
