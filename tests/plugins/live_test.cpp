// SPDX-License-Identifier: MIT
// Live C++: new versions of a plugin take over during a run.
#include "load.hpp"
#include "support/no_allocation.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <host/code/plugins/live_plugins.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/run/run.hpp>
#include <tactus/run/turn.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
constexpr double rate_hz = 4000.0;

/// Records the force along z.
struct Scale final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return {}; }
    void write (const Effort& e) noexcept override
    {
        largest_step = std::max (largest_step, std::abs (e.force.z() - force));
        force = e.force.z();
    }

    double force = 0.0, largest_step = 0.0;
};

/// A run whose node types are replaced while it ticks, as play does it.
class LiveRun
{
public:
    LiveRun (graph::Graph g, std::vector<NodeType> types)
        : graph (std::move (g)), present (catalogue().with (std::move (types))), run (present, { .rate_hz = rate_hz })
    {
        first_messages = run.load (graph);
        if (run.hasEngine()) run.engine().attach ("stylus", scale);
    }

    Messages replace (std::vector<NodeType> types)
    {
        present = present.with (std::move (types));
        auto edit = run.edit (graph);
        auto messages = edit.messages();
        if (edit.plan() != nullptr && ! hasErrors (messages)) edit.commit();
        return messages;
    }

    void tick (int n)
    {
        const NoAllocation watch;
        for (int i = 0; i < n; ++i)
            run.tick();
        CHECK (watch.allocations() == 0);
        CHECK (watch.locks() == 0);
    }

    graph::Graph graph;
    Catalogue present;
    Scale scale;
    Run run;
    Messages first_messages;
};

graph::Graph growing()
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("grow", "live.growing", { { "slope", "1 N" } }).node ("motor", "device.force");
    return s.wire ("hand.position -> grow.position").wire ("grow.force -> motor.force").graph;
}

/// A copy of a plugin, loaded as live C++ loads a new version: a separate file, which is removed immediately.
std::vector<NodeType> version (const TemporaryFolder& folder, int number, const std::string& layout, const std::string& plugin = "live_node")
{
    const auto file = folder / (std::to_string (number) + ".tactus");
    fs::copy_file (test::pluginFile (plugin), file);
    auto news = host::loadLive (file, "node.hpp", layout);
    fs::remove (file);
    REQUIRE (news.messages.empty());
    return std::move (news.types);
}

/// The number of memory mappings of this process.
long mappings()
{
    std::ifstream maps ("/proc/self/maps");
    return std::count (std::istreambuf_iterator<char> (maps), {}, '\n');
}

long residentPages()
{
    std::ifstream statm ("/proc/self/statm");
    long size = 0, resident = 0;
    statm >> size >> resident;
    return resident;
}

/// Waits for news.
host::LivePlugins::RebuiltPlugin next (host::LivePlugins& live)
{
    std::optional<host::LivePlugins::RebuiltPlugin> news;
    REQUIRE (test::eventually (std::chrono::milliseconds (5), test::looks_at_compiler, [&] { return (news = live.poll()).has_value(); }));
    return std::move (*news);
}

std::string replaced (std::string text, const std::string& what, const std::string& by)
{
    const auto at = text.find (what);
    REQUIRE (at != std::string::npos);
    return text.replace (at, what.size(), by);
}

std::string sourceOf (const std::string& file) { return *readTextFile (fs::path (TACTUS_SOURCE_DIR) / "tests/plugins/objects" / file); }
}   // namespace

TEST_CASE ("a thousand live versions take over without a step, and all but the last are unloaded", "[plugins][live]")
{
    TemporaryFolder folder;
    LiveRun live (growing(), version (folder, 0, "a"));
    REQUIRE (live.run.hasEngine());
    live.tick (1000);
    CHECK (live.scale.force == Approx (1.0));

    long maps = 0, pages = 0;
    live.scale.largest_step = 0.0;
    for (int i = 1; i <= 1000; ++i)
    {
        const auto messages = live.replace (version (folder, i, "a"));
        INFO (test::text (messages));
        REQUIRE_FALSE (hasErrors (messages));
        live.tick (4);
        live.run.poll();
        if (i == 100)
        {
            maps = mappings();
            pages = residentPages();
        }
    }
    CHECK (live.scale.largest_step < 2e-3);   // N: the force grows by 1 mN per tick, and a takeover only delays that
    const int fade = static_cast<int> (Bumpless::rise_s * rate_hz);
    live.tick (fade);
    CHECK (live.scale.force == Approx (5.0 + 1e-3 * fade));   // each version continued the state of the previous one
    CHECK (mappings() <= maps + 10);                          // a version that stays loaded adds about five mappings
    CHECK (residentPages() - pages < 1024);                   // 4 MB: a version that stays loaded adds 30 pages or more
}

