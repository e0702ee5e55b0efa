// SPDX-License-Identifier: MIT
#include "self_test_run.hpp"

#include <tactus/run/device/make_device.hpp>
#include <tactus/run/turn.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>

namespace tactus::host
{

namespace
{
constexpr double not_kept = std::numeric_limits<double>::quiet_NaN();   // equals no value, so the column is never left out

constexpr std::size_t self_test_ticks = 1200, ticks_before_contact = 150;

/// A number to keep on every tick.
struct Kept
{
    std::string target;
    std::function<double()> value;
    double idle = 0.0;   ///< a column of only this value is left out
};

/// A component of a vector in this reading or effort, as code and as its address.
void addVector (std::vector<Kept>& all, const std::string& name, const Vec3& v, const std::string& end = {})
{
    for (int c = 0; c < 3; ++c)
        all.push_back ({ name + "." + "xyz"[c] + "()" + end, [&v, c] { return v[c]; } });
}

void addReading (std::vector<Kept>& all, const std::string& name, const Reading& r)
{
    addVector (all, name + ".position", r.position, " = @");
    addVector (all, name + ".rotation", r.rotation, " = @");
    addVector (all, name + ".true_position", r.true_position, " = @");
    addVector (all, name + ".true_velocity", r.true_velocity, " = @");
    addVector (all, name + ".unrendered_force", r.unrendered_force, " = @");
    addVector (all, name + ".unrendered_torque", r.unrendered_torque, " = @");
    all.push_back ({ name + ".pressure = @", [&r] { return r.pressure; } });
    all.push_back ({ name + ".age = @", [&r] { return r.age; } });
    all.push_back ({ name + ".valid = @ != 0.0", [&r] { return r.valid ? 1.0 : 0.0; }, 1.0 });
    all.push_back ({ name + ".buttons = static_cast<std::uint32_t> (@)", [&r] { return static_cast<double> (r.buttons); } });
}

void addChannels (std::vector<Kept>& all, const std::string& name, const Channels& channels, int count, bool is_input)
{
    for (int i = 0; i < count; ++i)
        all.push_back ({ is_input ? name + ".set (" + std::to_string (i) + ", @)" : name + "[" + std::to_string (i) + "]",
                         [&channels, i] { return channels[i]; },
                         is_input ? not_kept : 0.0 });
}

class Recording
{
public:
    Recording (Run& r, const Exported& e_) : run (r), e (e_), plan (r.engine().plan())
    {
        for (std::size_t i = 0; i < plan.roles().size(); ++i)
            addRole (i);
        for (std::size_t f = 0; f < e.wiring.feed_names.size(); ++f)
            inputs.push_back ({ "in." + e.wiring.feed_names[f] + " = @", [this, f] { return plan.feeds()[f]; } });
        for (std::size_t t = 0; t < plan.taps().size(); ++t)
            addTap (t);
        test.inputs.resize (inputs.size());
        test.outputs.resize (outputs.size());
    }

    SelfTest record()
    {
        for (test.ticks = 0; test.ticks < self_test_ticks; ++test.ticks)
        {
            act (test.ticks);
            for (std::size_t f = 0; f < plan.feeds().size(); ++f)
                plan.feeds()[f] = std::sin (0.01 * static_cast<double> (test.ticks * (f + 1)));
            run.tick();
            keep (inputs, test.inputs);
            keep (outputs, test.outputs);
        }
        dropIdle (inputs, test.inputs);
        for (std::size_t i = 0; i < outputs.size(); ++i)
            test.outputs[i].target = outputs[i].target;
        return std::move (test);
    }

private:
    Run& run;
    const Exported& e;
    Plan& plan;
    std::vector<Kept> inputs, outputs;
    SelfTest test;

