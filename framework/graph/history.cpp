// SPDX-License-Identifier: MIT
#include "history.hpp"
#include <tactus/graph/edit/find_wire.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace tactus::graph
{

namespace
{
/// Replaces the value of the earlier command if both set the same parameter. Returns true if it did.
bool merge (Command& earlier, const Command& later)
{
    auto* a = std::get_if<SetParam> (&earlier.edit);
    const auto* b = std::get_if<SetParam> (&later.edit);
    if (a == nullptr || b == nullptr || a->patch != b->patch || a->node != b->node || a->param != b->param || ! a->value || ! b->value) return false;
    a->value = b->value;
    return true;
}

/// Replaces the text of a wire to remove by its id, which stays the same.
void identify (const Graph& g, Command& command)
{
    auto* c = std::get_if<RemoveWire> (&command.edit);
    if (c == nullptr || c->text.empty()) return;
    if (const auto found = findWire (g, c->patch, c->text)) *c = { c->patch, *found, {} };
}

/// A refusal always names a place: if it has none, that of the edit. The wires of an edit are not in the graph, so they have no number.
Message located (Message refusal, const Command& command)
{
    if (! refusal.where.empty()) return refusal;
    refusal.where = placeOf (command);
    if (const auto id = refusal.where.find ("/wires/"); id != std::string::npos) refusal.where.resize (id + std::string_view ("/wires").size());
    return refusal;
}

void undoIn (Graph& g, std::span<const Command> inverses)
{
    for (auto i = inverses.size(); i-- > 0;)
        (void)apply (g, inverses[i], Checks::none);
}
}   // namespace

Result<> History::perform (Command command, Step step)
{
    if (batch && batch->failure) return *batch->failure;
    identify (edited, command);
    const auto called = edited.name;
    auto inverse = carryOut (command);
    if (! inverse)
    {
        auto why = located (std::move (inverse).error(), command);
        if (batch)
        {
            takeBack (std::exchange (batch->step, {}).inverses);
            batch->failure = why;
        }
        return why;
    }

    if (! batch)
    {
        dropUndone();
        if (step != Step::joined || steps.empty())
        {
            steps.push_back ({ nameOf (command), {}, {} });
            ++done;
        }
    }
    auto& last = batch ? batch->step : steps.back();
    if (step == Step::of_another_graph || edited.name != called) last.names_graph = true;
    if (! last.commands.empty() && merge (last.commands.back(), command)) return {};
    last.commands.push_back (std::move (command));
    last.inverses.push_back (*std::move (inverse));
    return {};
}

void History::begin (std::string name) { batch = { { std::move (name), {}, {} }, {} }; }

Result<> History::finish()
{
    auto [step, failure] = *std::exchange (batch, std::nullopt);
    if (failure) return *std::move (failure);
    if (step.commands.empty()) return {};
    if (auto added = addedError (step.commands, step.inverses))
    {
        takeBack (step.inverses);
        return *std::move (added);
    }
    dropUndone();
    steps.push_back (std::move (step));
    ++done;
    return {};
}

void History::abandon() { takeBack (std::exchange (batch, std::nullopt)->step.inverses); }

void History::insertStep (std::string name)
{
    steps.insert (steps.begin() + static_cast<std::ptrdiff_t> (done), Done { std::move (name), {}, {} });
    ++done;
}

bool History::removeEmptyStep (std::size_t step)
{
    if (step < done || step >= steps.size() || ! steps[step].commands.empty()) return false;
    steps.erase (steps.begin() + static_cast<std::ptrdiff_t> (step));
    return true;
}

bool History::undo()
{
    if (batch || done == 0) return false;
    auto& step = steps[--done];
    const auto called = edited.name;
    for (auto i = step.inverses.size(); i-- > 0;)
        step.commands[i] = *apply (edited, step.inverses[i], Checks::none);   // redoing it brings back the same ids
    if (! step.names_graph) edited.name = called;
    return true;
}

bool History::redo()
{
    if (batch || done == steps.size()) return false;
    auto& step = steps[done++];
    const auto called = edited.name;
    for (std::size_t i = 0; i < step.commands.size(); ++i)
        step.inverses[i] = *apply (edited, step.commands[i], Checks::none);   // undoing it brings back the same name
    if (! step.names_graph) edited.name = called;
    return true;
}

Result<Command> History::carryOut (const Command& command)
{
    auto inverse = apply (edited, command, Checks::all);
    if (! inverse || batch) return inverse;
    auto added = addedError ({ &command, 1 }, { &*inverse, 1 });
    if (! added) return inverse;
    takeBack ({ &*inverse, 1 });
    return *std::move (added);
}

/// The first error that the latest edits have added to the graph.
std::optional<Message> History::addedError (std::span<const Command> commands, std::span<const Command> inverses) const
{
    if (! problems || std::ranges::none_of (commands, mayAddError)) return {};
    const auto after = problems (edited);
    if (after.empty()) return {};
    auto before = edited;
    undoIn (before, inverses);
    const auto* added = firstAdded (problems (before), after, commands);
    return added != nullptr ? std::optional (*added) : std::nullopt;
}

void History::takeBack (std::span<const Command> inverses) { undoIn (edited, inverses); }

void History::dropUndone() { steps.erase (steps.begin() + static_cast<std::ptrdiff_t> (done), steps.end()); }

std::vector<std::string> History::names() const
{
    std::vector<std::string> list;
    for (const auto& step : steps)
        list.push_back (step.name);
    return list;
}

}   // namespace tactus::graph
