// SPDX-License-Identifier: MIT
// A program that uses a node of its own in a graph built in code.
#include <tactus/graph/edit.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/graph/text.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/run.hpp>

#include <cstdio>

int main()
{
    using namespace tactus;
    graph::History edited { graph::Graph {} };
    const auto add = [&] (const char* name, const char* type, const char* role = "") {
        graph::Node node;
        node.name = name;
        node.type = type;
        node.role = role;
        return bool (edited.perform (graph::AddNode { "", node }));
    };
    const auto wire = [&] (const char* text) { return bool (edited.perform (graph::AddWire { "", *graph::parseWire (text) })); };
    if (! add ("hand", "device.position", "pen") || ! add ("rings", "my.ripple") || ! add ("motor", "device.force", "pen")) return 1;
    if (! wire ("hand.position -> rings.position") || ! wire ("rings.force -> motor.force")) return 1;

    const auto& graph = edited.graph();
    Run run { catalogue(), { .rate_hz = 4000.0 }, [] (auto&&...) {
                 auto made = makeDevice ({ { "driver", "gesture" }, { "path", "stroke" } }, "");
                 return Run::RoleDevice { std::move (made.device), made.limits };
             } };
    Messages messages = run.load (graph);
    if (! hasErrors (messages)) run.openDevices (graph, messages);
    for (const auto& m : messages)
        std::fprintf (stderr, "%s\n", describe (m).c_str());
    if (hasErrors (messages)) return 1;
    for (int k = 0; k < 4000; ++k)
    {
        run.tick();
        if (k % 400 == 0) std::printf ("%5.3f s  %8.4f N\n", k / run.rate(), run.engine().role (0).applied.force.norm());
    }
}
