// SPDX-License-Identifier: MIT
// The walk through the chapter: its figures exist, and its commands run.

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
const std::string docs = TACTUS_SOURCE_DIR "/docs/";

std::vector<std::string> found (const std::string& text, const std::string& pattern)
{
    const std::regex expression (pattern);
    std::vector<std::string> all;
    for (std::sregex_iterator at (text.begin(), text.end(), expression), end; at != end; ++at)
        all.push_back ((*at)[1]);
    return all;
}
}   // namespace

TEST_CASE ("the pages show exactly the figures in the folder", "[figures]")
{
    std::vector<std::string> shown;
    for (const auto* page : { "chapter.md", "spectra.md" })
        std::ranges::move (found (test::textOf (docs + page), R"re(<img src="figures/(\w+\.png)")re"), std::back_inserter (shown));
    std::vector<std::string> drawn;
    for (const auto& entry : fs::directory_iterator (docs + "figures"))
        if (entry.path().extension() == ".png")
        {
            drawn.push_back (entry.path().filename().string());
            INFO (drawn.back());
            CHECK (fs::file_size (entry.path()) < 60'000);
        }
    std::ranges::sort (shown);
    std::ranges::sort (drawn);
    CHECK (shown == drawn);

    for (const auto& preset : found (test::textOf (docs + "chapter.md"), R"(\(\.\./(graphs/\w+\.json)\))"))
    {
        INFO (preset);
        CHECK (fs::exists (docs + "../" + preset));
    }
}

TEST_CASE ("the commands in the walk through the chapter record what they plot", "[figures]")
{
    // Drawing takes ten times as long as rendering, and is tested elsewhere.
    const std::regex command (R"(build/release/bin/tactus render (\S+) (.*)--record (\S+) (--over (\S+) )?--plot \w+\.png)");
    const auto lines = found (test::textOf (docs + "chapter.md"), "(build/release/bin/tactus .+)");
    REQUIRE (lines.size() >= 10);
    for (const auto& line : lines)
    {
        INFO (line);
        std::smatch part;
        REQUIRE (std::regex_match (line, part, command));

        const test::Scratch scratch;
        std::vector<std::string> arguments { "render", docs + "../" + part[1].str(), "--record", part[3], "--out", scratch.path ("out.csv") };
        std::istringstream words (part[2]);
        for (std::string word; words >> word;)
            arguments.push_back (word);
        const auto ran = test::runTactus (arguments);
        INFO (ran.err);
        CHECK (ran.status == 0);
        // Fig. 9 has four nodes, as in the chapter, and the page says that they are too few.
        if (part[1].str().ends_with ("/patch.json"))
            CHECK (ran.err.find ("the stiffness changes over fewer than three cells") != std::string::npos);
        else
            CHECK (ran.err.empty());

        const auto header = test::textOf (scratch.path ("out.csv")).substr (0, 1000);
        if (part[5].matched) CHECK (header.find (part[5].str()) != std::string::npos);
    }
}
