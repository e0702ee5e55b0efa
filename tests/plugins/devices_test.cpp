// SPDX-License-Identifier: MIT
// Device nodes in a plugin: they see the reading of each tick, and a device that joins while they tick.
#include "load.hpp"
#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <tactus/plugin/device_form.hpp>
#include <tactus/plugin/device_link.hpp>
#include <tactus/plugin/plugin_node.hpp>
#include <tactus/plugin/shared_object.hpp>

#include <cstddef>
#include <cstring>
#include <span>

using namespace tactus;

namespace
{
/// A pad with two axes and a brake. Its readings change on each tick.
struct Pad final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override
    {
        ++ticks;
        Reading now { .position = Vec3 (0.001 * ticks, 0.0, 0.0) };
        now.axes = { 0.25 * ticks, -1.0 * ticks };
        return now;
    }
    void write (const Effort& e) noexcept override
    {
        applied = e.force;
        brake = e.brake;
    }
    DeviceLayout layout() const override { return { .axes = { "wheel", "trigger" }, .brake = 100.0 }; }

    int ticks = 0;
    Vec3 applied = Vec3::Zero();
    double brake = 0.0;
};

/// The plugin of device nodes in a host that lends its DeviceState in another form, or not at all, so that the nodes copy the readings.
class OtherHost
{
public:
    explicit OtherHost (const char* form) : devices { sizeof devices, form }
    {
        lent = form == nullptr ? nullptr : &devices;
        entry = static_cast<const tactus_plugin*> (object->find ("tactus_plugin_entry"));
        begun = entry->init (&host, nullptr);
    }
    ~OtherHost() { entry->deinit(); }
    OtherHost (const OtherHost&) = delete;
    OtherHost& operator= (const OtherHost&) = delete;

    std::vector<NodeType> types() const
    {
        std::vector<NodeType> all;
        for (std::size_t i = 0; i < entry->get_node_count(); ++i)
            all.push_back (plugin::readNode (entry->get_node (i), "devices", object, 0, {}).value());
        return all;
    }

    std::int32_t begun = TACTUS_PLUGIN_FAILED;

private:
    static const void* extension (const char* id) noexcept { return std::strcmp (id, TACTUS_PLUGIN_DEVICE_STATE) == 0 ? lent : nullptr; }

    static inline const tactus_plugin_device_state* lent = nullptr;
    tactus_plugin_device_state devices;
    tactus_plugin_host host { sizeof host, TACTUS_PLUGIN_ABI, "another", "", &extension };
    std::shared_ptr<SharedObject> object = SharedObject::load (test::pluginFile ("devices")).value();
    const tactus_plugin* entry = nullptr;
};

Catalogue types() { return catalogue().with (test::load ("devices").types); }

test::Sketch sketch()
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("trigger", "device.axis", Json::object(), { { "axis", "trigger" } }).node ("motor", "device.force");
    s.node ("wheel", "device.axis", Json::object(), { { "axis", "wheel" } }).node ("brake", "device.brake");
    for (auto& node : s.graph.root.nodes)
        node.role = "pad";
    s.wire ("trigger.axis -> motor.force.y").wire ("wheel.axis -> brake.damping");
    return s;
}

CompileOptions options (const Plan* before = nullptr) { return { .rate_hz = 1000.0, .records = { "hand.position", "brake.applied" }, .before = before }; }
}   // namespace

namespace
{
/// What the nodes see and do in ten ticks.
std::vector<double> readings (const Catalogue& all)
{
    std::vector<double> seen;
    const auto compiled = compile (sketch().graph, all, options());
    INFO (test::text (compiled.messages));
    REQUIRE (compiled.plan);
    Engine engine { compiled.plan };
    Pad pad;
    engine.attach ("pad", pad);
    for (int k = 0; k < 10; ++k)
    {
        engine.tick();
        for (const auto& tap : engine.plan().taps())
            seen.push_back (*tap.value);
        seen.insert (seen.end(), { pad.applied.y(), pad.brake });
    }
    CHECK (pad.applied == Vec3 (0.0, -10.0, 0.0));
    CHECK (pad.brake == 0.25 * 10);
    CHECK (seen.size() == 60);
    CHECK (seen[54] == 0.001 * 10);
    CHECK (seen[57] == 0.25 * 9);   // applied on the tick before
    return seen;
}

/// A device that joins while the nodes tick.
void join (const Catalogue& all)
{
    Engine engine { compile (sketch().graph, all, options()).plan };
    for (int k = 0; k < 3; ++k)
        engine.tick();   // no device yet

    Pad pad;
    const Engine::Joining joining { "pad", pad };
    engine.submit (compile (sketch().graph, all, options (&engine.newest())).plan, std::span (&joining, 1));
    {
        const NoAllocation watch;
        engine.tick();
        CHECK (watch.allocations() == 0);
        CHECK (watch.locks() == 0);
    }
    for (int k = 0; k < 105; ++k)   // 5 ms in which new nodes settle, and the fade
        engine.tick();
    CHECK (pad.applied == Vec3 (0.0, -106.0, 0.0));
}
}   // namespace

