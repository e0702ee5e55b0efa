// SPDX-License-Identifier: MIT
// Detents of a graph as the configuration of a SmartKnob: what its firmware makes of them is compared with what the graph renders.

#include <host/code/generate/export_graph.hpp>
#include <host/devices/hid/report/crc32.hpp>
#include <host/devices/hid/report/framing.hpp>
#include <support/sketch.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/engine.hpp>
#include <tactus/text/json_text.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <map>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// A knob whose torque about z, in N m, is a formula of its angle in0, in rad.
graph::Graph knobWith (const std::string& formula, const std::string& more_nodes = {}, const std::string& more_wires = {})
{
    const auto read = readGraph (R"({ "format": "tactus-graph", "version": 2, "name": "Knob", "rate_hz": 1000, "devices": { "knob": { "driver": "sim" } },
        "nodes": { "hand": { "type": "device.position", "role": "knob" }, "motor": { "type": "device.force", "role": "knob" },
                   "detents": { "type": "signal.expression", "settings": { "inputs": 1, "text": ")"
                                 + formula + "\" } }" + more_nodes + R"( },
        "wires": ["hand.rotation.z -> detents.in[0]", "detents.out -> motor.torque.z")"
                                 + more_wires + "] }");
    INFO (test::text (read.messages));
    REQUIRE_FALSE (hasErrors (read.messages));
    return read.graph;
}

ExportedFolder knobOf (const graph::Graph& graph, double torque_per_volt = 0.005)
{
    return exportGraph (graph, { .file = "my_knob.json",
                                 .program = "tactus",
                                 .compile = {},
                                 .target = ExportTarget::smartknob,
                                 .knob = { .torque_per_volt = torque_per_volt },
                                 .open = {} });
}

const std::string& fileOf (const ExportedFolder& folder, const std::string& name)
{
    INFO (test::text (folder.messages));
    const auto found = std::ranges::find (folder.files, name, &std::pair<std::string, std::string>::first);
    REQUIRE (found != folder.files.end());
    return found->second;
}

/// The torque of the graph at each of these angles.
std::vector<double> renderedAlong (const graph::Graph& graph, const std::vector<double>& angles)
{
    struct Swept final : Device
    {
        void prepare (double) override {}
        Reading read() noexcept override { return { .rotation = { 0.0, 0.0, angle } }; }
        void write (const Effort& e) noexcept override { torque = e.torque.z(); }
        double angle = 0.0, torque = 0.0;
    } knob;
    const auto compiled = compile (graph, catalogue(), {});
    REQUIRE (compiled.plan);
    Engine engine { compiled.plan };
    engine.attach ("knob", knob);
    std::vector<double> torques;
    for (const double angle : angles)
    {
        knob.angle = angle;
        for (int k = 0; k < 8; ++k)
            engine.tick();
        torques.push_back (knob.torque);
    }
    return torques;
}

/// What the firmware of the knob makes of a configuration, from its public description: a step of its loop for each angle.
std::vector<double> playedAlong (const Json& config, double torque_per_volt, const std::vector<double>& angles)
{
    const auto at = [&] (const char* key) { return config.at (key).get<double>(); };
    const double width = at ("position_width_radians"), snap = at ("snap_point");
    const int lowest = config.at ("min_position").get<int>(), highest = config.at ("max_position").get<int>();
    const bool bounded = highest >= lowest;
    int position = config.at ("position").get<int>();
    double middle = at ("sub_position_unit") * width;
    std::vector<double> torques;
    for (const double angle : angles)
    {
        if (angle - middle > width * snap && (! bounded || position > lowest))
        {
            middle += width;
            --position;
        }
        else if (angle - middle < -width * snap && (! bounded || position < highest))
        {
            middle -= width;
            ++position;
        }
        const double off = angle - middle, zone = std::min (0.2 * width, std::acos (-1.0) / 180.0);
        const double rest = off > zone ? off - zone : off < -zone ? off + zone
                                                                  : 0.0;
        const bool out = bounded && ((off > 0.0 && position == lowest) || (off < 0.0 && position == highest));
        const double volts = -4.0 * at (out ? "endstop_strength_unit" : "detent_strength_unit") * rest;
        torques.push_back (torque_per_volt * std::clamp (volts, -5.0, 5.0));
    }
    return torques;
}

std::vector<double> toAndFro (double half)
{
    std::vector<double> angles;
    constexpr double step = 0.0011;
    const int steps = static_cast<int> (half / step);
    for (int i = 0; i > -steps; --i)
        angles.push_back (i * step);
    for (int i = -steps; i < steps; ++i)
        angles.push_back (i * step);
    for (int i = steps; i > -steps; --i)
        angles.push_back (i * step);
    return angles;
}

/// How many of the torques differ by more than a part of the largest.
std::size_t differing (const std::vector<double>& a, const std::vector<double>& b, double part)
{
    double largest = 0.0;
    for (const double t : a)
        largest = std::max (largest, std::abs (t));
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += std::abs (a[i] - b[i]) > part * largest ? 1 : 0;
    return count;
}

// The angle from the nearest of detents that are 0.61 rad apart, beyond a dead zone of 1 degree; 0.01 N m per rad are a strength of 0.5 at 5 mN m per volt.
const std::string off_detent = "(in0-0.1-0.61*floor((in0-0.1)/0.61+0.5))";
const std::string beyond_zone = "(" + off_detent + "-clamp(" + off_detent + ",-0.017453292519943295,0.017453292519943295))";
const std::string springs = "-0.01*" + beyond_zone;

std::string problemOf (const graph::Graph& graph, double torque_per_volt = 0.005)
{
    const auto folder = knobOf (graph, torque_per_volt);
    if (! hasErrors (folder.messages)) return {};
    CHECK (folder.files.empty());
    CHECK_FALSE (folder.messages.back().remedy.empty());
    return folder.messages.back().id;
}
}   // namespace

TEST_CASE ("detents like those of a SmartKnob are exported so that its firmware renders the torque of the graph", "[export][smartknob]")
{
    const auto graph = knobWith (springs);
    const auto folder = knobOf (graph);
    CHECK (folder.messages.empty());
    const auto config = readJson (fileOf (folder, "my_knob.json")).root;
    CHECK (config.at ("position_width_radians").get<double>() == Approx (0.61).epsilon (1e-3));
    CHECK (config.at ("detent_strength_unit").get<double>() == Approx (0.5).epsilon (0.01));
    CHECK (config.at ("snap_point").get<double>() == 0.5);
    CHECK (config.at ("sub_position_unit").get<double>() == Approx (0.1 / 0.61).epsilon (0.01));
    CHECK (config.at ("max_position").get<int>() < config.at ("min_position").get<int>());   // all the way round
    CHECK (config.at ("text").get<std::string>() == "my_knob");

    const auto angles = toAndFro (1.5);
    const auto wanted = renderedAlong (graph, angles), played = playedAlong (config, 0.005, angles);
    CHECK (differing (wanted, played, 0.02) <= 40);   // where the torque jumps, 13 times, which is known to a step
    CHECK (differing (wanted, std::vector<double> (wanted.size()), 0.02) > wanted.size() / 2);
}

TEST_CASE ("detents between two stops keep their number, their side and the strength of the stops", "[export][smartknob]")
{
    // Detents at -1.12, -0.51, 0.1 and 0.71 rad; beyond the outer ones, a spring of 0.05 N m per rad.
    const std::string stop_above = "(-0.05*(in0-0.71-clamp(in0-0.71,-0.017453292519943295,0.017453292519943295)))",
                      stop_below = "(-0.05*(in0+1.12-clamp(in0+1.12,-0.017453292519943295,0.017453292519943295)))";
    const auto graph = knobWith ("in0>0.71?" + stop_above + ":in0<-1.12?" + stop_below + ":" + springs);
    const auto folder = knobOf (graph);
    const auto config = readJson (fileOf (folder, "my_knob.json")).root;
    CHECK (config.at ("min_position").get<int>() == -1);   // counterclockwise
    CHECK (config.at ("max_position").get<int>() == 2);
    CHECK (config.at ("detent_strength_unit").get<double>() == Approx (0.5).epsilon (0.01));
    CHECK (config.at ("endstop_strength_unit").get<double>() == Approx (2.5).epsilon (0.02));   // where it begins is known to a step
    const auto angles = toAndFro (1.2);
    CHECK (differing (renderedAlong (graph, angles), playedAlong (config, 0.005, angles), 0.02) <= 40);
}

TEST_CASE ("detents of another shape are exported with a warning that says by how much the knob differs", "[export][smartknob]")
{
    const auto graph = knobWith ("-0.004*sin(2*pi*in0/0.61)");
    const auto folder = knobOf (graph);
    REQUIRE (folder.messages.size() == 1);
    CHECK (folder.messages[0].id == "smartknob/shape");
    const auto config = readJson (fileOf (folder, "my_knob.json")).root;
    const auto angles = toAndFro (3.0);
    const auto wanted = renderedAlong (graph, angles), played = playedAlong (config, 0.005, angles);
    double off = 0.0;
    for (std::size_t i = 0; i < angles.size(); ++i)
        off += (wanted[i] - played[i]) * (wanted[i] - played[i]);
    const double differs = std::sqrt (off / static_cast<double> (angles.size())) / 0.004;
    // A sine and the sawtooth closest to it differ by sqrt (1/2 - 3/pi^2) of its height; the dead zone changes this a little.
    CHECK (differs == Approx (std::sqrt (0.5 - 3.0 / (std::acos (-1.0) * std::acos (-1.0)))).epsilon (0.1));
    const auto& text = folder.messages[0].text;
    CHECK (std::stod (text.substr (text.find ("by ") + 3)) == Approx (100.0 * differs).margin (3.0));
}

TEST_CASE ("what a SmartKnob cannot do is refused with a remedy, and a guessed motor is said to be one", "[export][smartknob]")
{
    CHECK (problemOf (knobWith (springs)).empty());
    CHECK (problemOf (knobWith ("0*in0")) == "smartknob/no_detent");
    CHECK (problemOf (knobWith ("0.01*in0")) == "smartknob/no_detent");   // it is pushed away
    CHECK (problemOf (knobWith ("-0.004*sin(in0*in0)")) == "smartknob/uneven");
    CHECK (problemOf (knobWith ("-0.004*sin(300*in0)")) == "smartknob/fine");
    CHECK (problemOf (knobWith (springs), 0.0001) == "smartknob/strong");
    CHECK (problemOf (knobWith ("-0.01*" + off_detent + "-0.0026")) == "smartknob/shape");   // more of a push than of a detent
    const std::string shaken = R"(, "shake": { "type": "signal.lfo", "params": { "frequency": 30, "amplitude": 0.001 } },
                                "sum": { "type": "signal.expression", "settings": { "inputs": 1, "text": "in0" } })";
    CHECK (problemOf (knobWith (springs, shaken, R"(, "shake.out -> sum.in[0]", "sum.out -> motor.torque.z")")) == "smartknob/moves");
    const std::string second = R"(, "other": { "type": "device.position", "role": "left" }, "push": { "type": "device.force", "role": "left" },
                                "copy": { "type": "signal.expression", "settings": { "inputs": 1, "text": "in0" } })";
    CHECK (problemOf (knobWith (springs, second, R"(, "other.rotation.z -> copy.in[0]", "copy.out -> push.torque.z")")) == "smartknob/role");

    // A limit of the role that the knob, which has no guard, could exceed.
    const auto limited = [&] (const std::string& formula, const char* most) {
        auto graph = knobWith (formula);
        graph.devices.front().second["guard"] = { { "max_torque", most } };
        return problemOf (graph);
    };
    CHECK (limited (springs, "2 mN*m") == "smartknob/limit");
    CHECK (limited (springs, "100 mN*m").empty());

    const auto guessed = knobOf (knobWith (springs), 0.0);
    REQUIRE (guessed.messages.size() == 1);
    CHECK (guessed.messages[0].id == "smartknob/torque");
    CHECK (fileOf (guessed, "README.md").find ("a guess") != std::string::npos);
}

