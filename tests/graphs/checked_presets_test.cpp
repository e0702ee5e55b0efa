// SPDX-License-Identifier: MIT
// The verdicts of the check on the loops of presets, against a simulation at the same places that shares no code with it. TACTUS_ROUNDS=1000 tries all.
#include "framework/check/own_loop.hpp"
#include "support/rounds.hpp"
#include "support/sketch.hpp"

#include <host/base/assets/file_assets.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/check/trials/trials.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

using namespace tactus;
using namespace tactus::test;

namespace
{
namespace fs = std::filesystem;

std::vector<fs::path> presets()
{
    const auto folder = fs::path (TACTUS_SOURCE_DIR) / "graphs";
    std::vector<fs::path> few;
    for (const auto* name : { "braked_wall", "denim", "granite_wall", "notched_rail", "big_drum" })
        few.push_back (folder / (std::string (name) + ".json"));
    if (rounds (10) <= 10) return few;
    std::set<fs::path> all;
    for (const auto& entry : fs::directory_iterator (folder))
        if (entry.path().extension() == ".json") all.insert (entry.path());
    return { all.begin(), all.end() };
}

/// True if a tool that is let go at a distance from its rest does not come to rest, although one that is let go at its rest does.
bool swings (const graph::Graph& graph, const CompileOptions& options, const check::RoleDevice& device, const std::vector<Vec3>& path, double off,
             const own::Grip& grip, std::string& how)
{
    const auto mechanics = own::mechanicsOf (*device.simulated);
    const auto placed = [&] {   // a new loop for each start: a cut stays, and moving a tool is a blow
        auto loop = std::make_unique<own::Loop> (graph, catalogue(), options, mechanics, device.role);
        loop->follow (path);
        return loop;
    };
    const Vec3 f = placed()->force(), step = path.size() > 1 ? Vec3 (path.back() - path[path.size() - 2]) : Vec3 (Vec3::Zero());
    Vec3 push = -f;
    if (step.norm() * 4000.0 > 1e-3) push += 0.5 * f.dot (step.normalized()) * step.normalized();
    const Vec3 out = f.norm() > 1e-6 ? Vec3 (f.normalized()) : Vec3 (Vec3::UnitZ()), aside = out.unitOrthogonal();
    const double threshold = std::max (1e-6, 2.0 * mechanics.quantum);
    const auto moved = [&] (const Vec3& from) {
        const auto third = placed()->letGo (from, grip, push);
        if (third.is_far) return third.most_work > third.most_push ? 1.0 : 0.0;
        const bool slides = third.push_work > 2.0 * push.norm() * third.swing && third.work <= third.push_work;
        how += std::to_string (1e6 * third.swing) + " um ";
        return slides ? 0.0 : third.swing;
    };
    double most = 0.0;
    const Vec3 other = out.cross (aside);
    for (const Vec3& way : { out, Vec3 (-aside), Vec3 (-0.8 * out + 0.48 * aside + 0.36 * other), aside, other, Vec3 (-other) })
        if (most <= threshold) most = std::max (most, moved (off * way));
    if (most <= threshold) return false;
    return most > 3.0 * moved (Vec3::Zero());   // else the graph plays, or the tool cannot rest at the place
}
}   // namespace

TEST_CASE ("what the check says of the loop of a preset is what a simulation shows at its place", "[check][graphs]")
{
    for (const auto& file : presets())
    {
        const auto loaded = loadGraph (file);
        host::FileAssets assets;
        const check::Subject subject { loaded.graph, catalogue(), { .assets = &assets } };
        const auto recorded = check::recordMotion (subject, {}, file.parent_path());
        INFO (file.filename() << '\n'
                              << test::text (recorded.messages));
        if (recorded.motion.roles.size() != 1 || loaded.graph.devices.empty()) continue;   // one tool, which is simulated
        const auto& role = recorded.motion.roles.front();
        check::RoleDevice device { .role = role.role, .name = "sim" };
        const auto& description = *loaded.graph.device (role.role);
        const auto numbers = check::numbersOf (description, file.parent_path());
        if (! numbers) continue;
        device.numbers = *numbers;
        device.simulated = check::simulationOf (description, file.parent_path());
        const auto compiled = compile (loaded.graph, catalogue(), subject.options);
        const auto demand = check::measure (subject, recorded.motion, { .ticks = check::affordableTicks (*compiled.plan) });
        const auto trials = check::tryLoops (subject, recorded.motion, demand, { &device, 1 }, { .ticks = check::affordableTicks (*compiled.plan) / 2 });
        const auto conditions = check::judge (demand, { &device, 1 }, { .trials = &trials });
        const auto row = std::ranges::find (conditions, "stiffness", &check::Condition::id);
        if (row == conditions.end()) continue;
        const auto& trial = trials.by_role.front();
        const auto& slopes = demand.roles.front().slopes;
        const auto deepest = std::ranges::max_element (slopes, {}, [] (const check::Slope& s) { return s.force.norm(); });
        const double t_s = trial.swings ? trial.t_s : deepest->t_s;
        std::vector<Vec3> path;
        for (std::size_t k = 0; k <= std::min (static_cast<std::size_t> (t_s * recorded.motion.rate_hz), role.readings.size() - 1); ++k)
            path.push_back (role.readings[k].true_position);
        std::string how;
        const bool does = swings (loaded.graph, subject.options, device, path, trial.swings && trial.off > 0.0 ? trial.off : 2e-3,
                                  trial.swings ? own::Grip { trial.hand.mass, trial.hand.damping, trial.hand.stiffness } : own::Grip {}, how);
        INFO (nameOf (row->verdict) << ": " << row->text << "\nat " << t_s << " s: " << how);
        CHECK ((row->verdict == check::Verdict::unstable) == does);
        CHECK (row->verdict != check::Verdict::unstable);
    }
}
