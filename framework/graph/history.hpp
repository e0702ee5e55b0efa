// SPDX-License-Identifier: MIT
#pragma once

#include "edit.hpp"

namespace tactus::graph
{

/// Whether an edit is a step of its own, or goes on with the last one: a knob that is turned sends hundreds of values,
/// and undo should take back the turn.
enum class Step
{
    own,
    joined
};

/// A graph with all that was done to it. The graph is changed through here only, so undo and redo cannot fail.
/// [main thread]
class History
{
public:
    explicit History (Graph g) : edited (std::move (g)) {}

    const Graph& graph() const noexcept { return edited; }

    /// Carries out a command; what was undone before can then not be redone. Returns why it was refused, if it was.
    std::optional<Message> perform (Command, Step = Step::own);

    bool undo();   ///< false if there is nothing to undo
    bool redo();

    /// The steps by name, the oldest first; those that are undone come after position().
    std::vector<std::string> names() const;
    std::size_t position() const noexcept { return done; }

private:
    struct Done
    {
        std::string name;
        std::vector<Command> commands, inverses;   ///< one each for every edit of the step, in the order they were done
    };

    Graph edited;
    std::vector<Done> steps;
    std::size_t done = 0;
};

}   // namespace tactus::graph
