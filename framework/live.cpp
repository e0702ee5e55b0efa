// SPDX-License-Identifier: MIT
#include "live.hpp"
#include "turn.hpp"

namespace tactus
{

Live::Live (graph::Graph g, const Catalogue& c, CompileOptions o, std::shared_ptr<Plan> first) : edits (std::move (g)), catalogue (c), options (std::move (o)), running (std::move (first)), first_rate_hz (edits.graph().rate_hz)
{
    options.rate_hz = running.newest().rate_hz;   // devices and guards hold on to it
}

Messages Live::perform (graph::Command command, graph::Step step)
{
    if (auto refusal = edits.perform (std::move (command), step)) return { std::move (*refusal) };
    return compileAndSubmit();
}

Messages Live::undo() { return edits.undo() ? compileAndSubmit() : Messages {}; }

Messages Live::redo() { return edits.redo() ? compileAndSubmit() : Messages {}; }

Messages Live::join (std::span<const Engine::Joining> devices) { return compileAndSubmit (devices); }

Messages Live::compileAndSubmit (std::span<const Engine::Joining> joining)
{
    auto waiting = running.withdraw();
    options.before = &running.newest();
    options.withdrawn = waiting.get();
    auto [plan, messages] = compile (edits.graph(), catalogue, options);
    if (plan)
        running.submit (std::move (plan), joining);
    else
        running.submit (std::move (waiting));
    if (edits.graph().rate_hz != first_rate_hz)
        messages.push_back ({ Message::Severity::warning, "live/rate", "/rate_hz", "the graph's rate was changed, and devices and guards run at another already", "start anew to run at it" });
    return std::move (messages);
}

std::optional<Message> Live::set (const std::string& name, const Json& value) { return turnParam (running, name, value); }

}   // namespace tactus
