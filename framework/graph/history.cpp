// SPDX-License-Identifier: MIT
#include "history.hpp"

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
}   // namespace

Result<> History::perform (Command command, Step step)
{
    auto inverse = carryOut (command, Checks::all);
    if (! inverse) return std::move (inverse).error();

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