TEST_CASE ("a live version whose layout may differ starts from scratch, and the force follows without a step", "[plugins][live]")
{
    TemporaryFolder folder;
    LiveRun live (growing(), version (folder, 0, "a"));
    live.tick (2000);
    CHECK (live.scale.force == Approx (2.0));
    int number = 0;
    for (const auto* layout : { "b", "", "" })   // "": an unknown layout, which differs from every other
    {
        INFO (layout);
        live.scale.largest_step = 0.0;
        REQUIRE_FALSE (hasErrors (live.replace (version (folder, ++number, layout))));
        const double before = live.scale.force;
        live.tick (1);
        CHECK (live.scale.force == before);
        live.tick (1999);
        CHECK (live.scale.force == Approx (2.0));   // 2000 ticks from zero
        const double fade_ticks = Bumpless::fall_s * rate_hz;
        CHECK (live.scale.largest_step < 2.0 * std::numbers::pi / (2.0 * fade_ticks) + 2e-3);
    }
}

TEST_CASE ("a live version keeps the values that were turned, and takes those that the file changes", "[plugins][live]")
{
    TemporaryFolder folder;
    LiveRun live (growing(), version (folder, 0, "a"));
    live.tick (1000);
    REQUIRE (turnParam (live.run.engine(), "grow.slope", "3 N"));
    live.tick (1000);
    CHECK (live.scale.force == Approx (6.0));
    live.replace (version (folder, 1, "a"));
    live.tick (1000);
    CHECK (live.scale.force == Approx (9.0));

    REQUIRE (turnParam (live.run.engine(), "grow.slope", "2 N"));   // the params of the new node can be turned as well
    live.tick (1000);
    CHECK (live.scale.force == Approx (8.0));

    live.graph.root.nodes[1].params["slope"] = "1 N";   // the file had this value before, so this is not an edit
    live.replace (version (folder, 2, "a"));
    live.tick (1000);
    CHECK (live.scale.force == Approx (10.0));
    live.graph.root.nodes[1].params["slope"] = "4 N";
    live.replace (version (folder, 3, "a"));
    live.tick (1000);
    CHECK (live.scale.force == Approx (24.0));
}

TEST_CASE ("saved C code is compiled and loaded, but not with errors, or if it cannot be loaded", "[plugins][live]")
{
    TemporaryFolder folder;
    const auto code = sourceOf ("written_in_c.c");
    folder.write ("twice.c", code);
    host::LiveSource source { .file = folder / "p.tactus", .sources = { folder / "twice.c" }, .compiler = "cc" };
    host::LivePlugins live ({ source });
    CHECK_FALSE (live.poll());

    folder.write ("twice.c", replaced (code, "2.0 * v", "3.0 * v"));
    auto good = next (live);
    INFO (test::text (good.messages));
    REQUIRE (good.types.size() == 1);
    CHECK (good.types[0].origin == source.file.string());
    CHECK (good.secondsSinceSaved() > 0.0);
    const double two = 2.0;
    const double* sources[] = { &two };
    double out = 0.0;
    good.types[0].tick (good.types[0].make().get(), sources, &out);
    CHECK (out == 6.0);

    folder.write ("twice.c", replaced (code, "2.0 * v", "2.0 * w"));
    const auto bad = next (live);
    CHECK (bad.types.empty());
    REQUIRE_FALSE (bad.messages.empty());
    CHECK (bad.messages[0].id == "live/compile");
    CHECK (bad.messages[0].file == (folder / "twice.c").string());
    CHECK (bad.messages[0].line == 1 + std::count (code.begin(), code.begin() + static_cast<std::ptrdiff_t> (code.find ("2.0 * v")), '\n'));
    CHECK (bad.messages[0].text.find ("'w' undeclared") != std::string::npos);

    const auto declared = replaced (code, "static void tick", "void nowhere (void);\nstatic void tick");
    folder.write ("twice.c", replaced (declared, "(void)node;\n#ifdef BAD_NAN", "nowhere();\n#ifdef BAD_NAN"));
    const auto unloadable = next (live);
    CHECK (unloadable.types.empty());
    REQUIRE (unloadable.messages.size() == 1);
    CHECK (unloadable.messages[0].id == "plugin/cannot_load");
    CHECK (unloadable.messages[0].text.find ("nowhere") != std::string::npos);

    folder.write ("twice.c", "int x;\n");
    CHECK (next (live).messages.at (0).id == "plugin/no_entry");
    folder.write ("twice.c", code);
    CHECK (next (live).types.size() == 1);
}

