// SPDX-License-Identifier: MIT
#include "framework/capi/c_handles.hpp"
#include "host/cli/program.hpp"

#include <host/base/assets/image.hpp>
#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <filesystem>
#include <optional>
#include <set>

using namespace tactus;
using namespace tactus::test;
namespace fs = std::filesystem;

namespace
{
/// Supplies the pictures that the C API cannot decode.
struct Pictures
{
    std::optional<Grid> latest {};
    int count = 0;

    static tactus_asset_answer read (void* context, tactus_asset_kind kind, const char* path, tactus_asset* to)
    {
        if (kind != TACTUS_ASSET_IMAGE) return TACTUS_ASSET_FROM_FILE;
        auto& mine = *static_cast<Pictures*> (context);
        auto decoded = host::readImage (textOf (path), path);
        if (! decoded) return TACTUS_ASSET_REFUSED;
        mine.latest = std::move (*decoded);
        ++mine.count;
        to->rows = static_cast<size_t> (mine.latest->rows);
        to->columns = static_cast<size_t> (mine.latest->columns);
        to->values = mine.latest->values.data();
        return TACTUS_ASSET_SUPPLIED;
    }
};
}   // namespace

TEST_CASE ("every preset has the bits of tactus render when it is played through the C API", "[graphs][c_api]")
{
    const Scratch scratch;
    Pictures pictures;
    std::set<std::string> silent;
    int count = 0;
    for (const auto& entry : fs::directory_iterator (fs::path (TACTUS_SOURCE_DIR) / "graphs"))
    {
        if (entry.path().extension() != ".json") continue;
        ++count;
        INFO (entry.path().filename());
        const auto path = entry.path().string(), out = scratch.path ("out.csv");
        const auto ran = runTactus ({ "render", path, "--duration", "2", "--out", out });
        INFO (ran.err);
        REQUIRE (ran.status == 0);
        const auto theirs = readTable (fs::path (out));
        REQUIRE (theirs);

        const MessageList m { tactus_messages_create() };
        const GraphHandle g { tactus_graph_load (path.c_str(), m.get()) };
        tactus_run_options options = TACTUS_RUN_OPTIONS;
        options.assets = Pictures::read;
        options.asset_context = &pictures;
        const RunHandle run { tactus_run_create (g.get(), &options, m.get()) };
        INFO (said (m));
        REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
        const auto width = tactus_run_record_count (run.get()), ticks = theirs->rows();
        REQUIRE (theirs->columns.size() == width + 1);   // the first one is t
        std::vector<double> mine (ticks * width);
        REQUIRE (tactus_run_steps (run.get(), ticks, nullptr, mine.data()) == TACTUS_OK);

        std::size_t differing = 0;
        bool is_silent = true;
        for (std::size_t i = 0; i < width; ++i)
        {
            CHECK (theirs->columns[i + 1] == tactus_run_record_name (run.get(), i));
            for (std::size_t k = 0; k < ticks; ++k)
            {
                const double v = mine[k * width + i];
                differing += std::bit_cast<std::uint64_t> (theirs->at (k, i + 1)) != std::bit_cast<std::uint64_t> (v);
                is_silent = is_silent && v == 0.0;
            }
        }
        CHECK (differing == 0);
        if (is_silent) silent.insert (entry.path().stem().string());
    }
    CHECK (count > 30);
    CHECK (pictures.count == 1);
    CHECK (silent == std::set<std::string> {});   // in each preset, the tool has touched something by then
}
