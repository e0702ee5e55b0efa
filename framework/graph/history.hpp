// SPDX-License-Identifier: MIT
#pragma once

#include "edit_check.hpp"

#include <tactus/node/catalogue.hpp>

#include <optional>
#include <span>

namespace tactus::graph
{

/// The undo step of an edit: its own, or joined to the last one. Turning a knob sends hundreds of values, which undo should revert together.
enum class Step
{
    own,
    joined,
    of_another_graph   ///< its own, from one graph to another, so undo and redo bring back the name
};

/// A graph with its undo history. The graph changes only through this class, so undo and redo cannot fail. [main thread]
///
/// An edit is refused if it would add an error that compile() reports: an unknown type, port, parameter or setting, a value with a wrong unit
/// or out of range, a wire that does not fit, a loop without a delay. Errors that the graph already has do not matter: an edit that adds none
/// is carried out, also if it does not remove them. So what an edit writes itself must be right, and nothing else may become wrong. A batch is
/// judged by its result. Not checked here: ReplaceGraph and undo, because they bring back or load a graph as it is; files that settings name,
/// and budgets, which compile() checks; devices, which the run checks.
class History
{
public:
    /// Checks edits against these types, which must outlive it. Null: nothing is known about types, so an edit is only checked for what a
    /// file can hold. Nodes of types that are known elsewhere can be added, and their ports and values are not checked.
    explicit History (Graph g, const Catalogue* types = &catalogue(), KnownElsewhere elsewhere = {}) : edited (std::move (g))
    {
        if (types != nullptr) problems = problemsAgainst (*types, std::move (elsewhere));
    }

    const Graph& graph() const noexcept { return edited; }

    /// Carries out a command and discards the steps that could be redone. Fails if the command is refused; then nothing has changed. The
    /// errors are those of edit.hpp and of compile().
    Result<> perform (Command, Step = Step::own);

    /// Begins a batch: until finish() or abandon(), edits are one step, and only their result is checked against the types. So an edit may leave
    /// an error that a later one removes. If an edit fails, the whole batch is taken back, and the edits after it fail with the same error.
    /// Edits cannot be undone while a batch is open. There must be no open batch.
    void begin (std::string name);
    bool isInBatch() const noexcept { return batch.has_value(); }

    /// Ends the batch. Fails if one of its edits has failed, or if their result has an error that they have added; then nothing has changed.
    Result<> finish();
    void abandon();   ///< ends the batch, and takes its edits back

    /// Gives the graph another name. This is no step: undo keeps the name, unless it undoes an edit of the name or brings back another graph.
    void call (std::string name) { edited.name = std::move (name); }

    /// Inserts a step that changes nothing before the steps that could be redone, which can still be redone after it.
    void insertStep (std::string name);

    /// Removes a step that was undone and changes nothing. Returns false, and leaves it, if it changes something.
    bool removeEmptyStep (std::size_t step);

    bool undo();   ///< false if there is nothing to undo, or a batch is open
    bool redo();

    /// The names of the steps, oldest first. Steps from position() on have been undone.
    std::vector<std::string> names() const;
    const std::string& stepName (std::size_t step) const { return steps[step].name; }
    std::size_t size() const noexcept { return steps.size(); }
    std::size_t position() const noexcept { return done; }

    /// The edits of a step: the commands that carry it out, and for each of them the command that undoes it.
    std::span<const Command> commandsOf (std::size_t step) const { return steps[step].commands; }
    std::span<const Command> inversesOf (std::size_t step) const { return steps[step].inverses; }

private:
    struct Done
    {
        std::string name;
        std::vector<Command> commands, inverses;   ///< by edit of the step: its command and its inverse
        bool names_graph = false;                  ///< undo and redo bring back the name of the graph
    };

    /// The edits so far. After a failure, they have been taken back.
    struct OpenBatch
    {
        Done step;
        std::optional<Message> failure {};
    };

    Result<Command> carryOut (const Command&);
    std::optional<Message> addedError (std::span<const Command> commands, std::span<const Command> inverses) const;
    void takeBack (std::span<const Command> inverses);
    void dropUndone();

    Graph edited;
    FindProblems problems;   ///< empty: edits are not checked against types
    std::optional<OpenBatch> batch;
    std::vector<Done> steps;
    std::size_t done = 0;
};

}   // namespace tactus::graph
