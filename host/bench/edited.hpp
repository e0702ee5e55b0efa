// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/history.hpp>
#include <tactus/run/engine.hpp>

#include <memory>

namespace tactus::bench
{

/// A large graph that runs while it is edited. Each edit removes the last wire, or restores it.
class Edited
{
public:
    explicit Edited (graph::Graph);

    void prepareTakeover();   ///< edits, and submits the plan
    void takeOver();          ///< the tick that takes over that plan
    void tick();              ///< a tick on which nothing has changed
    void turn();              ///< turns a knob, and ticks

private:
    std::shared_ptr<Plan> edited();

    graph::History history;
    graph::Wire last;
    bool has_last = true;
    std::unique_ptr<Engine> engine;
    plan::ParamRef knob;
    int turns = 0;
};

}   // namespace tactus::bench