    void addRole (std::size_t i)
    {
        const auto& state = *plan.roles()[i].state;
        const auto in = "in." + e.wiring.role_ports[i], out = "out." + e.wiring.role_ports[i];
        addReading (inputs, in, state.reading);
        addChannels (inputs, in + ".axes", state.reading.axes, static_cast<int> (state.layout.axes.size()), true);
        addChannels (inputs, in + ".signals", state.reading.signals, state.layout.signal_inputs, true);
        addVector (outputs, out + ".force", state.applied.force);
        addVector (outputs, out + ".torque", state.applied.torque);
        if (state.layout.brake > 0.0) outputs.push_back ({ out + ".brake", [&applied = state.applied] { return applied.brake; } });
        addChannels (outputs, out + ".axes", state.applied.axes, static_cast<int> (state.layout.efforts.size()), false);
        addChannels (outputs, out + ".signals", state.applied.signals, state.layout.signal_outputs, false);
    }

    void addTap (std::size_t t)
    {
        const auto& tap = plan.taps()[t];
        const auto name = "out." + e.wiring.tap_names[t];
        if (tap.samples == nullptr)
            outputs.push_back ({ name, [&tap] { return *tap.value; } });
        else
            for (int i = 0; i < tap.per_tick; ++i)
                outputs.push_back ({ name + "[" + std::to_string (i) + "]", [&tap, i] { return tap.samples[i]; } });
    }

    static void keep (const std::vector<Kept>& all, std::vector<SelfTestColumn>& columns)
    {
        for (std::size_t i = 0; i < all.size(); ++i)
            columns[i].values.push_back (all[i].value());
    }

    /// Names the columns, and drops inputs that are never used.
    static void dropIdle (const std::vector<Kept>& all, std::vector<SelfTestColumn>& columns)
    {
        std::size_t n = 0;
        for (std::size_t i = 0; i < all.size(); ++i)
        {
            const bool is_used = std::ranges::any_of (columns[i].values, [&] (double v) { return ! (v == all[i].idle) || std::signbit (v); });
            if (! is_used) continue;
            auto column = std::move (columns[i]);
            column.target = all[i].target;
            columns[n++] = std::move (column);
        }
        columns.resize (n);
    }

    void act (std::size_t k)
    {
        if (k == ticks_before_contact + 100) turnParams (k);
        if (k == ticks_before_contact + 300) turnControls (k, 0.9);
        if (k == ticks_before_contact + 450) hitInputs (k);
        if (k == ticks_before_contact + 500) turnControls (k, 0.2);
    }

    void turnParams (std::size_t k)
    {
        constexpr std::size_t most = 12;
        const auto turn = [&] (std::size_t number, double value) {
            const auto& p = e.parameters[number];
            run.engine().set ({ plan.instances()[e.wiring.nodes[p.node].instance].knobs, p.knob, p.sheet }, value);
            test.events.push_back ({ k, SelfTestEvent::Kind::param, number, value });
        };
        for (std::size_t i = 0; i < std::min (most, e.parameters.size()); ++i)
        {
            const auto number = i * e.parameters.size() / std::min (most, e.parameters.size());
            const auto& p = e.parameters[number];
            const auto& hard = p.sheet->limits.hard;
            double value = p.value == 0.0 ? 0.01 : 1.125 * p.value;
            if (! p.sheet->choices.empty())
                value = static_cast<double> ((static_cast<std::size_t> (p.value) + 1) % p.sheet->choices.size());
            else
                value = hard.clamp (value);
            turn (number, value);
        }
        for (std::size_t number = 0; number < e.parameters.size(); ++number)   // limits that are set or taken away
            if (const auto& p = e.parameters[number]; p.sheet->limits.off_at_zero) turn (number, p.value == 0.0 ? 0.01 : 0.0);
    }

    void turnControls (std::size_t k, double position)
    {
        for (std::size_t i = 0; i < e.controls.size(); ++i)
            if (turnControl (run.engine(), e.graph, e.controls[i].id, position)) test.events.push_back ({ k, SelfTestEvent::Kind::control, i, position });
    }