TEST_CASE ("the message of a SmartKnob is a frame with its CRC, and has the fields of the configuration", "[export][smartknob]")
{
    const KnobConfig config {
        .min_position = -3, .max_position = 4, .sub_position = 0.25, .width = 0.5, .detent_strength = 1.5, .endstop_strength = 2.0, .text = "clicks"
    };
    const auto message = knobMessage (config);
    hid::FrameReader reader (hid::Framing::cobs, { { {}, 1, 200, {} } });
    std::ranges::copy (message, reader.room().begin());
    reader.arrived (message.size());
    const auto report = reader.next();
    REQUIRE (report);                  // the frame is whole, and its CRC right
    CHECK (message.front() == '\0');   // switches the knob to this protocol
    CHECK (message.back() == '\0');

    // The wire format of protocol buffers: a tag with the kind of the value in its lower three bits, and the value.
    struct Fields
    {
        std::map<int, std::uint64_t> numbers;
        std::map<int, float> floats;
        std::map<int, std::string> texts;
    };
    const auto read = [] (std::string_view bytes) {
        Fields all;
        std::size_t at = 0;
        const auto varint = [&] {
            std::uint64_t v = 0;
            for (int shift = 0;; shift += 7)
            {
                REQUIRE (at < bytes.size());
                const auto byte = static_cast<std::uint8_t> (bytes[at++]);
                v |= std::uint64_t { byte & 0x7fu } << shift;
                if (byte < 0x80) return v;
            }
        };
        while (at < bytes.size())
        {
            const auto tag = varint();
            const int field = static_cast<int> (tag >> 3);
            if ((tag & 7) == 0) all.numbers[field] = varint();
            if ((tag & 7) == 5)
            {
                std::uint32_t raw = 0;
                for (int i = 0; i < 4; ++i)
                    raw |= static_cast<std::uint32_t> (static_cast<std::uint8_t> (bytes[at++])) << 8 * i;
                all.floats[field] = std::bit_cast<float> (raw);
            }
            if ((tag & 7) == 2)
            {
                const auto size = varint();
                all.texts[field] = std::string (bytes.substr (at, size));
                at += size;
            }
        }
        return all;
    };
    const auto outer = read ({ reinterpret_cast<const char*> (report->data()), report->size() });
    CHECK (outer.numbers.at (1) == 1);   // the version of the protocol
    CHECK (outer.numbers.at (2) != 0);
    const auto inner = read (outer.texts.at (4));
    CHECK (inner.numbers == std::map<int, std::uint64_t> { { 4, static_cast<std::uint64_t> (-3) }, { 5, 4 } });
    CHECK (inner.floats == std::map<int, float> { { 2, 0.25f }, { 6, 0.5f }, { 7, 1.5f }, { 8, 2.0f }, { 9, 0.5f } });
    CHECK (inner.texts == std::map<int, std::string> { { 10, "clicks" } });
}
