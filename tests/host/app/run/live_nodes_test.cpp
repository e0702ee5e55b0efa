// SPDX-License-Identifier: GPL-3.0-or-later
// Live C++ in the window: the header of a node is saved while its graph runs.
#include "host/app/support/wait_for.hpp"

#include <host/app/problems/problem_list.hpp>
#include <host/app/window/main_view.hpp>

#include "support/temporary_folder.hpp"

#include <host/app/inspector/blocks/set_row.hpp>
#include <tactus/file/text_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr const char* graph_text = R"({
  "format": "tactus-graph", "version": 2, "name": "Push", "rate_hz": 1000,
  "devices": { "stylus": { "driver": "sim", "mass": "50 g", "damping": "1 N*s/m", "hand": { "stiffness": "600 N/m", "damping": "6 N*s/m", "path": "stroke" },
                           "guard": { "max_force": "5 N" } } },
  "nodes": {
    "hand": { "type": "device.position", "role": "stylus" },
    "push": { "type": "window.push" },
    "motor": { "type": "device.force", "role": "stylus" }
  },
  "wires": ["hand.position -> push.position", "push.force -> motor.force"]
})";

/// A node that pushes upwards. `{more}` is replaced by params and their rows, `{force}` by the force in N.
constexpr const char* header_text = R"(// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

namespace window
{

using namespace tactus;

struct Push
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };

    struct Params
    {
        double strength = 0.5;
        {member}
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
    };

    static constexpr Info info { .id = "window.push", .name = "Push", .summary = "A force upwards.", .source = "for tests" };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "not used"),
        param (&Params::strength, "strength", unit::newton, "the force"),
        {row}
        output (&Outputs::force, "force", unit::newton, "the force"),
    };

    Params params;

    Outputs tick (const Inputs&) noexcept
    {
        return { .force = Vec3 (0.0, 0.0, {force}) };
    }
};

}   // namespace window

TACTUS_NODE (window::Push);
)";

void replace (std::string& text, const std::string& what, const std::string& by) { text.replace (text.find (what), what.size(), by); }

std::string header (const std::string& force, const std::string& member = {}, const std::string& row = {})
{
    std::string text = header_text;
    replace (text, "{force}", force);
    replace (text, "{member}", member);
    replace (text, "{row}", row);
    return text;
}

int lineOf (const std::string& text, const std::string& what)
{
    return 1 + static_cast<int> (std::count (text.begin(), text.begin() + static_cast<std::ptrdiff_t> (text.find (what)), '\n'));
}

/// The labels of the rows in a part of the window.
void addLabels (juce::Component& part, std::vector<std::string>& to)
{
    if (auto* row = dynamic_cast<SetRow*> (&part)) to.push_back (row->label().toStdString());
    for (auto* child : part.getChildren())
        addLabels (*child, to);
}

/// A window that runs the graph and watches code.
struct Window
{
    explicit Window (const LiveSource& code)
    {
        folder.write ("push.json", graph_text);
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        setenv ("TACTUS_PRESETS", TACTUS_SOURCE_DIR "/graphs", 1);
        setenv ("TACTUS_GRAPHS", (folder / "own").c_str(), 1);
        view = std::make_unique<MainView> (catalogue());
        view->setSize (1280, 720);
        view->begin ({ .home = home.path(), .files = { folder / "push.json" }, .live = { code } });
    }
    ~Window()
    {
        view.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }

    /// Runs the window until this is so. The patience is for a compiler on a busy machine.
    template <typename F>
    bool until (F&& f)
    {
        return host::test::waitFor (f, 60);
    }

    bool pushes (double force)
    {
        return until ([&] {
            const auto tool = view->run().tool();
            return tool && std::abs (tool->force.z() - force) < 1e-9;
        });
    }

    std::vector<std::string> labels()
    {
        std::vector<std::string> all;
        addLabels (view->part<Inspector>().shown(), all);
        return all;
    }

    /// What the compiler said last, as Problems shows it.
    std::optional<Message> error()
    {
        const auto& all = view->part<ProblemList>().messages();
        const auto found = std::ranges::find (all, std::string ("live/compile"), &Message::id);
        return found == all.end() ? std::nullopt : std::optional (*found);
    }

    bool has (const std::string& label)
    {
        const auto all = labels();
        return std::ranges::count (all, label) > 0;
    }

    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    TemporaryFolder folder, home;
    std::unique_ptr<MainView> view;
};

