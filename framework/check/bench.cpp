// SPDX-License-Identifier: MIT
#include "bench.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::check
{

Bench::Bench (const Subject& subject, const HandMotion& motion) : stop (subject.stop)
{
    auto options = subject.options;
    options.rate_hz = motion.rate_hz;
    its_plan = compile (subject.graph, subject.catalogue, options).plan;
    engine = std::make_unique<Engine> (its_plan);
    for (const auto& role : motion.roles)
    {
        if (role.axis)
        {
            axes.push_back (*role.axis);
            continue;
        }
        tools.push_back (std::make_unique<Placed>());
        tools.back()->parts = role.layout;
        engine->attach (role.role, *tools.back());
    }
}

void Bench::follow (const HandMotion& motion, double tick) noexcept
{
    for (std::size_t r = 0; r < tools.size(); ++r)
    {
        auto& tool = *tools[r];
        const auto& readings = motion.roles[r].readings;
        const auto before = std::min (static_cast<std::size_t> (tick), readings.size() - 1), after = std::min (before + 1, readings.size() - 1);
        const double part = tick - static_cast<double> (before);
        tool.now = readings[before];
        if (part > 0.0)
        {
            tool.now.position += part * (readings[after].position - readings[before].position);
            tool.now.true_position += part * (readings[after].true_position - readings[before].true_position);
            for (int i = 0; i < tool.now.axes.size(); ++i)
                tool.now.axes.set (i, tool.now.axes[i] + part * (readings[after].axes[i] - readings[before].axes[i]));
        }
        tool.home_axes = tool.now.axes;
        tool.home = tool.now.position;
        tool.true_home = tool.now.true_position;
    }
}

void Bench::shift (std::size_t role, const Vec3& by) noexcept
{
    if (role >= tools.size())
    {
        const auto& axis = axes[role - tools.size()];
        auto& owner = *tools[axis.owner];
        owner.now.axes.set (axis.read, owner.home_axes[axis.read] + by.x());
        return;
    }
    auto& tool = *tools[role];
    tool.now.position = tool.home + by;
    tool.now.true_position = tool.true_home + by;
}

void Bench::silence (const std::vector<std::size_t>& nodes)
{
    silent.assign (nodes.empty() ? 0 : plan().flat().nodes.size(), false);
    for (const auto n : nodes)
        silent[n] = true;
}

void Bench::tick()
{
    if (stop.stop_requested()) throw Stopped {};
    if (silent.empty()) return engine->tick();
    engine->tick ([this] (Plan& plan) noexcept { tickWithout (plan, silent); });
}

void tickWithout (Plan& plan, const std::vector<bool>& silent) noexcept
{
    plan.tick ([&] (std::size_t record, auto step) noexcept {
        step();
        const auto node = plan.owners()[record];
        if (! silent[static_cast<std::size_t> (node)]) return;
        const auto& instance = plan.instances()[node];
        if (plan.records()[record].outputs == instance.outputs) plan.flat().nodes[node].type->initialiseOutputs (instance.outputs);
    });
}

NodeForces::NodeForces (const Plan& plan, std::size_t node)
{
    const auto& type = *plan.flat().nodes[node].type;
    const auto& instance = plan.instances()[node];
    if (instance.outputs == nullptr || type.effort != nullptr) return;   // the output of a sink is the force after the guard, not its own force
    for (const auto& row : type.outputs)
        if (row.unit.kind == UnitRule::Kind::fixed && row.unit.unit.symbol == "N" && ! row.list)
        {
            output_widths.push_back (static_cast<std::size_t> (row.width));
            for (int i = 0; i < row.width; ++i)
                values.push_back (instance.output (row.offset + sizeof (double) * static_cast<std::size_t> (i)));
        }
}

double NodeForces::largest() const noexcept
{
    double most = 0.0;
    std::size_t i = 0;
    for (const auto width : output_widths)
    {
        double square = 0.0;
        for (const auto end = i + width; i < end; ++i)
            square += *values[i] * *values[i];
        most = std::max (most, square);
    }
    return std::sqrt (most);
}

}   // namespace tactus::check
