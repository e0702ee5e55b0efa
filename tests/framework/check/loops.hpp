// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/check/trials/trials.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/device/sim.hpp>
#include <tactus/run/engine.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tactus::test
{

/// One table of heights, whatever file a graph asks for.
struct OneTable final : Assets
{
    std::shared_ptr<const Grid> grid;

    Loaded<Signal> signal (const std::string& path) override { return none (path); }
    Loaded<Grid> image (const std::string& path) override { return none (path); }
    Loaded<Grid> table (const std::string&) override { return grid; }
    Loaded<Mesh> mesh (const std::string& path) override { return none (path); }

private:
    static Message none (const std::string& path) { return Message::error ("asset/unreadable", path, "there is only a table"); }
};

/// A tool that stays where a test puts it.
struct HeldTool final : Device
{
    Reading now {};

    void prepare (double) override {}
    Reading read() noexcept override { return now; }
    void write (const Effort&) noexcept override {}
};

/// Hands named h0, h1, … on simulated devices, with springs between their positions and their forces. A test first judges
/// the loop as `tactus check` does, then lets go of the tools near their equilibrium.
struct Loops
{
    double rate_hz = 1000.0;
    std::vector<Simulation> tools;
    std::vector<std::string> nodes {}, wires {}, graphs {};   // JSON
    std::shared_ptr<OneTable> assets = std::make_shared<OneTable>();

    struct Pull
    {
        std::string from, to;
        double stiffness;
    };
    std::vector<Pull> pulls {};

    /// True if the springs push the tools away from where they are, however slowly: no device could keep them there.
    bool pushesAway() const
    {
        const auto number = [] (const std::string& place) { return 3 * (place[1] - '0') + place[3] - 'x'; };
        Eigen::MatrixXd k = Eigen::MatrixXd::Zero (static_cast<Eigen::Index> (3 * tools.size()), static_cast<Eigen::Index> (3 * tools.size()));
        for (const auto& p : pulls)
            k (number (p.to), number (p.from)) += p.stiffness;
        const Eigen::VectorXcd values = k.eigenvalues();
        return std::any_of (values.begin(), values.end(), [] (const auto& v) { return v.real() < 0.0 && std::abs (v.imag()) < 1e-9 * std::abs (v); });
    }

    std::string hand (std::size_t i) const { return "h" + std::to_string (i); }

    /// The position `from` ("h0.x") drives the force `to` with this stiffness, in N/m: f = -stiffness p.
    void pull (const std::string& from, const std::string& to, double stiffness, int delay = 0)
    {
        pulls.push_back ({ from, to, stiffness });
        const auto name = [] (const std::string& place, const char* part) { return place.substr (0, 2) + part + place.substr (2); };
        wire (name (from, "_at.position"), name (to, "_motor.force"), std::to_string (-stiffness) + " N/m", delay);
    }

    void wire (const std::string& from, const std::string& to, const std::string& gain = "1", int delay = 0)
    {
        const auto late = delay > 0 ? "[" + std::to_string (delay) + "] -> " : std::string();
        wires.push_back (R"({ "wire": ")" + from + " -> " + late + to + R"(", "gain": ")" + gain + R"(" })");
    }

    /// A spring from a hand to a fixed point, along one axis.
    void ground (const std::string& place, double stiffness, int delay = 0) { pull (place, place, stiffness, delay); }

    /// A spring between two hands, along one axis.
    void spring (const std::string& a, const std::string& b, double stiffness, int delay = 0)
    {
        for (const auto& [from, to] : { std::pair (a, b), std::pair (b, a) })
        {
            pull (from, from, stiffness, delay);
            pull (from, to, -stiffness, delay);
        }
    }

    /// A spring to a fixed point whose force is computed on every k-th tick and held.
    void slowGround (std::size_t i, char axis, double stiffness, int k)
    {
        const auto name = "slow" + std::to_string (nodes.size());
        const auto end = std::string (".") + axis;
        pulls.push_back ({ hand (i) + end, hand (i) + end, stiffness });
        nodes.push_back ('"' + name + R"(": { "type": "graph:)" + name + R"(", "every": )" + std::to_string (k) + R"( })");
        graphs.push_back ('"' + name + R"(": { "nodes": { "pass": { "type": "signal.gain" } },
            "expose": { "inputs": { "in": "pass.in" }, "outputs": { "out": "pass.out" } } })");
        wire (hand (i) + "_at.position" + end, name + ".in");
        wire (name + ".out", hand (i) + "_motor.force" + end, std::to_string (-stiffness) + " N/m");
    }

    /// A node whose position is that of a hand, and whose force acts on the hand. `rest` is JSON: the params and settings.
    std::string feels (std::size_t i, const std::string& type, const std::string& rest)
    {
        const auto name = type.substr (0, type.find ('.')) + std::to_string (nodes.size());
        nodes.push_back ('"' + name + R"(": { "type": ")" + type + R"(", )" + rest + " }");
        wire (hand (i) + "_at.position", name + ".position");
        wire (name + ".force", hand (i) + "_motor.force");
        return name;
    }

    CompileOptions options() const { return { .rate_hz = rate_hz, .assets = assets.get() }; }

    /// Tools held by force, and the graph that they feel.
    struct Held
    {
        std::vector<std::unique_ptr<HeldTool>> tools {};
        std::unique_ptr<Engine> engine {};

        explicit Held (const Loops& loops)
        {
            engine = std::make_unique<Engine> (compile (loops.graph(), catalogue(), loops.options()).plan);
            for (std::size_t i = 0; i < loops.tools.size(); ++i)
            {
                tools.push_back (std::make_unique<HeldTool>());
                engine->attach (loops.hand (i), *tools.back());
            }
            settle();
        }

        void settle()
        {
            for (int k = 0; k < 64; ++k)   // longer than any delay of a graph of these tests
                engine->tick();
        }

        Eigen::VectorXd forces() const
        {
            Eigen::VectorXd all (static_cast<Eigen::Index> (3 * tools.size()));
            for (std::size_t i = 0; i < tools.size(); ++i)
                all.segment<3> (static_cast<Eigen::Index> (3 * i)) = engine->plan().roles()[i].state->applied.force;
            return all;
        }
    };

    /// Like pushesAway(), but with any nodes: the stiffness is that of the graph with the tools at the origin.
    bool pushesAwayFromOrigin() const
    {
        constexpr double step = 1e-7;   // m
        Held held { *this };
        const auto size = static_cast<Eigen::Index> (3 * tools.size());
        Eigen::MatrixXd k = Eigen::MatrixXd::Zero (size, size);
        for (Eigen::Index n = 0; n < size; ++n)
        {
            auto& place = held.tools[static_cast<std::size_t> (n / 3)]->now.position[n % 3];
            place = step;
            held.settle();
            k.col (n) = held.forces();
            place = -step;
            held.settle();
            k.col (n) = (held.forces() - k.col (n)) / (2.0 * step);
            place = 0.0;
            held.settle();
        }
        const Eigen::VectorXcd values = k.eigenvalues();
        return std::any_of (values.begin(), values.end(), [&] (const auto& v) { return v.real() < 1e-5 * k.norm() && std::abs (v.imag()) < 1e-6 * k.norm(); });
    }

    graph::Graph graph() const
    {
        std::string text = R"({ "format": "tactus-graph", "version": 1, "name": "loops", "rate_hz": )" + std::to_string (rate_hz) + R"(, "nodes": { )";
        for (std::size_t i = 0; i < tools.size(); ++i)
        {
            text += i == 0 ? "" : ", ";
            text += '"' + hand (i) + R"(_at": { "type": "device.position", "role": ")" + hand (i) + R"(" }, ")" + hand (i)
                    + R"(_motor": { "type": "device.force", "role": ")" + hand (i) + R"(" })";
        }
        for (const auto& n : nodes)
            text += ", " + n;
        text += R"( }, "graphs": { )";
        for (std::size_t i = 0; i < graphs.size(); ++i)
            text += (i == 0 ? "" : ", ") + graphs[i];
        text += R"( }, "wires": [ )";
        for (std::size_t i = 0; i < wires.size(); ++i)
            text += (i == 0 ? "" : ", ") + wires[i];
        const auto loaded = readGraph (text + " ] }");
        INFO (text << '\n'
                   << test::text (loaded.messages));
        REQUIRE_FALSE (hasErrors (loaded.messages));
        return loaded.graph;
    }

    /// Judges the slopes of the loop along a slow sweep of a centimetre around the equilibrium.
    std::vector<check::Condition> conditions (double half_box = 5e-3, check::Thoroughness how = { .places = 6 }) const
    {
        return check::judge (demand (half_box, how), devices());
    }

    /// The same with trials, as `tactus check` does.
    std::vector<check::Condition> tried (double half_box, check::Thoroughness how) const
    {
        const auto g = graph();
        const check::Subject subject { g, catalogue(), options() };
        const auto motion = sweep (half_box);
        const auto measured = check::measure (subject, motion, how);
        const auto trials = check::tryLoops (subject, motion, measured, devices());
        return check::judge (measured, devices(), { .trials = &trials });
    }

    check::Demand demand (double half_box = 5e-3, check::Thoroughness how = { .places = 6 }) const
    {
        const auto g = graph();
        const check::Subject subject { g, catalogue(), options() };
        return check::measure (subject, sweep (half_box), how);
    }

    /// Lets the tools go a little off their equilibrium. Returns their largest distance from it in the last quarter of the run, divided by
    /// that in the first quarter.
    double growth (int ticks) const
    {
        double first = 0.0, last = 0.0;
        const bool stays = letGo (ticks, Eigen::VectorXd::Zero (3 * static_cast<Eigen::Index> (tools.size())), [&] (int k, std::size_t, const Vec3& p) {
            if (k < ticks / 4) first = std::max (first, p.norm());
            if (k >= 3 * ticks / 4) last = std::max (last, p.norm());
        });
        return stays ? last / first : 1e9;
    }

    /// How far the tools swing in the second and in the last quarter of a run, in m. They are let go 1 um away from the origin, and each
    /// hand holds its tool against the force that it feels at the origin.
    std::pair<double, double> swings (int ticks) const
    {
        using Box = std::array<Eigen::AlignedBox3d, 2>;
        std::vector<Box> boxes (tools.size());
        const bool stays = letGo (ticks, -Held (*this).forces(), [&] (int k, std::size_t tool, const Vec3& p) {
            if (k >= ticks / 4 && k < ticks / 2) boxes[tool][0].extend (p);
            if (k >= 3 * ticks / 4) boxes[tool][1].extend (p);
        });
        std::pair<double, double> most { 0.0, 0.0 };
        for (const auto& box : boxes)
            most = { std::max (most.first, box[0].diagonal().norm()), std::max (most.second, box[1].diagonal().norm()) };
        if (! stays) most.second = 1e9;
        return most;
    }

private:
    std::vector<check::RoleDevice> devices() const
    {
        std::vector<check::RoleDevice> all;
        for (std::size_t i = 0; i < tools.size(); ++i)
            all.push_back ({ hand (i), numbersOf (tools[i]), "sim" });
        return all;
    }

    check::HandMotion sweep (double half_box) const
    {
        std::vector<std::unique_ptr<check::SweepDevice>> sweeps;
        std::vector<check::Hand> hands;
        for (std::size_t i = 0; i < tools.size(); ++i)
        {
            sweeps.push_back (std::make_unique<check::SweepDevice> (Vec3 (Vec3::Constant (-half_box)), Vec3 (Vec3::Constant (half_box)),
                                                                    1.0 + 0.37 * double (i)));
            hands.push_back ({ hand (i), *sweeps.back() });
        }
        auto compiled = compile (graph(), catalogue(), options());
        INFO (test::text (compiled.messages));
        REQUIRE (compiled.plan);
        return check::recordMotion (compiled.plan, hands, static_cast<std::size_t> (rate_hz));
    }

    /// Calls see (tick, tool, position) for each tool after each tick. False if a tool runs away.
    template <typename See>
    bool letGo (int ticks, const Eigen::VectorXd& hands, See&& see) const
    {
        std::vector<std::unique_ptr<SimulatedDevice>> devices;
        Engine engine { compile (graph(), catalogue(), options()).plan };
        for (std::size_t i = 0; i < tools.size(); ++i)
        {
            auto tool = tools[i];
            const double a = 1e-6 * (1.0 + 0.3 * static_cast<double> (i));
            tool.position = { a, -0.7 * a, 0.4 * a };
            tool.hand_force = hands.segment<3> (3 * static_cast<Eigen::Index> (i));
            devices.push_back (std::make_unique<SimulatedDevice> (tool));
            engine.attach (hand (i), *devices.back());
        }
        for (int k = 0; k < ticks; ++k)
        {
            engine.tick();
            for (std::size_t i = 0; i < tools.size(); ++i)
            {
                const Vec3& p = engine.plan().roles()[i].state->reading.true_position;
                if (! (p.norm() < 1e6)) return false;
                see (k, i, p);
            }
        }
        return true;
    }
};

/// True if the condition of a contact holds, everywhere or along the motion.
inline bool isPassive (check::Verdict v) { return v == check::Verdict::passive || v == check::Verdict::passive_here; }

inline std::string brokenIds (const std::vector<check::Condition>& all)
{
    std::string ids;
    for (const auto& c : all)
        if (c.isBroken()) ids += (ids.empty() ? "" : " ") + c.role + ":" + std::string (c.id);
    return ids;
}

inline std::string describe (const std::vector<check::Condition>& all)
{
    std::string text;
    for (const auto& c : all)
        text += c.role + ":" + std::string (c.id) + " " + std::to_string (c.value) + " of " + std::to_string (c.limit) + ", " + c.text + "\n";
    return text;
}

}   // namespace tactus::test