/// Expires when the plugin of a type is unloaded.
std::weak_ptr<const void> pluginOf (const std::string& type) { return catalogue().find (type)->owner; }
}   // namespace

TEST_CASE ("a header that is saved while its graph runs in the window takes over, and an error leaves the old node running", "[live_nodes]")
{
    TemporaryFolder code;
    code.write ("push.hpp", header ("0.0"));
    Window w { liveHeader (code / "push.hpp").value() };
    CHECK (catalogue().find ("window.push") == nullptr);   // the header has not been saved yet

    code.write ("push.hpp", header ("params.strength"));
    REQUIRE (w.pushes (0.5));
    CHECK (w.view->statusText().startsWith ("push.hpp: in use "));
    CHECK_FALSE (w.error());
    const auto first = pluginOf ("window.push");

    w.view->canvas().select ({ w.view->document().graph().root.find ("push")->id });
    CHECK (w.has ("Strength"));
    CHECK_FALSE (w.has ("More"));
    REQUIRE (w.view->document().perform (graph::SetParam { "", "push", "strength", Json ("0.75 N") }));
    REQUIRE (w.pushes (0.75));

    // Another behaviour and another param, which the inspector shows although the selection is the same.
    const std::string member = "double more = 0.25;", row = "param (&Params::more, \"more\", unit::newton, \"more force\"),";
    code.write ("push.hpp", header ("2.0 * params.strength + params.more", member, row));
    REQUIRE (w.pushes (1.75));
    CHECK (w.has ("More"));
    CHECK (w.until ([&] { return first.expired(); }));   // neither a panel nor a plan uses it
    const auto second = pluginOf ("window.push");

    const auto broken = header ("2.0 * params.strenght", member, row);
    code.write ("push.hpp", broken);
    REQUIRE (w.until ([&] { return w.error().has_value(); }));
    const auto error = *w.error();
    CHECK (error.text.starts_with ("push.hpp:" + std::to_string (lineOf (broken, "strenght")) + ": "));
    CHECK (error.text.find ("strenght") != std::string::npos);
    CHECK (w.view->run().isRunning());
    CHECK (w.pushes (1.75));
    CHECK_FALSE (second.expired());

    REQUIRE (w.view->document().perform (graph::SetParam { "", "push", "more", Json ("1 N") }));   // the old version can still be edited
    REQUIRE (w.pushes (2.5));

    code.write ("push.hpp", header ("-params.strength", member, row));
    REQUIRE (w.pushes (-0.75));
    CHECK (w.until ([&] { return second.expired(); }));
    CHECK_FALSE (w.error());
}

TEST_CASE ("the window unloads each version of a plugin when the next one has taken over, stopped or with its help open", "[live_nodes]")
{
    TemporaryFolder code;
    const auto text = *readTextFile (TACTUS_SOURCE_DIR "/tests/plugins/objects/written_in_c.c");
    code.write ("twice.c", text);
    Window w { LiveSource { .file = code / "p.tactus", .sources = { code / "twice.c" }, .compiler = "cc" } };
    const auto save = [&] (int factor) {
        auto next = text;
        replace (next, "2.0 * v", std::to_string (factor) + ".0 * v");
        code.write ("twice.c", next);
        const auto before = catalogue().find ("c.twice") == nullptr ? std::weak_ptr<const void> {} : pluginOf ("c.twice");
        const auto* old = catalogue().find ("c.twice");
        REQUIRE (w.until ([&] { return catalogue().find ("c.twice") != old; }));
        CHECK (w.until ([&] { return before.expired(); }));
    };
    save (3);
    graph::Node node;
    node.name = "twice";
    node.type = "c.twice";
    REQUIRE (w.view->document().perform (graph::AddNode { "", node }));
    for (int i = 4; i < 10; ++i)
        save (i);

    w.view->canvas().select ({ w.view->document().graph().root.find ("twice")->id });
    w.view->part<HelpPanel>().showNode ("c.twice");
    w.view->part<Inspector>().setHelp (true);
    for (int i = 10; i < 14; ++i)
        save (i);
    CHECK (w.view->part<HelpPanel>().isOpen());

    w.view->run().letGo();
    for (int i = 14; i < 18; ++i)
        save (i);
    CHECK_FALSE (w.error());
}
