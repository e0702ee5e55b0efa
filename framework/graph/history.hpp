// SPDX-License-Identifier: MIT
#pragma once

#include "edit.hpp"

#include <span>

namespace tactus::graph
{

/// Whether an edit is its own undo step, or joins the last one. Turning a knob sends hundreds of values, which undo should
/// revert together.
enum class Step
{
    own,
    joined
};

/// A graph with its undo history. The graph changes only through this class, so undo and redo cannot fail. [main thread]
class History
{
public:
    explicit History (Graph g) : edited (std::move (g)) {}

    const Graph& graph() const noexcept { return edited; }

    /// Carries out a command and discards the steps that could be redone. Fails if the command is refused.
    Result<> perform (Command, Step = Step::own);

    bool undo();   ///< false if there is nothing to undo
    bool redo();

    /// The names of the steps, oldest first. Steps from position() on have been undone.
    std::vector<std::string> names() const;
    std::size_t position() const noexcept { return done; }

    /// The edits of a step: the commands that carry it out, and for each of them the command that undoes it.
    std::span<const Command> commandsOf (std::size_t step) const { return steps[step].commands; }
    std::span<const Command> inversesOf (std::size_t step) const { return steps[step].inverses; }

private:
    struct Done
    {
        std::string name;
        std::vector<Command> commands, inverses;   ///< by edit of the step: its command and its inverse
    };

    Result<Command> carryOut (const Command&, Checks);

    Graph edited;
    std::vector<Done> steps;
    std::size_t done = 0;
};

}   // namespace tactus::graph
