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
    auto inverse = carryOutIfRight (command);
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

bool History::undo()
{
    if (done == 0) return false;
    auto& [name, commands, inverses] = steps[--done];
    for (auto i = inverses.size(); i-- > 0;)
        commands[i] = *carryOut (inverses[i], Checks::none);   // redoing it brings back the same ids
    return true;
}

bool History::redo()
{
    if (done == steps.size()) return false;
    for (const auto& command : steps[done++].commands)
        (void)carryOut (command, Checks::none);
    return true;
}

Result<Command> History::carryOut (const Command& command, Checks checks)
{
    auto inverse = apply (edited, command, checks);
    if (inverse && check) check->follow (command, *inverse);
    return inverse;
}

Result<Command> History::carryOutIfRight (const Command& command)
{
    auto inverse = carryOut (command, Checks::all);
    if (! inverse) return inverse;
    if (const auto after = check ? check->problems (edited, command, *inverse) : std::vector<Problem> {}; ! after.empty())
    {
        const auto again = carryOut (*inverse, Checks::none);
        if (const auto* added = firstAdded (check->problems (edited, command, *inverse), after, command)) return *added;
        inverse = carryOut (*again, Checks::none);
    }
    return inverse;
}

std::vector<std::string> History::names() const
{
    std::vector<std::string> list;
    for (const auto& step : steps)
        list.push_back (step.name);
    return list;
}

}   // namespace tactus::graph