    void hitInputs (std::size_t k)
    {
        for (std::size_t i = 0; i < e.wiring.hits.size(); ++i)
        {
            const auto& [instance, pulse] = e.wiring.hits[i];
            constexpr double speed = 0.25;
            run.engine().strike ({ plan.instances()[instance].knobs, pulse }, speed);
            test.events.push_back ({ k, SelfTestEvent::Kind::hit, i, speed });
        }
    }
};
}   // namespace

Run::OpenDevice simulatedDevices()
{
    return [] (const std::string& role, const graph::Graph& graph, const Plan&, Messages& messages) -> Run::RoleDevice {
        const auto* described = graph.device (role);
        auto description = described != nullptr ? *described : Json {};
        const auto driver = description.is_object() && description.contains ("driver") ? description.at ("driver") : Json {};
        if (driver != Json ("sim") && driver != Json ("trace") && driver != Json ("gesture"))
            if (auto option = parseDeviceOption (role + "=sim", graph.devices, graph.folder)) description = option->description;
        auto made = makeDevice (description, graph.folder);
        for (auto& m : made.messages)
        {
            m.where = "/devices/" + role + m.where;
            messages.push_back (std::move (m));
        }
        return { std::move (made.device), made.limits };
    };
}

namespace
{
class RepeatingDevice final : public Device
{
public:
    RepeatingDevice (std::shared_ptr<const std::vector<Reading>> all, DeviceLayout l) : readings (std::move (all)), own_layout (std::move (l)) {}

    void prepare (double) override {}
    Reading read() noexcept override { return now < readings->size() ? (*readings)[now++] : Reading {}; }
    void write (const Effort&) noexcept override {}
    DeviceLayout layout() const override { return own_layout; }

private:
    std::shared_ptr<const std::vector<Reading>> readings;
    DeviceLayout own_layout;
    std::size_t now = 0;
};

double sizeOf (const Effort& e)
{
    double size = std::max ({ e.force.norm(), e.torque.norm(), e.brake });
    for (const auto* channels : { &e.axes, &e.signals })
        for (const double v : *channels)
            size = std::max (size, std::abs (v));
    return size;
}
}   // namespace

Run::OpenDevice repeatedDevices (Run& run)
{
    constexpr std::size_t longest = 40000;
    constexpr double smallest_effort = 1e-3;
    const auto& roles = run.engine().plan().roles();
    std::vector<std::vector<Reading>> readings (roles.size());
    std::optional<std::size_t> contact;
    for (std::size_t k = 0; ! roles.empty() && k < longest && (! contact || k < *contact + self_test_ticks); ++k)
    {
        run.tick();
        for (std::size_t i = 0; i < roles.size(); ++i)
        {
            readings[i].push_back (roles[i].state->reading);
            if (! contact && sizeOf (roles[i].state->applied) > smallest_effort) contact = k;
        }
    }
    const auto first = static_cast<std::ptrdiff_t> (contact && *contact > ticks_before_contact ? *contact - ticks_before_contact : 0);
    std::map<std::string, std::shared_ptr<const std::vector<Reading>>> by_role;
    for (std::size_t i = 0; i < roles.size(); ++i)
        by_role[roles[i].name] = std::make_shared<const std::vector<Reading>> (readings[i].begin() + first, readings[i].end());
    std::map<std::string, std::pair<DeviceLayout, GuardLimits>> opened;
    for (const auto& [role, device] : run.devices())
        opened[role] = { device.device->layout(), device.limits };
    return [by_role, opened] (const std::string& role, const graph::Graph&, const Plan&, Messages&) -> Run::RoleDevice {
        const auto of = opened.find (role);
        if (of == opened.end()) return {};
        return { std::make_unique<RepeatingDevice> (by_role.at (role), of->second.first), of->second.second };
    };
}

SelfTest selfTestOf (Run& run, const Exported& e) { return Recording { run, e }.record(); }

}   // namespace tactus::host
