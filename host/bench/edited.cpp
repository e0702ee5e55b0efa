// SPDX-License-Identifier: GPL-3.0-or-later
#include "edited.hpp"

#include <tactus/plan/compile.hpp>

#include <stdexcept>
#include <utility>

namespace tactus::bench
{

Edited::Edited (graph::Graph g) : history (std::move (g)), last (history.graph().root.wires.back())
{
    engine = std::make_unique<Engine> (compile (history.graph(), catalogue()).plan);
    engine->tick();
    knob = engine->param (history.graph().root.nodes.front().name + ".cutoff").value();
}

std::shared_ptr<Plan> Edited::edited()
{
    has_last = ! has_last;
    auto command = has_last ? graph::Command (graph::AddWire { "", last }) : graph::Command (graph::RemoveWire { "", last.id });
    if (! history.perform (std::move (command), graph::Step::joined)) throw std::logic_error ("the edit was refused");
    auto compiled = compile (history.graph(), catalogue(), { .before = &engine->newest() });
    if (! compiled.plan) throw std::logic_error ("no plan");
    return std::move (compiled.plan);
}

void Edited::prepareTakeover() { engine->submit (edited()); }

void Edited::takeOver() { engine->tick(); }

void Edited::tick() { engine->tick(); }

void Edited::turn()
{
    engine->set (knob, 200.0 + ++turns % 100);
    engine->tick();
}

}   // namespace tactus::bench
