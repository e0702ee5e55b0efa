// SPDX-License-Identifier: GPL-3.0-or-later
#include "edited.hpp"

#include <tactus/graph/edit.hpp>
#include <tactus/plan/compile.hpp>

#include <stdexcept>
#include <utility>

namespace tactus::bench
{

Edited::Edited (graph::Graph g) : graph (std::move (g)), last (graph.root.wires.back())
{
    engine = std::make_unique<Engine> (compile (graph, catalogue()).plan);
    engine->tick();
    knob = engine->param (graph.root.nodes.front().name + ".cutoff").value();
}

std::shared_ptr<Plan> Edited::edited()
{
    has_last = ! has_last;
    const auto command = has_last ? graph::Command (graph::AddWire { "", last }) : graph::Command (graph::RemoveWire { "", last.id });
    if (! graph::apply (graph, command)) throw std::logic_error ("the edit was refused");
    auto compiled = compile (graph, catalogue(), { .before = &engine->newest() });
    if (! compiled.plan) throw std::logic_error ("no plan");
    return std::move (compiled.plan);
}

void Edited::edit()
{
    engine->submit (edited());
    engine->takeSubmitted();
}

void Edited::compileAll() { compile (graph, catalogue()); }

void Edited::prepareTakeover() { engine->submit (edited()); }

void Edited::takeOver() { engine->tick(); }

void Edited::tick() { engine->tick(); }

void Edited::turn()
{
    engine->set (knob, 200.0 + ++turns % 100);
    engine->tick();
}

}   // namespace tactus::bench
