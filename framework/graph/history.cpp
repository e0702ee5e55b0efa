// SPDX-License-Identifier: MIT
#include "history.hpp"

namespace tactus::graph
{

namespace
{
/// Of many values for one parameter only the last is worth keeping. Returns whether the earlier command took it over.
bool merge (Command& earlier, const Command& later)
{
    auto* a = std::get_if<SetParam> (&earlier.edit);
    const auto* b = std::get_if<SetParam> (&later.edit);
    if (a == nullptr || b == nullptr || a->patch != b->patch || a->node != b->node || a->param != b->param || ! a->value || ! b->value) return false;
    a->value = b->value;
    return true;
}
}   // namespace

std::optional<Message> History::perform (Command command, Step step)
{
    auto result = apply (edited, command);
    if (auto* refused = std::get_if<Message> (&result)) return std::move (*refused);
    auto& inverse = std::get<Command> (result);

    steps.erase (steps.begin() + static_cast<std::ptrdiff_t> (done), steps.end());
    if (step == Step::own || steps.empty())
    {
        steps.push_back ({ nameOf (command), {}, {} });
        ++done;
    }
    auto& last = steps.back();
    if (! last.commands.empty() && merge (last.commands.back(), command)) return std::nullopt;
    last.commands.push_back (std::move (command));
    last.inverses.push_back (std::move (inverse));
    return std::nullopt;
}

bool History::undo()
{
    if (done == 0) return false;
    auto& [name, commands, inverses] = steps[--done];
    for (auto i = inverses.size(); i-- > 0;)
        commands[i] = std::get<Command> (apply (edited, inverses[i], Checks::none));   // the way forth again, to the same ids
    return true;
}

bool History::redo()
{
    if (done == steps.size()) return false;
    for (const auto& command : steps[done++].commands)
        apply (edited, command, Checks::none);
    return true;
}

std::vector<std::string> History::names() const
{
    std::vector<std::string> list;
    for (const auto& step : steps)
        list.push_back (step.name);
    return list;
}

}   // namespace tactus::graph
