// SPDX-License-Identifier: MIT
// Plugins that must not get into a catalogue, and the messages about them.
#include "load.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <thread>

using namespace tactus;
using test::load;

namespace
{
/// The one error about a plugin.
Message errorOf (const std::string& plugin, const Catalogue& present = {})
{
    const auto loaded = load (plugin, present);
    CHECK (loaded.types.empty());
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].where == test::pluginFile (plugin).string());
    CHECK_FALSE (loaded.messages[0].remedy.empty());
    return loaded.messages[0];
}
}   // namespace

TEST_CASE ("a plugin for another interface, or without an entry, is refused by name", "[plugins]")
{
    CHECK (errorOf ("bad_abi").id == "plugin/wrong_abi");
    CHECK (errorOf ("bad_size").id == "plugin/wrong_size");
    CHECK (errorOf ("bad_no_entry").id == "plugin/no_entry");
    CHECK (errorOf ("does_not_exist").id == "plugin/cannot_load");
}

TEST_CASE ("a plugin that refuses to start is refused with its reason", "[plugins]")
{
    const auto error = errorOf ("bad_init");
    CHECK (error.id == "plugin/init_failed");
    CHECK (error.text.find ("no licence") != std::string::npos);
}

TEST_CASE ("a plugin whose datasheet is wrong is refused, and the row is named", "[plugins]")
{
    const auto textOf = [] (const std::string& plugin) {
        const auto error = errorOf (plugin);
        CHECK (error.id == "plugin/bad_node");
        return error.text;
    };
    CHECK (textOf ("bad_node_size").find ("size") != std::string::npos);
    CHECK (textOf ("bad_no_tick").find ("lacks the function 'tick'") != std::string::npos);
    CHECK (textOf ("bad_no_restore").find ("save, but no restore") != std::string::npos);
    CHECK (textOf ("bad_offset").find ("'out': it lies outside of its struct of 8 bytes") != std::string::npos);
    CHECK (textOf ("bad_id").find ("family.name") != std::string::npos);
}

TEST_CASE ("two plugins with one id are refused by name", "[plugins]")
{
    const auto error = errorOf ("grown", Catalogue { load ("in_c").types });
    CHECK (error.id == "plugin/two_ids");
    CHECK (error.text.find ("c.twice") != std::string::npos);
    CHECK (error.text.find ("in_c.tactus") != std::string::npos);

    const auto both = loadPlugins ({ test::pluginFile ("in_c"), test::pluginFile ("grown") }, {});
    CHECK (both.types.size() == 1);
    REQUIRE (both.messages.size() == 1);
    CHECK (both.messages[0].id == "plugin/two_ids");

    const auto built_in = loadPlugins ({ test::pluginFile ("five_nodes") }, catalogue());
    CHECK (built_in.types.empty());
    CHECK (built_in.messages.size() == 5);
}

TEST_CASE ("an exception in a hook of a plugin is an error of the graph", "[plugins]")
{
    const Catalogue types { load ("throwing").types };
    for (const std::string hook : { "cost", "problem", "warning", "prepare", "prepare int" })
    {
        INFO (hook);
        const auto sketch = test::Sketch {}.node ("node", "bad.throwing", Json::object(), { { "hook", hook } });
        const auto made = compile (sketch.graph, types);
        CHECK (made.plan == nullptr);
        REQUIRE (made.messages.size() == 1);
        CHECK (made.messages[0].id == "plugin/failed");
        CHECK (made.messages[0].text.find ("bad.throwing") != std::string::npos);
        CHECK (made.messages[0].text.find (hook.ends_with ("int") ? "an unknown exception" : "thrown in " + hook) != std::string::npos);
    }
}

TEST_CASE ("graphs that are compiled on two threads never call a plugin at the same time", "[plugins]")
{
    const Catalogue types { load ("alone").types };
    const auto sketch = test::Sketch {}.node ("node", "c.twice");
    std::atomic<int> refused = 0;
    const auto compileOften = [&] {
        for (int i = 0; i < 50; ++i)
            if (compile (sketch.graph, types).plan == nullptr) ++refused;
    };
    std::thread other (compileOften);
    compileOften();
    other.join();
    CHECK (refused == 0);
}
