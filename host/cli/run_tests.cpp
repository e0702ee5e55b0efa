// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_each.hpp"
#include "commands.hpp"
#include "run_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/tools/fitting/surface_preset.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/log/run_test.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

namespace tactus::host
{

namespace
{
struct TestOptions
{
    std::vector<std::string> files;
    std::string graph;
};

std::string secondsAt (std::uint64_t tick, double rate_hz) { return roundedText (static_cast<double> (tick) / rate_hz, 6) + " s"; }

/// Prints each port that differs, with its first difference.
void printDifferences (const RunTestResult& result)
{
    constexpr std::size_t most = 20;
    for (const auto& d : std::span (result.differences).first (std::min (most, result.differences.size())))
        std::cout << "  " << printableName (d.port) << ": first at tick " << d.tick << " (" << secondsAt (d.tick, result.rate_hz) << "): expected "
                  << numberText (d.expected) << ", found " << numberText (d.found) << "; " << d.ticks << " of " << result.ticks << " ticks differ\n";
    if (result.differences.size() > most) std::cout << "  and " << result.differences.size() - most << " more values\n";
    if (result.ended)
        std::cout << "  the run ended at tick " << *result.ended << " (" << secondsAt (*result.ended, result.rate_hz) << "), before the test did\n";
}

/// Replays one test. Returns true if all bits are the same.
bool passes (const std::string& file, const RunTestOptions& options)
{
    const auto result = playRunTest (file, options);
    if (! result)
    {
        const auto& e = result.error();
        std::cout << std::flush;
        std::cerr << inOneLine (e.where.empty() ? file : e.where) << ": error: " << inOneLine (e.text) << "\n    " << inOneLine (e.remedy) << " [" << e.id
                  << "]\n";
        return false;
    }
    std::cout << printableName (file) << (result->isSame() ? ": same" : ": DIFFERENT") << ", " << result->ticks << " ticks of " << result->ports
              << (result->ports == 1 ? " value" : " values") << ", " << printableName (result->graph) << "\n";
    if (result->isSame()) return true;
    printDifferences (*result);
    std::cout << std::flush;
    for (const auto& m : result->warnings)
        warn (m.where.empty() ? file : m.where, m);
    return false;
}

void run (const TestOptions& options)
{
    std::optional<LoadedGraph> own;
    FileAssets assets;
    RunTestOptions how { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes }, .program = TACTUS_VERSION };
    if (! options.graph.empty())
    {
        own = loadGraph (options.graph);
        if (report (own->messages, *own, options.graph) > 0) throw Stop {};
        how.graph = &own->graph;
    }
    checkEach (options.files, "tests pass", [&] (const std::string& file) { return passes (file, how); });
}
}   // namespace

void addTest (const Command& app)
{
    const auto options = std::make_shared<TestOptions>();
    const auto command = app.add ("test", "Replay tests of runs, and report each port whose bits differ, with its first tick");
    command.addOption ("files", options->files, "Tests that `tactus capture --test` wrote").required();
    command.addOption ("--graph", options->graph, "Test this graph instead of the one in the test, to see whether an edit changes the bits");
    addLimits (command);
    addPlugins (command);
    command.footer ("The exit status is 1 if a test fails. See docs/replay.md.\n\n"
                    "Examples:\n"
                    "  tactus test wood_test.jsonl\n"
                    "  tactus test tests/*.jsonl\n"
                    "  tactus test wood_test.jsonl --graph graphs/dry_wood.json");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
