// SPDX-License-Identifier: MIT
// The reader of an exported board against the profile of the board, over random input (docs/decisions/second_readers.md).

#include <host/devices/hid/hid.hpp>

#include <support/property.hpp>

#include <host/code/generate/targets/tactus_board.hpp>
#include <host/devices/hid/device_side.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
double within (double least, double most) { return least + (most - least) * *rc::gen::inRange (0, 100'001) / 100'000.0; }
Vec3 anyVector (double size) { return { within (-size, size), within (-size, size), within (-size, size) }; }
bool oneIn (int count) { return *rc::gen::inRange (0, count) == 0; }

tactus::board::Report received (std::span<const std::uint8_t> wire)
{
    tactus::board::Report report {};
    REQUIRE (wire.size() == report.size() + 1);   // begins with 0, because it has no id
    std::ranges::copy (wire.subspan (1), report.begin());
    return report;
}
}   // namespace

TEST_CASE ("an exported board says what the profile of the board reads", "[hid][export][property]")
{
    test::property ("any reading and state", [] {
        HidModel host (test::profileOf ("tactus_board"));
        Reading reading;
        reading.position = anyVector (2.1);
        reading.rotation = anyVector (3.1);
        reading.pressure = within (0.0, 20.0);
        reading.buttons = static_cast<std::uint32_t> (*rc::gen::inRange (0, 256));
        for (int i = 0; i < 4; ++i)
            reading.axes.set (i, within (-100.0, 100.0));
        const tactus::board::State state { .is_homed = ! oneIn (3),
                                           .is_driven = ! oneIn (3),
                                           .is_released = oneIn (3),
                                           .is_hot = oneIn (3),
                                           .number = *rc::gen::arbitrary<std::uint32_t>(),
                                           .us = *rc::gen::arbitrary<std::uint32_t>() };
        const auto& said = host.decode (tactus::board::reportOf (reading, state));
        RC_ASSERT (said.refusal == Refusal::none);
        RC_ASSERT ((said.position - reading.position).cwiseAbs().maxCoeff() <= 0.51e-9);
        RC_ASSERT ((said.rotation - reading.rotation).cwiseAbs().maxCoeff() <= 0.51e-6);
        RC_ASSERT (std::abs (said.pressure - reading.pressure) <= 0.51e-6);
        RC_ASSERT (said.buttons == reading.buttons);
        const auto axis = [&] (const char* name) {
            return said.axes[static_cast<std::size_t> (std::ranges::find (host.axisNames(), name) - host.axisNames().begin())];
        };
        RC_ASSERT (axis ("sequence") == state.number);
        RC_ASSERT (std::abs (axis ("time") - 1e-6 * state.us) < 1e-9);
        for (int i = 0; i < 4; ++i)
            RC_ASSERT (std::abs (axis (("axis" + std::to_string (i + 1)).c_str()) - reading.axes[i]) <= 0.51e-6);
        const auto fault = host.reading (1.0).fault;   // the motors have been driven for long, so all alarms count
        RC_ASSERT (fault
                   == (! state.is_homed    ? ReadingFault::not_homed
                       : state.is_hot      ? ReadingFault::too_hot
                       : state.is_released ? ReadingFault::timed_out
                       : ! state.is_driven ? ReadingFault::not_driven
                                           : ReadingFault::none));
    });
}

TEST_CASE ("an exported board hears what the host asks for, and nothing in a damaged report, as the device's side of the profile", "[hid][export][property]")
{
    test::property ("any effort, and any damage", [] {
        const auto profile = test::profileOf ("tactus_board");
        HidModel host (profile);
        const DeviceSide device (profile);
        HidEffort effort { anyVector (2.0), anyVector (0.05), host.restEfforts() };
        auto report = received (oneIn (4) ? host.neutral (0) : host.encode (0, effort));
        for (int k = *rc::gen::inRange (0, 3); k > 0; --k)
            report[static_cast<std::size_t> (*rc::gen::inRange (0, 64))] ^= static_cast<std::uint8_t> (1 << *rc::gen::inRange (0, 8));
        const auto first = device.output (report);
        const auto second = tactus::board::askedBy (report);
        RC_ASSERT (second.is_valid == first.has_value());
        if (! first) return;
        RC_ASSERT (second.drives == first->enabled);
        if (! second.drives) return;
        RC_ASSERT ((second.effort.force - first->effort.force).cwiseAbs().maxCoeff() < 1e-9);
        RC_ASSERT ((second.effort.torque - first->effort.torque).cwiseAbs().maxCoeff() < 1e-9);
    });
}
