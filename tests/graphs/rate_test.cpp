// SPDX-License-Identifier: MIT
// Every preset renders the same physics at any rate. A new preset is checked automatically.

#include "support/sketch.hpp"

#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
const fs::path folder = fs::path (TACTUS_SOURCE_DIR) / "graphs";

/// The slow force is what the hand follows, the vibration what the skin feels. A rate of 1 kHz can render both bands. The skin also
/// feels what lies above them, up to about 1 kHz.
constexpr double slow_below_hz = 30.0, vibration_below_hz = 400.0, felt_below_hz = 1000.0;

/// Presets whose physics cannot be rendered at 1 kHz: the rate in Hz that they need, and why. Their rate_hz is at least this rate, and
/// their description says what is wrong at 1 kHz.
const std::map<std::string, std::pair<double, std::string>> needs {
    { "braked_wall", { 4000.0, "a wall of 6 N/mm, off which a tool of 50 g bounces within 9 ms" } },
    { "machined_steel", { 4000.0, "friction with a stiffness of 40 N/mm, which needs a damping of 20 N s/m at 1 kHz" } },
    { "singing_glass", { 4000.0, "tones of 900 and 2088 Hz" } },
    { "window_pane", { 4000.0, "friction with a stiffness of 20 N/mm, which needs a damping of 10 N s/m at 1 kHz, and tones of 900 and 1870 Hz" } },
};

struct Played
{
    std::vector<std::vector<double>> forces;   // on the tools, one list for each component
    std::vector<double> recorded;
};

/// Runs the graph with its own devices. `record` is the name of a port with one component.
Played play (graph::Graph g, double rate_hz, const std::string& record = {})
{
    static host::FileAssets assets;
    g.rate_hz = rate_hz;
    CompileOptions options { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } };
    if (! record.empty()) options.records = { record };
    const auto [plan, messages] = compile (g, catalogue(), options);
    INFO (test::text (messages));
    REQUIRE (plan);

    Engine engine { plan };
    std::vector<MadeDevice> devices;
    double duration = 0.0;
    for (const auto& role : plan->roles())
    {
        const auto described = std::ranges::find (g.devices, role.name, &std::pair<std::string, Json>::first);
        REQUIRE (described != g.devices.end());
        devices.push_back (makeDevice (described->second, folder));
        REQUIRE (devices.back().device);
        engine.attach (role.name, *devices.back().device, devices.back().limits);
        duration = std::max (duration, devices.back().device->duration());
    }

    Played played { .forces = std::vector<std::vector<double>> (3 * devices.size()), .recorded = {} };
    const int ticks = static_cast<int> (std::lround (duration * rate_hz));
    for (int k = 0; k < ticks; ++k)
    {
        engine.tick();
        auto component = played.forces.begin();
        for (const auto& role : plan->roles())
            for (int i = 0; i < 3; ++i)
                (component++)->push_back (role.state->applied.force[i]);
        if (! record.empty()) played.recorded.push_back (*plan->taps()[0].value);
    }
    return played;
}

struct Rms
{
    double slow = 0.0, vibration = 0.0, felt = 0.0;   // N; `felt` is the vibration up to felt_below_hz
};

/// The RMS of the force in the bands. The bins have the same frequencies at every rate, because the duration is the same.
Rms rmsOf (const Played& played, double rate_hz)
{
    Rms power;
    for (const auto& force : played.forces)
    {
        const auto ticks = static_cast<double> (force.size());
        std::vector<std::complex<double>> bins;
        Eigen::FFT<double> {}.fwd (bins, force);
        for (std::size_t i = 0; 2 * i < force.size(); ++i)
        {
            const double f = static_cast<double> (i) * rate_hz / ticks;
            const double p = (i == 0 ? 1.0 : 2.0) * std::norm (bins[i]) / (ticks * ticks);
            if (f < slow_below_hz)
                power.slow += p;
            else if (f < vibration_below_hz)
                power.vibration += p;
            if (f >= slow_below_hz && f < felt_below_hz) power.felt += p;
        }
    }
    return { std::sqrt (power.slow), std::sqrt (power.vibration), std::sqrt (power.felt) };
}

double rateFrom (const std::string& preset)
{
    const auto found = needs.find (preset);
    return found == needs.end() ? 1000.0 : found->second.first;
}

/// How often a signal rises from 0 to 1, and the share of the time for which it is 1.
std::pair<int, double> openings (const std::vector<double>& gate)
{
    int rises = 0;
    double open = 0.0;
    for (std::size_t k = 1; k < gate.size(); ++k)
    {
        rises += gate[k] > gate[k - 1] ? 1 : 0;
        open += gate[k];
    }
    return { rises, open / static_cast<double> (gate.size()) };
}
}   // namespace

