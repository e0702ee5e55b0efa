// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/history.hpp>
#include <tactus/run/run.hpp>
#include <tactus/run/turn.hpp>

#include <span>
#include <string>

namespace tactus::test
{

/// A run of a graph with its undo history: each edit is compiled and submitted, as in the host.
class Live
{
public:
    Live (graph::Graph g, const Catalogue& catalogue, CompileOptions options, std::shared_ptr<Plan> first)
        : edits (std::move (g), nullptr), run (catalogue, std::move (options))
    {
        run.begin (std::move (first));
    }

    Engine& engine() noexcept { return run.engine(); }
    const graph::Graph& graph() const noexcept { return edits.graph(); }
    const graph::History& history() const noexcept { return edits; }

    Messages perform (graph::Command command, graph::Step step = graph::Step::own)
    {
        if (auto done = edits.perform (std::move (command), step); ! done) return { std::move (done).error() };
        return submit();
    }
    Messages undo() { return edits.undo() ? submit() : Messages {}; }
    Messages redo() { return edits.redo() ? submit() : Messages {}; }

    /// Gives devices to roles that were added to the graph since the run began.
    Messages join (std::span<const Engine::Joining> devices) { return submit (devices); }

    Result<> set (const std::string& name, const Json& value) { return turnParam (run.engine(), name, value); }

private:
    Messages submit (std::span<const Engine::Joining> joining = {})
    {
        auto edit = run.edit (edits.graph());
        if (edit.plan() != nullptr) edit.commit (joining);
        return std::move (edit.messages());
    }

    graph::History edits;   // accepts edits with errors, as the window does
    Run run;
};

}   // namespace tactus::test