TEST_CASE ("a live version without a port that is wired is refused by the graph, and the old one keeps running", "[plugins][live]")
{
    TemporaryFolder folder;
    const auto code = replaced (sourceOf ("written_in_c.c"), "\"any\", 0, 0, 0, \"1\"", "\"force\", 1, 1, -2, \"N\"");
    folder.write ("twice.c", code);
    host::LivePlugins versions ({ host::LiveSource { .file = folder / "p.tactus", .sources = { folder / "twice.c" }, .compiler = "cc" } });
    const auto save = [&] (const std::string& text) {
        folder.write ("twice.c", text);
        auto news = next (versions);
        INFO (test::text (news.messages));
        REQUIRE (news.types.size() == 1);
        return std::move (news.types);
    };
    test::Sketch sketch;
    sketch.node ("hand", "device.position").node ("wall", "deform.plane", { { "offset", "1 cm" } }).node ("twice", "c.twice").node ("motor", "device.force");
    sketch.wire ("hand.position -> wall.position").wire ("wall.force.z -> twice.in").wire ("twice.out -> motor.force.z");
    LiveRun live (sketch.graph, save (code + "\n"));
    INFO (test::text (live.first_messages));
    REQUIRE (live.run.hasEngine());
    live.tick (100);
    const double force = live.scale.force;
    CHECK (force > 0.0);

    const auto messages = live.replace (save (replaced (code, "TACTUS_PLUGIN_INPUT, \"in\"", "TACTUS_PLUGIN_INPUT, \"input\"")));
    REQUIRE (hasErrors (messages));
    CHECK (std::ranges::any_of (messages, [] (const Message& m) { return m.text.find ("'in'") != std::string::npos && ! m.remedy.empty(); }));
    live.tick (100);
    CHECK (live.scale.force == force);

    CHECK_FALSE (hasErrors (live.replace (save (replaced (code, "2.0 * v", "3.0 * v")))));
    live.scale.largest_step = 0.0;
    live.tick (static_cast<int> (Bumpless::rise_s * rate_hz) + 1);
    CHECK (live.scale.force == Approx (1.5 * force));
    CHECK (live.scale.largest_step < 0.1 * force);
}

TEST_CASE ("without a compiler, live C++ says so and what to install", "[plugins][live]")
{
    TemporaryFolder folder;
    folder.write ("a.c", "int x;\n");
    host::LivePlugins live ({ host::LiveSource { .file = folder / "p.tactus", .sources = { folder / "a.c" }, .compiler = "/no/compiler" } });
    folder.write ("a.c", "int y;\n");
    const auto news = next (live);
    REQUIRE (news.messages.size() == 1);
    CHECK (news.messages[0].id == "live/no_compiler");
    CHECK (news.messages[0].remedy.find ("install") != std::string::npos);

    host::LivePlugins in_cpp ({ host::LiveSource { .file = folder / "a.hpp", .compiler = "/no/compiler" } });
    CHECK (in_cpp.prepare().error().id == "live/no_compiler");
}

TEST_CASE ("the header of a node becomes a live version, and an edit within a function keeps its state", "[plugins][live]")
{
    TemporaryFolder folder;
    const auto code = sourceOf ("live_node.hpp");
    folder.write ("node.hpp", code);
    host::LivePlugins versions ({ host::liveHeader (folder / "node.hpp").value() });
    auto built = versions.buildHeaders();
    REQUIRE (built.size() == 1);
    INFO (test::text (built[0].messages));
    REQUIRE (built[0].types.size() == 1);
    LiveRun live (growing(), std::move (built[0].types));
    live.tick (1000);
    CHECK (live.scale.force == Approx (1.0));

    folder.write ("node.hpp", replaced (code, "ticks += 1.0;", "ticks += 2.0;"));
    auto edited = next (versions);
    INFO (test::text (edited.messages));
    REQUIRE (edited.types.size() == 1);
    live.replace (std::move (edited.types));
    live.tick (1000);
    CHECK (live.scale.force == Approx (3.0));

    folder.write ("node.hpp", replaced (code, "ticks += 1.0;", "tocks += 1.0;"));
    const auto bad = next (versions);
    CHECK (bad.types.empty());
    REQUIRE_FALSE (bad.messages.empty());
    CHECK (bad.messages[0].file == (folder / "node.hpp").string());
    CHECK (bad.messages[0].line == 1 + std::count (code.begin(), code.begin() + static_cast<std::ptrdiff_t> (code.find ("ticks += 1.0;")), '\n'));
}
