// SPDX-License-Identifier: MIT
// `tactus check-plugin` catches bad plugins, and says what is wrong.
#include "load.hpp"

#include <catch2/catch.hpp>

#include <host/cli/program.hpp>
#include <tactus/text/json.hpp>

#include <sys/resource.h>

using namespace tactus;

namespace
{
struct Checked
{
    int status;
    Json report;
};

Checked check (const std::string& plugin, std::vector<std::string> more = { "--strict", "1" })
{
    std::vector<std::string> words { "check-plugin", test::pluginFile (plugin).string(), "--json" };
    words.insert (words.end(), more.begin(), more.end());
    const auto ran = test::runTactus (words);
    INFO (ran.err);
    return { ran.status, Json::parse (ran.out) };
}

/// The CPU time of all processes that have ended.
double cpuSecondsOfChildren()
{
    rusage used {};
    ::getrusage (RUSAGE_CHILDREN, &used);
    const auto seconds = [] (const timeval& t) { return static_cast<double> (t.tv_sec) + 1e-6 * static_cast<double> (t.tv_usec); };
    return seconds (used.ru_utime) + seconds (used.ru_stime);
}

/// A line "id: why" for each examination that failed.
std::string failuresOf (const Json& report)
{
    std::string all;
    const auto add = [&] (const Json& examinations) {
        for (const auto& e : examinations)
            if (e["result"] == "FAIL") all += e["id"].get<std::string>() + ": " + e["why"].get<std::string>() + "\n";
    };
    add (report["examinations"]);
    for (const auto& node : report["nodes"])
        add (node["examinations"]);
    return all;
}

/// Checks that the plugin fails, and that the failures contain these words.
void catches (const std::string& plugin, const std::vector<std::string>& words, const std::vector<std::string>& more = { "--strict", "1" })
{
    INFO (plugin);
    const auto checked = check (plugin, more);
    CHECK (checked.status == 1);
    const auto failures = failuresOf (checked.report);
    INFO (failures);
    for (const auto& word : words)
        CHECK (failures.find (word) != std::string::npos);
}
}   // namespace

TEST_CASE ("check-plugin passes a plugin that keeps all promises", "[plugins]")
{
    const auto checked = check ("in_c", { "--strict", "3" });
    CHECK (failuresOf (checked.report) == "");
    CHECK (checked.status == 0);
    CHECK (checked.report["name"] == "in C");
    CHECK (checked.report["abi"] == 1);
    CHECK (checked.report["seed"] == 1);
    REQUIRE (checked.report["nodes"].size() == 1);
    const auto& node = checked.report["nodes"][0];
    CHECK (node["id"] == "c.twice");
    CHECK (node["ns_per_tick"].get<double>() > 0.0);
    CHECK (node["examinations"].size() > 12);
    for (const auto& e : node["examinations"])
        CHECK ((e["result"] == "PASS" || ! e["why"].get<std::string>().empty()));
}

TEST_CASE ("check-plugin names what keeps a plugin from being loaded", "[plugins]")
{
    catches ("bad_abi", { "plugin/wrong_abi", "version 99" });
    catches ("bad_no_entry", { "plugin/no_entry" });
    catches ("bad_size", { "plugin/wrong_size" });
    catches ("bad_node_size", { "plugin/bad_node", "size" });
    catches ("bad_offset", { "plugin/bad_node", "'out': it lies outside of its struct" });
    catches ("bad_two_ids", { "plugin/two_ids", "c.twice" });
    catches ("crashing", { "load: `loading`", "exit status 77" });
    catches ("does_not_exist", { "plugin/cannot_load" });
}

TEST_CASE ("check-plugin names the hook that throws", "[plugins]")
{
    catches ("throwing_always", { "hooks: ", "thrown in cost", "thrown in problem", "thrown in warning", "thrown in prepare", "thrown in claims",
                                  "`tick` of bad.in_tick: the program was ended by signal 6" });
}

TEST_CASE ("check-plugin catches what a tick must not do", "[plugins]")
{
    catches ("bad_crash", { "finite: `tick` of c.twice: the program was ended by signal 11" });
    catches ("bad_allocates", { "allocations: a tick allocates or frees memory 2 times" });
    catches ("bad_locks", { "locks: a tick locks a mutex" });
    catches ("bad_calls", { "system_calls: a tick calls the operating system: `getppid`" });
    catches ("bad_nan", { "finite: out is ", "(seed " });
    catches ("bad_overrun", { "sizes: it writes past the end of its outputs" });
}

TEST_CASE ("check-plugin catches bits that depend on the run or on another instance", "[plugins]")
{
    catches ("bad_bits", { "runs: two processes give different bits" });
    catches ("bad_static", { "instances: two instances" });
}

TEST_CASE ("check-plugin catches a state that is not restored", "[plugins]")
{
    catches ("bad_state", { "state: tick 1 after a state was restored gives other bits" }, { "--strict", "2" });
    CHECK (check ("saves", { "--strict", "3" }).status == 0);
}

TEST_CASE ("check-plugin catches a false claim, and its seed repeats the failure", "[plugins]")
{
    const auto first = failuresOf (check ("bad_claim").report);
    INFO (first);
    const std::string mark = "(seed ";
    const auto at = first.find (mark);
    REQUIRE (first.starts_with ("amplitude: out is "));
    REQUIRE (at != std::string::npos);
    const auto seed = std::to_string (std::stoi (first.substr (at + mark.size())));
    const auto again = check ("bad_claim", { "--strict", "1", "--seed", seed });
    CHECK (failuresOf (again.report) == first);
}

TEST_CASE ("check-plugin kills a function that never returns, and names it and its node", "[plugins]")
{
    const auto checked = check ("bad_endless", { "--strict", "1", "--cpu-seconds", "1" });
    CHECK (checked.status == 1);
    CHECK (failuresOf (checked.report) == "hooks: `prepare` of c.twice: did not return within 1 s of CPU time\n");
}

TEST_CASE ("a node whose tick loops for some inputs costs check-plugin less than 10 s of CPU time", "[plugins]")
{
    const auto before = cpuSecondsOfChildren();
    const auto checked = check ("bad_endless_tick");
    CHECK (cpuSecondsOfChildren() - before < 10.0);
    CHECK (checked.status == 1);
    CHECK (failuresOf (checked.report) == "finite: `tick` of c.twice: did not return within 5 s of CPU time\n");
    const auto& last = checked.report["nodes"][0]["examinations"].back();
    CHECK (last["result"] == "SKIPPED");
    CHECK (last["why"] == "the node did not finish in `finite`");
}
