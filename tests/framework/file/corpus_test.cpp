// SPDX-License-Identifier: MIT
// What fuzzing has found worth keeping, replayed in every test run.
#include <tests/fuzz/graph_target.hpp>
#include <tests/fuzz/units_target.hpp>

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace tactus;

namespace
{
/// Each file of a corpus through a function that aborts when it finds something. Returns how many there were.
int replay (const std::string& name, void (*target) (std::string_view))
{
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator (std::filesystem::path (TACTUS_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / name))
    {
        std::ostringstream text;
        text << std::ifstream (entry.path(), std::ios::binary).rdbuf();
        target (text.str());
        ++files;
    }
    return files;
}
}   // namespace

TEST_CASE ("every text of the units corpus is read or refused") { CHECK (replay ("units", fuzz::tryUnits) > 20); }
TEST_CASE ("every text of the graph corpus is stable or refused") { CHECK (replay ("graph", fuzz::tryGraph) > 20); }
