// SPDX-License-Identifier: MIT
#include "trial_run.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/text/json.hpp>

#include <algorithm>
#include <thread>

namespace tactus::host
{

namespace
{
constexpr const char* role = "tool";
constexpr double ramp_s = 0.2;   // from no force to full force

std::shared_ptr<Plan> planOf (const TrialGraph& graph, double rate_hz) { return compile (readGraph (graph.text (rate_hz)).graph, catalogue()).plan; }

GuardLimits limitsOf (const GuardLimits& device, double max_force)
{
    return tightest (device, { .max_force = max_force, .ramp = std::max (ramp_s, device.ramp) });
}
}   // namespace

std::string TrialGraph::text (double rate_hz) const
{
    Json nodes { { "hand", { { "type", "device.position" }, { "role", role } } }, { "motor", { { "type", "device.force" }, { "role", role } } } };
    auto wires = Json::array();
    if (stiffness > 0.0)
    {
        nodes["wall"] = { { "type", "deform.plane" }, { "params", { { "stiffness", stiffness }, { "offset", offset } } } };
        wires = { "hand.position -> wall.position", "wall.force -> motor.force" };
    }
    else
        for (const int i : { 0, 1, 2 })
        {
            const std::string axis (1, "xyz"[i]);
            nodes[axis] = { { "type", "signal.constant" }, { "params", { { "value", push[i] } } } };
            wires.push_back (axis + ".out -> motor.force." + axis);
        }
    return Json { { "format", "tactus-graph" }, { "version", 2 }, { "name", "trial" }, { "rate_hz", rate_hz }, { "nodes", nodes }, { "wires", wires } }.dump();
}

TrialRun::TrialRun (Device& device, const GuardLimits& limits, const TrialGraph& graph, const Options& o)
    : options (o), clock (o.clock ? o.clock() : std::make_unique<AbsoluteTimer> (1.0 / o.rate_hz)), engine (planOf (graph, o.rate_hz)),
      runner (engine, *clock, o.rate_hz,
              { .length = o.length > 0 ? std::optional (o.length) : std::nullopt, .stop_wanted = o.stop_wanted, .hooks = static_cast<TickHooks*> (this) })
{
    kept.reserve (static_cast<std::size_t> (kept_s * o.rate_hz));
    engine.attach (role, device, limitsOf (limits, o.max_force));
    runner.start();
}

void TrialRun::end()
{
    if (options.length == 0) runner.stop();
    runner.wait();
}

void TrialRun::before (std::uint64_t tick) noexcept
{
    if (options.frozen_after > 0 && tick == options.frozen_after) std::this_thread::sleep_for (std::chrono::duration<double> (options.frozen_s));
    tick_s = clock->now();
}

void TrialRun::after (std::uint64_t tick, bool halts) noexcept
{
    const auto& plan = engine.plan();
    const auto& reading = plan.roles()[0].state->reading;
    TrialRow row { reading.position, Vec3::Zero(), engine.role (0).applied.force, reading.age, tick_s, reading.buttons, reading.fault, reading.valid, halts };
    for (std::size_t i = 0; i < 3 && i < plan.taps().size(); ++i)   // the inputs of the motor
        row.asked[static_cast<Eigen::Index> (i)] = *plan.taps()[i].value;
    if (kept.size() < kept.capacity()) kept.push_back (row);
    has_lost = has_lost || (! halts && ! row.is_valid && latest.is_valid);
    if (row.is_valid && ! latest.is_valid) origin = row.position;
    if (options.most_travel > 0.0 && row.is_valid && (row.position - origin).norm() > options.most_travel) engine.emergencyStop();
    if (! halts && (row.is_valid || ! latest.is_valid)) latest = row;
    if (row.is_valid) seen_buttons |= row.buttons;
    done = tick + 1;
}

double TrialRun::oldest() const noexcept
{
    double longest = 0.0;
    for (const auto& row : kept)
        if (row.is_valid) longest = std::max (longest, row.age);
    return longest;
}

double TrialRun::meanAge() const noexcept
{
    double sum = 0.0;
    int n = 0;
    for (const auto& row : kept)
        if (row.is_valid) sum += row.age, ++n;
    return n > 0 ? sum / n : 0.0;
}

}   // namespace tactus::host
