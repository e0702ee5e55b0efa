// SPDX-License-Identifier: MIT
#include "history.hpp"
#include <tactus/graph/edit/find_wire.hpp>

#include <string_view>

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
    const auto places = placesOf (command);
    if (places.empty()) return refusal;
    refusal.where = places.front();
    if (const auto id = refusal.where.find ("/wires/"); id != std::string::npos) refusal.where.resize (id + std::string_view ("/wires").size());
    return refusal;
}
}   // namespace

Result<> History::perform (Command command, Step step)
{
    identify (edited, command);
    auto inverse = carryOut (command);
    if (! inverse) return located (std::move (inverse).error(), command);

    steps.erase (steps.begin() + static_cast<std::ptrdiff_t> (done), steps.end());
    if (step == Step::own || steps.empty())
    {
        steps.push_back ({ nameOf (command), {}, {} });
        ++done;
    }
    auto& last = steps.back();
    if (! last.commands.empty() && merge (last.commands.back(), command)) return {};
    last.commands.push_back (std::move (command));
    last.inverses.push_back (*std::move (inverse));
    return {};
}

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
    if (done == 0) return false;
    auto& [name, commands, inverses] = steps[--done];
    for (auto i = inverses.size(); i-- > 0;)
        commands[i] = restore (inverses[i]);   // redoing it brings back the same ids
    return true;
}

bool History::redo()
{
    if (done == steps.size()) return false;
    for (const auto& command : steps[done++].commands)
        restore (command);
    return true;
}

Command History::restore (const Command& command)
{
    if (check) check->forget();
    return *apply (edited, command, Checks::none);
}

Result<Command> History::carryOut (const Command& command)
{
    auto inverse = apply (edited, command, Checks::all);
    if (! inverse || ! check || ! check->mayAddError (edited, command)) return inverse;
    const auto after = check->problems (edited);
    if (after.empty()) return inverse;
    auto before = edited;
    (void)apply (before, *inverse, Checks::none);
    const auto* added = firstAdded (check->problems (before), after, command);
    if (added == nullptr) return inverse;
    edited = std::move (before);
    return *added;
}

std::vector<std::string> History::names() const
{
    std::vector<std::string> list;
    for (const auto& step : steps)
        list.push_back (step.name);
    return list;
}

}   // namespace tactus::graph