TEST_CASE ("every preset renders the same slow force and the same vibration at 1, 4 and 20 kHz, or from the rate that it is listed to need", "[graphs][rate]")
{
    for (const auto& entry : fs::directory_iterator (folder))
    {
        const auto preset = entry.path().stem().string();
        if (entry.path().extension() != ".json") continue;
        DYNAMIC_SECTION (preset)
        {
            const auto g = loadGraph (entry.path()).graph;
            const double from = rateFrom (preset);
            if (from > 1000.0) std::cout << preset << " needs " << from << " Hz: " << needs.at (preset).second << '\n';
            CHECK (g.rate_hz >= from);
            if (from > 1000.0) CHECK (g.about.find ("1 kHz") != g.about.npos);

            const Rms expected = rmsOf (play (g, 20000.0), 20000.0);
            CHECK (expected.slow > 0.01);
            for (const double rate : { 1000.0, 4000.0 })
            {
                if (rate < from) continue;
                const Rms is = rmsOf (play (g, rate), rate);
                INFO (rate << " Hz: vibration of " << is.vibration << " N instead of " << expected.vibration << " N");
                CHECK (is.slow == Approx (expected.slow).epsilon (0.02));
                CHECK (is.vibration == Approx (expected.vibration).epsilon (0.1));
                if (rate > 2.0 * felt_below_hz) CHECK (is.felt == Approx (expected.felt).epsilon (0.1));
            }
        }
    }
}

TEST_CASE ("the list of presets that need a higher rate names only presets that do", "[graphs][rate]")
{
    for (const auto& [preset, need] : needs)
        DYNAMIC_SECTION (preset)
        {
            REQUIRE (fs::exists (folder / (preset + ".json")));
            const auto g = loadGraph (folder / (preset + ".json")).graph;
            const Rms expected = rmsOf (play (g, 20000.0), 20000.0), slower = rmsOf (play (g, 1000.0), 1000.0);
            const auto off = [] (double is, double should_be) { return std::abs (is / should_be - 1.0); };
            const double vibration = std::max (off (slower.vibration, expected.vibration), off (slower.felt, expected.felt));
            CHECK (std::max (off (slower.slow, expected.slow) / 0.02, vibration / 0.1) > 1.0);
        }
}

TEST_CASE ("the steps of an encoder change the slow force of a damped contact by less than 0.3 %, because its damping has a window", "[graphs][rate]")
{
    for (const char* preset : { "denim", "oak_board", "sandpaper", "two_fingers" })
    {
        CAPTURE (preset);
        const auto g = loadGraph (folder / (std::string (preset) + ".json")).graph;
        const auto slow = [&] (const char* quantum, double window_s) {
            auto changed = g;
            for (auto& [role, device] : changed.devices)
                device["quantum"] = quantum;
            auto* patch = &changed.root.nodes;
            for (auto& [name, inner] : changed.graphs)
                if (std::ranges::count (inner.nodes, "deform.plane", &graph::Node::type) > 0) patch = &inner.nodes;
            const auto plane = std::ranges::find (*patch, "deform.plane", &graph::Node::type);
            REQUIRE (plane != patch->end());
            REQUIRE (plane->settings.contains ("window"));
            plane->settings["window"] = window_s;
            return rmsOf (play (changed, 20000.0), 20000.0).slow;
        };
        const double exact = slow ("0 um", 1e-3), is = slow ("5 um", 1e-3), without = slow ("5 um", 0.0);
        CHECK (is == Approx (exact).epsilon (0.003));
        CHECK (std::abs (without / exact - 1.0) > 0.003);
    }
}

TEST_CASE ("the steps of an encoder do not interrupt the crunch of the potato, at any rate", "[graphs][rate]")
{
    auto g = loadGraph (folder / "potato_cut.json").graph;
    const auto exact = openings (play (g, 4000.0, "parting.gate").recorded);
    CHECK (exact.first == 1);
    CHECK (exact.second > 0.2);
    const auto parting = std::ranges::find (g.root.nodes, "parting", &graph::Node::name);
    REQUIRE (parting != g.root.nodes.end());
    for (const double rate : { 1000.0, 4000.0, 20000.0 })
        for (const char* quantum : { "5 um", "20 um", "50 um" })
        {
            INFO (rate << " Hz, " << quantum);
            g.devices[0].second["quantum"] = quantum;
            const auto [rises, open] = openings (play (g, rate, "parting.gate").recorded);
            CHECK (rises <= 4);   // at the end the blade is so slow that an encoder step takes longer than `hold`
            CHECK (open == Approx (exact.second).margin (0.04));
        }

    parting->params["hold"] = 0.0;
    CHECK (openings (play (g, 20000.0, "parting.gate").recorded).first > 100);
}