TEST_CASE ("a device node in a plugin reads the device of its role on each tick", "[plugins]") { CHECK (readings (types()) == readings (catalogue())); }

TEST_CASE ("a device node in a plugin is bound to a device that joins, without allocating in the tick", "[plugins]") { join (types()); }

TEST_CASE ("a device node in a plugin copies the readings of a host whose DeviceState has another form", "[plugins]")
{
    for (const char* form : { static_cast<const char*> (nullptr), "", "libstdc++ 7 8 9" })
    {
        INFO (std::string (form == nullptr ? "not lent" : form));
        const OtherHost host { form };
        REQUIRE (host.begun == TACTUS_PLUGIN_OK);
        const auto all = catalogue().with (host.types());
        CHECK (readings (all) == readings (catalogue()));
        join (all);
    }
}

TEST_CASE ("a device node in a plugin goes from the state of one role to that of another, in place or copied", "[plugins]")
{
    const DeviceState first { .reading = { .position = Vec3 (4.0, 5.0, 6.0) }, .applied = {} };
    for (const auto& form : { plugin::formOfDeviceState(), std::string ("another") })
    {
        INFO (form);
        const OtherHost host { form.c_str() };
        const Catalogue all { host.types() };
        const auto& type = *all.find ("device.position");
        DeviceState second { .reading = {}, .applied = {} };
        const auto node = type.make();
        bindFirst (type, node.get(), first);
        bindFirst (type, node.get(), second);
        second.reading.position = Vec3 (1.0, 2.0, 3.0);   // after the node was bound
        double out[8] {};
        type.initialiseOutputs (out);
        type.tick (node.get(), nullptr, out);
        CHECK (Vec3 (out) == second.reading.position);
    }
}

TEST_CASE ("a plugin that reads one host's devices in place refuses another host in the same program", "[plugins]")
{
    const auto types_of_this_host = types();
    const OtherHost other { "another" };
    CHECK (other.begun == TACTUS_PLUGIN_FAILED);
    CHECK (readings (types_of_this_host) == readings (catalogue()));

    const OtherHost same { plugin::formOfDeviceState().c_str() };
    CHECK (same.begun == TACTUS_PLUGIN_OK);
}

TEST_CASE ("a plugin reads and writes only what a host of the first version knows", "[plugins]")
{
    const std::vector<const char*> none;
    const tactus_plugin_mechanics mechanics { sizeof mechanics, 1.0, 2.0 };
    tactus_plugin_layout layout = TACTUS_PLUGIN_LAYOUT_INIT;
    layout.axes = layout.efforts = layout.buttons = none.data();
    layout.mechanics = &mechanics;
    layout.brake = 5.0;
    CHECK (plugin::readLayout (layout).brake == 5.0);
    layout.size = offsetof (tactus_plugin_layout, brake);
    CHECK (plugin::readLayout (layout).brake == 0.0);

    tactus_plugin_effort effort = TACTUS_PLUGIN_EFFORT_INIT;
    effort.brake = 7.0;
    effort.size = offsetof (tactus_plugin_effort, brake);
    plugin::show ({ .force = Vec3 (1.0, 2.0, 3.0), .brake = 5.0 }, effort);
    CHECK (effort.force[2] == 3.0);
    CHECK (effort.brake == 7.0);
}

TEST_CASE ("a device node in a plugin says what the device lacks", "[plugins]")
{
    const auto all = types();
    const DeviceLayout layout { .axes = { "wheel" } };
    std::string said[2];
    for (const auto* type : { all.find ("device.axis"), catalogue().find ("device.axis") })
    {
        const auto node = type->make();
        type->settings[0].set (node.get(), std::string ("trigger"));
        said[type->origin.empty() ? 1 : 0] = type->missing (node.get(), layout);
    }
    CHECK (said[0] == said[1]);
    CHECK (said[0].find ("no axis 'trigger'") != std::string::npos);
}
