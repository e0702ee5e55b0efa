// SPDX-License-Identifier: MIT
#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/plan/prepared_shelf.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>

using namespace tactus;

namespace
{
/// A shelf that counts what is asked for and what is put on it.
class CountingShelf final : public PreparedData
{
public:
    int asked = 0, put = 0;

    std::shared_ptr<const void> find (const Key& key) override
    {
        ++asked;
        return plan::preparedOfAll().find (key);
    }
    void keep (const Key& key, const std::shared_ptr<const void>& data, Until until) override
    {
        ++put;
        plan::preparedOfAll().keep (key, data, until);
    }
};
}   // namespace

TEST_CASE ("plans of the same preset share their surfaces and height maps", "[plan][prepared]")
{
    for (const auto* preset : { "liver", "nodule_under_skin", "padded_bench", "pebbled_leather" })
    {
        INFO (preset);
        const auto file = std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs" / (std::string (preset) + ".json");
        const auto graph = loadGraph (file).graph;
        host::FileAssets assets;
        CountingShelf shelf;
        const auto compiled = [&] { return compile (graph, catalogue(), { .assets = &assets, .services = { .prepared = &shelf } }).plan; };
        const auto first = compiled();
        REQUIRE (first);
        CHECK (shelf.put > 0);
        const int put = shelf.put, asked = shelf.asked;
        const auto second = compiled();
        CHECK (shelf.put == put);
        CHECK (shelf.asked == 2 * asked);
    }
}
