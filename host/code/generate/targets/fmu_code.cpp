// SPDX-License-Identifier: MIT
#include "fmu_code.hpp"
#include "fmu_template.hpp"

#include <tactus/run/log/run_head.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <set>

namespace tactus::host
{

namespace
{
/// A variable of the unit. Its number is its value reference, and its place among the variables of its type.
struct Variable
{
    enum class Kind
    {
        input,
        output,
        parameter,
        control,
        hit,
        limit
    };

    std::string name, about;
    Kind kind = Kind::input;
    std::string code;   ///< for an input, a statement in which @ is the value; for an output, its value; for a limit, its key; for others, an enumerator
    double start = 0.0, low = -inf, high = inf;
    std::string unit {};   ///< "N/m"; empty: unknown
};

struct Variables
{
    std::vector<Variable> reals;
    std::vector<std::pair<std::string, std::string>> buttons, valid;   ///< name and member, per role
    std::vector<std::pair<std::string, std::uint64_t>> held;           ///< the buttons of the dead-man's switch: name and value, per role
};

/// A limit that limits nothing is the largest number, because not every importer reads "INF".
double finite (double limit) { return std::min (limit, std::numeric_limits<double>::max()); }

void addInput (Variables& all, const std::string& name, const std::string& code, const std::string& unit, const std::string& about)
{
    all.reals.push_back ({ .name = "in." + name, .about = about, .kind = Variable::Kind::input, .code = code, .unit = unit });
}

void addOutput (Variables& all, const std::string& name, const std::string& code, const std::string& unit, const std::string& about = {})
{
    all.reals.push_back ({ .name = name, .about = about, .kind = Variable::Kind::output, .code = code, .unit = unit });
}

void addRoleInputs (Variables& all, const Exported& e, std::size_t i)
{
    const auto& role = e.wiring.role_ports[i];
    const auto in = "in." + role + ".";
    constexpr std::array<const char*, 3> vectors[] {
        { "position", "m", "of the tool" },
        { "rotation", "rad", "rotation vector" },
        { "true_position", "m", "of a simulated device" },
        { "true_velocity", "m/s", "of a simulated device" },
        { "unrendered_force", "N", "force that the motors could not render" },
        { "unrendered_torque", "N*m", "torque that the motors could not render" },
    };
    for (const auto& [name, unit, about] : vectors)
        for (const char c : { 'x', 'y', 'z' })
            addInput (all, role + "." + name + "." + c, in + name + "." + c + "() = @;", unit, about);
    addInput (all, role + ".pressure", in + "pressure = @;", "N", "of the hand");
    addInput (all, role + ".age", in + "age = @;", "s", "time since the device took this reading");
    for (std::size_t a = 0; a < e.roles[i].layout.axes.size(); ++a)
        addInput (all, role + ".axes." + std::to_string (a), in + "axes.set (" + std::to_string (a) + ", @);", "", e.roles[i].layout.axes[a]);
    for (int s = 0; s < e.roles[i].layout.signal_inputs; ++s)
        addInput (all, role + ".signals." + std::to_string (s), in + "signals.set (" + std::to_string (s) + ", @);", "", "signal input");
    all.buttons.emplace_back ("in." + role + ".buttons", in + "buttons");
    all.valid.emplace_back ("in." + role + ".valid", in + "valid");
}

void addRoleOutputs (Variables& all, const Exported& e, std::size_t i)
{
    const auto& role = e.wiring.role_ports[i];
    const auto out = "out." + role + ".";
    for (const auto& [name, unit] : { std::pair { "force", "N" }, { "torque", "N*m" } })
        for (const char c : { 'x', 'y', 'z' })
            addOutput (all, "out." + role + "." + name + "." + c, out + name + "." + c + "()", unit, "on the tool, after the guard");
    if (e.roles[i].layout.brake > 0.0) addOutput (all, "out." + role + ".brake", out + "brake", "N*s/m", "damping of the brake, after the guard");
    for (std::size_t a = 0; a < e.roles[i].layout.efforts.size(); ++a)
        addOutput (all, "out." + role + ".axes." + std::to_string (a), out + "axes[" + std::to_string (a) + "]", "", e.roles[i].layout.efforts[a]);
    for (int s = 0; s < e.roles[i].layout.signal_outputs; ++s)
        addOutput (all, "out." + role + ".signals." + std::to_string (s), out + "signals[" + std::to_string (s) + "]", "", "signal output");
}

/// The unit of a limit; "" for those of axes and signals, which depend on the device.
std::string unitOf (double GuardLimits::*limit)
{
    using L = GuardLimits;
    constexpr std::pair<double L::*, const char*> units[] {
        { &L::max_force, "N" },
        { &L::max_torque, "N*m" },
        { &L::max_slew, "N/s" },
        { &L::max_torque_slew, "N*m/s" },
        { &L::ramp, "s" },
        { &L::watchdog, "s" },
        { &L::max_brake, "N*s/m" },
        { &L::max_brake_slew, "N/m" },
        { &L::brake_at_stop, "N*s/m" },
        { &L::max_speed, "m/s" },
        { &L::max_angular_speed, "rad/s" },
        { &L::max_impulse, "N*s" },
        { &L::max_angular_impulse, "N*m*s" },
        { &L::impulse_window, "s" },
        { &L::max_energy, "J" },
        { &L::energy_window, "s" },
        { &L::max_still, "s" },
        { &L::still_force, "N" },
        { &L::still_torque, "N*m" },
        { &L::dead_man_pressure, "N" },
    };
    for (const auto& [member, unit] : units)
        if (member == limit) return unit;
    return {};
}

void addLimits (Variables& all, const Exported& e, std::size_t i)
{
    const auto& role = e.wiring.role_ports[i];
    const auto& limits = e.roles[i].limits;
    for (const auto& [key, value] : guard_fields)
        if (value != &GuardLimits::workspace_scale)
            all.reals.push_back ({ .name = "limit." + role + "." + std::string (key),
                                   .about = "limit of the guard; can only be tightened",
                                   .kind = Variable::Kind::limit,
                                   .code = std::string (key),
                                   .start = finite (limits.*value),
                                   .unit = unitOf (value) });
    all.held.emplace_back ("limit." + role + "." + std::string (dead_man_buttons), limits.dead_man_buttons);
}

void addTaps (Variables& all, const Exported& e)
{
    for (std::size_t i = 0; i < e.wiring.tap_names.size(); ++i)
    {
        const auto& tap = e.wiring.plan.taps()[i];
        const auto code = "out." + e.wiring.tap_names[i];
        if (tap.samples == nullptr)
            addOutput (all, "record." + tap.name, code, tap.unit);
        else
            for (int k = 0; k < tap.per_tick; ++k)
                addOutput (all, "record." + tap.name + "." + std::to_string (k), code + "[" + std::to_string (k) + "]", tap.unit);
    }
}

Variables variablesOf (const Exported& e)
{
    using Kind = Variable::Kind;
    Variables all;
    for (std::size_t i = 0; i < e.roles.size(); ++i)
        addRoleInputs (all, e, i);
    for (std::size_t i = 0; i < e.wiring.feed_names.size(); ++i)
        addInput (all, e.wiring.feed_names[i], "in." + e.wiring.feed_names[i] + " = @;", e.feed_units.at (i), "drives a port of the graph");
    for (std::size_t i = 0; i < e.roles.size(); ++i)
        addRoleOutputs (all, e, i);
    addTaps (all, e);
    for (std::size_t i = 0; i < e.roles.size(); ++i)
        addLimits (all, e, i);
    for (const auto& p : e.parameters)
    {
        const auto& hard = p.sheet->limits.hard;
        const bool is_choice = ! p.sheet->choices.empty();
        all.reals.push_back ({ .name = "param." + p.name,
                               .about = std::string (p.sheet->about),
                               .kind = Kind::parameter,
                               .code = e.class_name + "::Param::" + p.enumerator,
                               .start = p.value,
                               .low = is_choice ? 0.0 : hard.min,
                               .high = is_choice ? static_cast<double> (p.sheet->choices.size() - 1) : hard.max,
                               .unit = p.unit });
    }
    for (const auto& c : e.controls)
        all.reals.push_back ({ .name = "control." + c.id,
                               .about = c.name,
                               .kind = Kind::control,
                               .code = e.class_name + "::Control::" + c.enumerator,
                               .start = c.value,
                               .low = 0.0,
                               .high = 1.0,
                               .unit = "1" });
    for (std::size_t i = 0; i < e.hits.size(); ++i)
        all.reals.push_back ({ .name = "hit." + e.wiring.hit_names[i],
                               .about = "hits this input at this speed at the start of the step",
                               .kind = Kind::hit,
                               .code = e.class_name + "::Hit::" + e.hits[i],
                               .unit = "m/s" });
    return all;
}

std::string xml (std::string_view text)
{
    const std::string no_character = "\xef\xbf\xbe", nor_this = "\xef\xbf\xbf";   // U+FFFE and U+FFFF
    return filled (comment (text), { { "&", "&amp;" }, { "<", "&lt;" }, { ">", "&gt;" }, { "\"", "&quot;" }, { no_character, "" }, { nor_this, "" } });
}

std::string variableTag (const std::string& name, std::size_t number, const std::string& attributes, const std::string& about, const std::string& value)
{
    return "    <ScalarVariable name=\"" + xml (name) + "\" valueReference=\"" + std::to_string (number) + "\" " + attributes
           + (about.empty() ? "" : " description=\"" + xml (about) + "\"") + ">" + value + "</ScalarVariable>\n";
}

std::string attributesOf (Variable::Kind kind)
{
    using Kind = Variable::Kind;
    if (kind == Kind::output) return "causality=\"output\" variability=\"discrete\" initial=\"calculated\"";
    if (kind == Kind::limit) return "causality=\"parameter\" variability=\"fixed\" initial=\"exact\"";
    if (kind == Kind::input || kind == Kind::hit) return "causality=\"input\" variability=\"discrete\"";
    return "causality=\"parameter\" variability=\"tunable\" initial=\"exact\"";
}

std::string realTag (const Variable& v)
{
    std::string text = "<Real" + (v.unit.empty() ? std::string() : " unit=\"" + xml (v.unit) + "\"");
    if (v.low > -inf) text += " min=\"" + numberText (v.low) + "\"";
    if (v.high < inf) text += " max=\"" + numberText (v.high) + "\"";
    if (v.kind != Variable::Kind::output) text += " start=\"" + numberText (v.start) + "\"";
    return text + "/>";
}

/// 128 bits that change with the text, as a GUID.
std::string guidOf (const std::string& text)
{
    std::uint64_t a = 0xcbf29ce484222325, b = 0x84222325cbf29ce4;   // FNV-1a, with two starting values
    for (const char c : text)
    {
        a = (a ^ static_cast<unsigned char> (c)) * 0x100000001b3;
        b = (b ^ static_cast<unsigned char> (c)) * 0x100000001b3 + 1;
    }
    std::array<char, 48> buffer {};
    std::snprintf (buffer.data(), buffer.size(), "{%08x-%04x-%04x-%04x-%012llx}", static_cast<unsigned> (a >> 32), static_cast<unsigned> (a >> 16 & 0xffff),
                   static_cast<unsigned> (a & 0xffff), static_cast<unsigned> (b >> 48), static_cast<unsigned long long> (b & 0xffffffffffff));
    return buffer.data();
}

/// The definition of a unit by those of the SI: N is kg m s-2. A unit without one, such as dB, is only named.
std::string unitTag (const std::string& unit)
{
    const auto tag = "    <Unit name=\"" + xml (unit) + "\"";
    const auto measure = unit == "1" ? Result<Measure> { Measure {} } : parseMeasure ("1 " + unit);
    if (! measure) return tag + "/>\n";
    std::string base;
    const auto add = [&base] (const char* name, int exponent) {
        if (exponent != 0) base += std::string (" ") + name + "=\"" + std::to_string (exponent) + "\"";
    };
    add ("kg", measure->dimension.kg);
    add ("m", measure->dimension.m);
    add ("s", measure->dimension.s);
    add ("rad", measure->angular ? 1 : 0);
    return tag + "><BaseUnit" + base + "/></Unit>\n";
}

std::string unitTags (const Variables& all)
{
    std::set<std::string> units;
    for (const auto& v : all.reals)
        if (! v.unit.empty()) units.insert (v.unit);
    std::string text;
    for (const auto& unit : units)
        text += unitTag (unit);
    return text.empty() ? text : "  <UnitDefinitions>\n" + text + "  </UnitDefinitions>\n";
}

std::string variableTags (const Variables& all, std::string& outputs)
{
    std::string text;
    for (std::size_t i = 0; i < all.reals.size(); ++i)
    {
        const auto& v = all.reals[i];
        text += variableTag (v.name, i, attributesOf (v.kind), v.about, realTag (v));
        if (v.kind == Variable::Kind::output) outputs += "      <Unknown index=\"" + std::to_string (i + 1) + "\"/>\n";
    }
    for (std::size_t i = 0; i < all.buttons.size(); ++i)
        text += variableTag (all.buttons[i].first, i, "causality=\"input\" variability=\"discrete\"", "bit i: button i is down", "<Integer start=\"0\"/>");
    for (std::size_t i = 0; i < all.valid.size(); ++i)
        text += variableTag (all.valid[i].first, i, "causality=\"input\" variability=\"discrete\"", "false while the device has nothing to report",
                             "<Boolean start=\"true\"/>");
    for (std::size_t i = 0; i < all.held.size(); ++i)
        text += variableTag (all.held[i].first, all.buttons.size() + i, attributesOf (Variable::Kind::limit), "bit i: button i must be held",
                             "<Integer start=\"" + std::to_string (static_cast<std::int32_t> (all.held[i].second)) + "\"/>");
    return text;
}

std::string description (const Exported& e, const Variables& all)
{
    std::string outputs;
    const auto variables = variableTags (all, outputs);
    const auto structure = outputs.empty() ? "  <ModelStructure/>\n"
                                           : "  <ModelStructure>\n    <Outputs>\n" + outputs + "    </Outputs>\n    <InitialUnknowns>\n" + outputs
                                                 + "    </InitialUnknowns>\n  </ModelStructure>\n";
    return filled (R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="@NAME@" guid="@GUID@" description="@ABOUT@" generationTool="@TOOL@"
    variableNamingConvention="flat" numberOfEventIndicators="0">
  <CoSimulation modelIdentifier="@S@" canHandleVariableCommunicationStepSize="true" canGetAndSetFMUstate="true" canSerializeFMUstate="false"/>
@UNITS@  <DefaultExperiment startTime="0" stepSize="@STEP@"/>
  <ModelVariables>
@VARIABLES@  </ModelVariables>
@STRUCTURE@</fmiModelDescription>
)",
                   { { "@NAME@", xml (e.graph.name.empty() ? e.stem : e.graph.name) },
                     { "@ABOUT@", xml (e.graph.about) },
                     { "@TOOL@", xml (e.program) },
                     { "@GUID@", guidOf (e.program + variables) },
                     { "@S@", e.stem },
                     { "@STEP@", numberText (1.0 / e.wiring.plan.rateHz()) },
                     { "@UNITS@", unitTags (all) },
                     { "@VARIABLES@", variables },
                     { "@STRUCTURE@", structure } });
}

/// The code with which the functions of the unit access its variables.
struct Access
{
    std::string read, write, set, strike, starts;
    std::string parameters, controls;   ///< how many there are of which numbers
};

Access accessOf (const Variables& all)
{
    using Kind = Variable::Kind;
    Access a;
    for (std::size_t i = 0; i < all.reals.size(); ++i)
    {
        const auto& v = all.reals[i];
        const auto value = "real[" + std::to_string (i) + "]";
        if (v.start != 0.0) a.starts += "    unit." + value + " = " + literal (v.start) + ";\n";
        if (v.kind == Kind::input) a.read += "    " + filled (v.code, { { "@", "unit." + value } }) + "\n";
        if (v.kind == Kind::output) a.write += "    unit." + value + " = " + v.code + ";\n";
        if (v.kind == Kind::parameter || v.kind == Kind::control)
            a.set += "    case " + std::to_string (i) + ":\n        unit.graph.set (" + v.code + ", unit." + value + ");\n        break;\n";
        if (v.kind == Kind::hit) a.strike += "    unit.graph.strike (" + v.code + ", unit." + value + ");\n";
    }
    for (std::size_t i = 0; i < all.buttons.size(); ++i)
    {
        a.read += "    " + all.buttons[i].second + " = static_cast<std::uint32_t> (unit.integer[" + std::to_string (i) + "]);\n";
        a.read += "    " + all.valid[i].second + " = unit.boolean[" + std::to_string (i) + "] != fmi2False;\n";
        a.starts += "    unit.boolean[" + std::to_string (i) + "] = fmi2True;\n";
        const auto held = static_cast<std::int32_t> (all.held[i].second);
        a.starts += "    unit.integer[" + std::to_string (all.buttons.size() + i) + "] = " + std::to_string (held) + ";\n";
    }
    return a;
}

/// Statements that tighten the limits of each role to those that are set, and show those that hold.
std::string tightenOf (const Exported& e, const Variables& all)
{
    std::string text;
    for (std::size_t i = 0; i < e.roles.size(); ++i)
    {
        std::string from, to;
        const auto role = "unit.graph." + e.wiring.role_names[i], prefix = "limit." + e.wiring.role_ports[i] + ".";
        for (std::size_t n = 0; n < all.reals.size(); ++n)
        {
            const auto& v = all.reals[n];
            if (v.kind != Variable::Kind::limit || v.name != prefix + v.code) continue;
            const auto value = "unit.real[" + std::to_string (n) + "]";
            from += "        limits." + v.code + " = unlimited (" + value + ");\n";
            to += "        " + value + " = std::min (" + role + ".limits()." + v.code + ", largest);\n";
        }
        text += "    {\n        tactus::GuardLimits limits;\n" + from + "        limits.dead_man_buttons = static_cast<std::uint32_t> (unit.integer["
                + std::to_string (all.buttons.size() + i) + "]);\n        (void) " + role + ".tighten (limits);\n" + to + "    }\n";
    }
    return text;
}

/// By real variable: an output, which cannot be set; a limit, which can be set before the first step; or one that can always be set.
std::string kindsOf (const Variables& all)
{
    std::string text;
    for (const auto& v : all.reals)
        text += v.kind == Variable::Kind::output ? "o" : v.kind == Variable::Kind::limit ? "l"
                                                                                         : "i";
    return text;
}
}   // namespace

FmuFiles fmuFiles (const Exported& e)
{
    const auto all = variablesOf (e);
    FmuFiles files;
    files.description = description (e, all);
    const auto begin = files.description.find ("guid=\"") + 6;
    const auto guid = files.description.substr (begin, files.description.find ('"', begin) - begin);
    const auto a = accessOf (all);
    files.source = filled (fmuSource(), { { "@READ@", a.read },
                                          { "@WRITE@", a.write },
                                          { "@SET@", a.set },
                                          { "@STRIKE@", a.strike },
                                          { "@STARTS@", a.starts },
                                          { "@TIGHTEN@", tightenOf (e, all) },
                                          { "@KINDS@", kindsOf (all) },
                                          { "@REALS@", std::to_string (all.reals.size()) },
                                          { "@ROLES@", std::to_string (all.buttons.size()) },
                                          { "@GUID@", guid },
                                          { "@C@", e.class_name },
                                          { "@S@", e.stem } });
    files.make = filled (fmuMake(), { { "@S@", e.stem } });
    return files;
}

}   // namespace tactus::host
