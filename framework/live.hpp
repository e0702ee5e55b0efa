// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"
#include "graph/history.hpp"
#include "plan/compile.hpp"

#include <span>

namespace tactus
{

/// A graph that is edited while it runs. Each edit is compiled and handed to the engine, whose tick thread takes it over
/// between two ticks. What does not compile leaves the plan before running; the graph keeps the edit, so that the next
/// one can mend it. The rate stays what it was (live/rate). All but engine().tick() is for the main thread.
class Live
{
public:
    /// The plan is what compile gives for the graph with these options; it must not be null.
    Live (graph::Graph, const Catalogue&, CompileOptions, std::shared_ptr<Plan>);

    Engine& engine() noexcept { return running; }
    const graph::Graph& graph() const noexcept { return edits.graph(); }
    const graph::History& history() const noexcept { return edits; }

    /// Each returns what there is to say about the graph as it is now, or why the edit was refused.
    Messages perform (graph::Command, graph::Step = graph::Step::own);
    Messages undo();
    Messages redo();

    /// Gives devices to roles that the graph has got since it began to run; they are there from a tick to come, as
    /// Engine::submit has it. Returns what there is to say about the graph; with errors, nobody has joined.
    Messages join (std::span<const Engine::Joining>);

    /// Turns parameters without an edit, by a value as a file would have it: 0.4, "0.4 mm", "stick", [0, 0, 1].
    std::optional<Message> set (const std::string& name, const Json& value);

private:
    Messages compileAndSubmit (std::span<const Engine::Joining> = {});

    graph::History edits;
    const Catalogue& catalogue;
    CompileOptions options;
    Engine running;
    double first_rate_hz;   // what the file asked for when it was opened
};

}   // namespace tactus
