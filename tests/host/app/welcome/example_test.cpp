// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/welcome/example.hpp>

#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("every node has a small example that compiles")
{
    FileAssets assets;
    for (const auto& type : catalogue())
    {
        const auto graph = exampleOf (type, catalogue());
        const auto compiled = compile (graph, catalogue(), { .assets = &assets });
        INFO (type.info.id << "\n"
                           << writeGraph (graph));
        for (const auto& m : compiled.messages)
            UNSCOPED_INFO (m.where << ": " << m.text << " [" << m.id << "]");
        // Some nodes need a setting that only the user can choose; the inspector asks for it.
        const bool needs_setting = std::ranges::any_of (compiled.messages, [] (const Message& m) {
            const bool is_in_node = m.where.starts_with ("/nodes/node");
            return is_in_node && m.where.find ("wires") == std::string::npos;
        });
        CHECK ((compiled.plan != nullptr || needs_setting));
        CHECK (readGraph (writeGraph (graph)).messages.empty());
    }
}

TEST_CASE ("the example of a node with a force output wires it to the motor")
{
    for (const auto* id : { "friction.elasto_plastic", "texture.grating", "vibration.modal", "deform.plane", "filter.one_pole", "vector.add" })
    {
        const auto graph = exampleOf (*catalogue().find (id), catalogue());
        INFO (writeGraph (graph));
        CHECK (std::ranges::any_of (graph.root.wires, [] (const graph::Wire& w) { return w.from.node == "node"; }));
        CHECK (std::ranges::any_of (graph.root.wires, [] (const graph::Wire& w) { return w.to.node == "node"; }));
    }
}
