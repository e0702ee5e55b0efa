// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/run/live_run.hpp>
#include <host/app/scopes/scope_panel.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace tactus::host::test
{

/// A scope panel without a display, whose graph is ticked by the test.
struct Bench
{
    juce::ScopedJuceInitialiser_GUI juce;
    Look look;
    Document document;
    LiveRun live_run;
    FileAssets assets;
    std::unique_ptr<ScopePanel> panel;
    std::shared_ptr<Plan> plan;
    std::uint64_t tick = 0;
    double speed = 4.0;

    explicit Bench (const std::string& name = "dry_wood")
        : document (std::move (loadGraph (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs" / (name + ".json")).graph)), live_run (document, catalogue())
    {
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        panel = std::make_unique<ScopePanel> (document, live_run.traces(), catalogue());
        panel->setSize (1100, 260);
    }

    ~Bench()
    {
        panel.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }

    /// Compiles a plan that records the requested ports, and strokes the board with it.
    void run (int ticks)
    {
        auto& traces = live_run.traces();
        auto compiled = compile (document.graph(), catalogue(), { .records = traces.ports(), .assets = &assets });
        REQUIRE (compiled.plan);
        plan = std::move (compiled.plan);
        traces.planComes (*plan);
        for (int i = 0; i < ticks; ++i, ++tick)
        {
            const double t = static_cast<double> (tick) / document.graph().rate_hz;
            for (auto& r : plan->roles())
                r.state->reading.position = Vec3 (0.03 * std::sin (speed * t), 0.0, -5e-4);
            plan->tick();
            for (auto& r : plan->roles())   // acts as a guard that lets everything through
            {
                r.state->applied = {};
                for (const auto& sink : r.sinks)
                    r.state->applied.force += sink.effort (sink.node).force;
            }
            traces.after (*plan, tick, false);
            if (i % 500 == 0) traces.collect();
        }
        traces.collect();
        panel->refresh();
    }

    ScopeView& view (ScopeKind kind)
    {
        const auto at = std::ranges::find_if (panel->shown(), [&] (const auto& v) { return v->shown().kind == kind; });
        REQUIRE (at != panel->shown().end());
        return **at;
    }

    static std::vector<std::string> labels (juce::Component& c)
    {
        std::vector<std::string> all;
        for (auto* child : c.getChildren())
            if (auto* b = dynamic_cast<FlatButton*> (child)) all.push_back (b->getButtonText().toStdString());
        return all;
    }
};

}   // namespace tactus::host::test
