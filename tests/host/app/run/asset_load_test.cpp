// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/waiting.hpp"

#include <host/app/run/asset_load.hpp>
#include <host/app/run/job.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("what was loaded on another thread serves the next compilation, and its memory is given back", "[app][files]")
{
    const auto* file = TACTUS_SOURCE_DIR "/graphs/assets/liver.obj";
    const auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/liver.json").graph;
    CHECK (assetBytes (graph) >= static_cast<double> (std::filesystem::file_size (file)));
    Job<std::shared_ptr<const LoadedAssets>> load;
    load.start ({}, [&graph] (JobCourse&) { return loadAssets (graph, catalogue()); });
    std::optional<Result<std::shared_ptr<const LoadedAssets>>> taken;
    REQUIRE (tactus::test::eventually ([&] { return (taken = load.take()).has_value(); }));
    const auto& loaded = taken->value();
    REQUIRE (loaded->compiled.plan);

    FileAssets assets;
    const auto mesh = [&] { return *assets.mesh (file); };
    assets.adopt (loaded->assets);
    const auto shared = mesh();
    CHECK (shared.use_count() > 1);   // the plan of the other thread uses the same one
    const auto compiled = compile (graph, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } });
    REQUIRE (compiled.plan);
    CHECK (compiled.messages.size() == loaded->compiled.messages.size());
}

TEST_CASE ("the result of a job comes once; a cancelled one gives its memory back, and a stopped one still has a result", "[app]")
{
    using Text = std::shared_ptr<const std::string>;
    std::weak_ptr<const std::string> made;
    std::atomic<bool> is_made { false };
    Job<Text> job;
    CHECK_FALSE (job.isRunning());
    CHECK_FALSE (job.take());
    std::optional<Result<Text>> taken;
    const auto wait = [&] { return tactus::test::eventually ([&] { return (taken = job.take()).has_value(); }); };
    job.start ("a file", [] (JobCourse& course) {
        course.share = 0.5;
        return std::make_shared<const std::string> ("done");
    });
    CHECK (job.isRunning());
    REQUIRE (wait());
    CHECK (*taken->value() == "done");
    CHECK_FALSE (job.isRunning());
    CHECK_FALSE (job.take());

    job.start ("a file", [] (JobCourse&) -> Text { throw std::runtime_error ("broken"); });
    REQUIRE (wait());
    REQUIRE_FALSE (*taken);
    CHECK (taken->error().where == "a file");
    CHECK (taken->error().text.find ("broken") != std::string::npos);

    // Each waits to be asked to end.
    const auto begin = [&] {
        is_made = false;
        job.start ({}, [&] (JobCourse& course) {
            const auto text = std::make_shared<const std::string> ("ended");
            made = text;
            is_made = true;
            while (! course.cancelled)
                std::this_thread::yield();
            return text;
        });
        return tactus::test::eventually ([&] { return is_made.load(); });
    };
    REQUIRE (begin());
    job.stop();
    REQUIRE (wait());
    CHECK (*taken->value() == "ended");
    taken.reset();
    REQUIRE (begin());
    const auto discarded = made;
    job.cancel();
    CHECK_FALSE (job.isRunning());
    CHECK_FALSE (job.take());
    CHECK (tactus::test::eventually ([&] { return discarded.expired(); }));
    REQUIRE (begin());
    REQUIRE (begin());   // the earlier one ends
}
