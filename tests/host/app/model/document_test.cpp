// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/model/document.hpp>

#include "support/random_edit.hpp"
#include "support/temporary_folder.hpp"

#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
graph::Graph graphOf (const std::string& name) { return loadGraph (std::string (TACTUS_SOURCE_DIR) + "/graphs/" + name).graph; }
}   // namespace

TEST_CASE ("undoing an open brings back the previous graph with its file and edits")
{
    Document d (graphOf ("dry_wood.json"), "wood.json");
    REQUIRE (d.perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    const auto edited = writeGraph (d.graph());
    d.open (graphOf ("soft_pad.json"), { .file = "pad.json" }, "open Soft pad");
    CHECK (d.file() == "pad.json");
    CHECK_FALSE (d.isChanged());
    CHECK (d.history().names().back() == "open Soft pad");

    d.undo();
    CHECK (d.file() == "wood.json");
    CHECK (writeGraph (d.graph()) == edited);
    CHECK (d.isChanged());
    d.undo();
    CHECK_FALSE (d.isChanged());
    d.redo();
    d.redo();
    CHECK (d.file() == "pad.json");
    CHECK (d.graph().name == "Soft pad");
}

TEST_CASE ("undo and redo keep the name that a graph gets with its file, also where nodes are grouped, but not that of another graph")
{
    Document d (graphOf ("dry_wood.json"));
    REQUIRE (d.perform (graph::CollapseNodes { "", { "drag", "grain" }, "wood", "wood" }));
    d.undo();
    d.call ("Kb5");
    d.redo();
    CHECK (d.graph().name == "Kb5");
    d.undo();
    CHECK (d.graph().name == "Kb5");

    auto other = graphOf ("soft_pad.json");
    other.name = "Kb5";
    d.open (std::move (other), {}, "open another Kb5");
    d.call ("Mine");
    d.undo();
    CHECK (d.graph().name == "Kb5");
    d.call ("Kb6");
    d.redo();
    CHECK (d.graph().name == "Mine");
    d.undo();
    CHECK (d.graph().name == "Kb6");

    REQUIRE (d.perform (graph::SetHeader { .name = "Typed" }));
    d.undo();
    CHECK (d.graph().name == "Kb6");
    d.redo();
    CHECK (d.graph().name == "Typed");
}

TEST_CASE ("the version of a document tells whether more has changed than where nodes are")
{
    TemporaryFolder folder;
    Document d (graphOf ("dry_wood.json"));
    auto differs = [&, last = d.version()]() mutable { return std::exchange (last, d.version()) != d.version(); };
    const auto move = [] (double x) {
        return graph::Batch { "move", { graph::SetNodeKey { "", "drag", "ui", Json { { "at", Json::array ({ x, 0.0 }) } } } } };
    };
    REQUIRE (d.perform (move (10.0)));
    REQUIRE (d.perform (move (20.0), graph::Step::joined));
    d.undo();
    d.redo();
    CHECK_FALSE (differs());
    d.addWindowStep (
        "close scope", [] {}, [] {});
    d.undo();
    CHECK_FALSE (differs());

    REQUIRE (d.perform (graph::SetNodeKey { "", "drag", "bypass", Json (true) }));
    CHECK (differs());
    d.undo();
    CHECK (differs());
    REQUIRE (d.perform (graph::Batch { "both", { move (30.0), graph::SetParam { "", "drag", "mu", Json (0.9) } } }));
    CHECK (differs());
    REQUIRE (d.perform (move (40.0)));
    CHECK_FALSE (differs());
    d.goTo (0);
    CHECK (differs());
    REQUIRE (d.save (folder / "wood.json").empty());
    CHECK (differs());
    d.open (graphOf ("soft_pad.json"), {}, "open Soft pad");
    CHECK (differs());
    d.renew();
    CHECK (differs());
}

TEST_CASE ("a copy of a preset has no file until it is saved, but knows its preset")
{
    TemporaryFolder folder;
    Document d (graph::Graph {});
    d.open (graphOf ("soft_pad.json"), { .preset = "soft_pad.json" }, "open Soft pad");
    CHECK (d.file().empty());
    CHECK (d.preset() == "soft_pad.json");
    CHECK_FALSE (d.isChanged());
    REQUIRE (d.save (folder / "mine.json").empty());
    CHECK (d.file() == folder / "mine.json");
    d.undo();
    CHECK (d.file().empty());
    d.redo();
    CHECK (d.file() == folder / "mine.json");
    CHECK_FALSE (d.isChanged());
}

TEST_CASE ("saving a file that is open twice updates both")
{
    TemporaryFolder folder;
    const auto file = folder / "wood.json";
    Document d (graphOf ("dry_wood.json"), file);
    d.open (graphOf ("dry_wood.json"), { .file = file }, "open Dry wood");
    REQUIRE (d.perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    REQUIRE (d.save (file).empty());
    d.goTo (0);
    CHECK (d.isChanged());   // the file holds the other graph now
}

TEST_CASE ("a recovered graph counts as changed until it is saved")
{
    TemporaryFolder folder;
    Document d (graph::Graph {});
    d.open (graphOf ("dry_wood.json"), { .file = folder / "wood.json", .is_changed = true }, "recover Dry wood");
    CHECK (d.isChanged());
    REQUIRE (d.save (d.file()).empty());
    CHECK_FALSE (d.isChanged());
}

TEST_CASE ("a jump through the history notifies a listener once")
{
    struct Count final : Document::Listener
    {
        void documentChanged() override { ++n; }
        int n = 0;
    } count;
    Document d (graphOf ("dry_wood.json"));
    for (int i = 0; i < 5; ++i)
        REQUIRE (d.perform (graph::SetParam { "", "drag", "mu", Json (0.1 * i) }));
    d.add (count);
    d.goTo (1);
    CHECK (count.n == 1);
    d.goTo (1);
    CHECK (count.n == 1);
    d.goTo (100);
    CHECK (count.n == 2);
    CHECK (d.history().position() == 5);
    d.remove (count);
}

TEST_CASE ("a step of the window leaves what could be redone")
{
    Document d (graphOf ("dry_wood.json"));
    const auto text = [&] { return writeGraph (d.graph()); };
    const auto set = [&] (const char* value) { REQUIRE (d.perform (graph::SetParam { {}, "drag", "mu", Json (value) })); };
    const auto first = text();
    set ("0.1");
    const auto second = text();
    set ("0.2");
    const auto third = text();
    d.goTo (0);
    int shown = 1;
    d.addWindowStep (
        "close", [&] { shown = 0; }, [&] { shown = 1; });
    CHECK (d.history().position() == 1);
    CHECK (d.history().names().size() == 3);
    CHECK (text() == first);
    d.redo();
    CHECK (text() == second);
    CHECK (shown == 1);
    d.redo();
    CHECK (text() == third);
    d.goTo (1);
    CHECK (text() == first);
    CHECK (shown == 1);
    d.undo();
    CHECK (shown == 0);
    d.redo();
    CHECK (shown == 1);
    d.goTo (3);
    CHECK (text() == third);
    d.goTo (0);
    CHECK (shown == 0);
    d.addWindowStep (
        "open", [&] { shown = 2; }, [&] { shown = 3; });   // in place of the other one, which began with another window
    CHECK (d.history().names() == std::vector<std::string> { "open", "set 'drag.mu'", "set 'drag.mu'" });
    d.goTo (3);
    CHECK (text() == third);
    CHECK (shown == 0);
    d.goTo (0);
    CHECK (shown == 2);
    shown = 0;
    set ("0.3");   // an edit discards them, as always
    CHECK (d.history().names().size() == 1);
    d.undo();
    d.redo();
    CHECK (shown == 0);
}

// Longer than 60 lines: it is one random walk, and all its steps share the expected history.
TEST_CASE ("each history position keeps its graph and file under random edits, opens, saves, undos and redos")
{
    TemporaryFolder folder;
    for (unsigned seed = 0; seed < 40; ++seed)
    {
        std::mt19937 chance (seed);
        const auto upTo = [&] (int n) { return std::uniform_int_distribution<int> (0, n) (chance); };
        struct Moment
        {
            std::string graph;
            fs::path file, preset;
            const void* identity;
        };
        Document d (tactus::test::prefixed (graphOf ("dry_wood.json"), "a_", "stylus"), "first.json");
        const auto now = [&] { return Moment { writeGraph (d.graph()), d.file(), d.preset(), d.identity() }; };
        std::vector<Moment> expected { now() };
        for (int i = 0; i < 60; ++i)
        {
            auto position = d.history().position();
            const int what = upTo (9);
            if (what < 5)
            {
                const auto step = upTo (2) == 0 && position > 0 ? graph::Step::joined : graph::Step::own;
                auto after = now();   // an edit changes neither the file nor the preset
                if (! d.perform (tactus::test::randomEdit (chance, d.graph(), "a_", "stylus"), step)) continue;
                after.graph = writeGraph (d.graph());
                expected.resize (position + 1);
                if (step == graph::Step::joined)
                    expected.back() = after;
                else
                    expected.push_back (after);
            }
            else if (what == 5)
            {
                const auto file = "f" + std::to_string (i) + ".json";
                const bool is_copy = upTo (1) == 0;
                const auto other = is_copy ? graphOf ("liver.json") : tactus::test::prefixed (graphOf ("soft_pad.json"), "a_", "stylus");
                d.open (other, is_copy ? Document::Source { .preset = file } : Document::Source { .file = file }, "open");
                expected.resize (position + 1);
                expected.push_back ({ writeGraph (other), is_copy ? fs::path() : fs::path (file), is_copy ? fs::path (file) : fs::path(), d.identity() });
            }
            else if (what == 7)
            {
                const auto names = d.history().names();
                for (auto i = names.size(); i-- > position;)   // undone steps of the window go
                    if (names[i] == "window" && d.history().commandsOf (i).empty()) expected.erase (expected.begin() + static_cast<std::ptrdiff_t> (i) + 1);
                d.addWindowStep (
                    "window", [] {}, [] {});
                expected.insert (expected.begin() + static_cast<std::ptrdiff_t> (position), Moment (expected[position]));
            }
            else if (what == 6)
            {
                const auto file = folder / ("s" + std::to_string (upTo (2)) + ".json");
                REQUIRE (d.save (file).empty());
                REQUIRE_FALSE (d.isChanged());
                for (auto& m : expected)   // saving applies to all positions of the open graph
                    if (m.identity == d.identity())
                    {
                        m.file = file;
                        m.preset.clear();
                    }
            }
            else
                d.goTo (static_cast<std::size_t> (upTo (static_cast<int> (expected.size()))));
            position = d.history().position();
            REQUIRE (expected.size() == d.history().names().size() + 1);
            const auto& e = expected[position];
            REQUIRE (writeGraph (d.graph()) == e.graph);
            REQUIRE (d.file() == e.file);
            REQUIRE (d.preset() == e.preset);
            REQUIRE (d.identity() == e.identity);
        }
    }
}
