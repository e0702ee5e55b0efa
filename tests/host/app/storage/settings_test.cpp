// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/storage/settings.hpp>
#include <tactus/file/text_file.hpp>

#include "support/temporary_folder.hpp"

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
Settings some()
{
    Settings s;
    s.light = true;
    s.scale = 1.5;
    s.welcomed = true;
    s.fuse = true;
    s.film_s = 30.0;
    s.panels = { { "left", 0.1875 }, { "bottom", 0.0 } };
    s.recent = { "/a/b.json", "/c.json" };
    s.favourites = { "/presets/wood.json" };
    s.folders = { { "*.jsonl", "/a/takes" } };
    s.recordings = "/a/strokes";
    s.recent_types = { "signal.lfo", "friction.elasto_plastic" };
    s.others["from a newer version"] = { 1, 2 };
    return s;
}
}   // namespace

TEST_CASE ("settings survive a round trip, including unknown keys")
{
    const auto text = writeSettings (some());
    const auto read = readSettings (text);
    CHECK (read.problem.empty());
    CHECK (read.settings.light);
    CHECK (read.settings.scale == 1.5);
    CHECK (read.settings.fuse);
    CHECK (read.settings.film_s == 30.0);
    CHECK (read.settings.panels == some().panels);
    CHECK (read.settings.recent == some().recent);
    CHECK (read.settings.favourites == some().favourites);
    CHECK (read.settings.folders == some().folders);
    CHECK (read.settings.recordings == some().recordings);
    CHECK (read.settings.recent_types == some().recent_types);
    CHECK (writeSettings (read.settings) == text);
}

TEST_CASE ("one invalid setting does not affect the others")
{
    const auto read = readSettings (R"({"theme": "purple", "scale": 2.0, "panels": {"left": -3}, "recent": ["/a.json"]})");
    CHECK (read.problem.find ("theme") != std::string::npos);
    CHECK (read.problem.find ("panels") != std::string::npos);
    CHECK (read.settings.scale == 2.0);
    CHECK (read.settings.recent == std::vector<fs::path> { "/a.json" });
    CHECK_FALSE (readSettings (R"({"scale": 1e300})").problem.empty());
}

TEST_CASE ("a truncated settings file is reported and set aside, and the defaults apply")
{
    TemporaryFolder home;
    const auto whole = writeSettings (some());
    for (std::size_t n = 0; n + 2 < whole.size(); ++n)
    {
        REQUIRE (writeTextFile (home.path() / "settings.json", whole.substr (0, n)));
        const auto read = loadSettings (home.path());
        REQUIRE_FALSE (read.problem.empty());
        REQUIRE (readTextFile (home.path() / "settings.json.broken") == whole.substr (0, n));
        REQUIRE_FALSE (fs::exists (home.path() / "settings.json"));
        REQUIRE (read.settings.scale == 0.0);
    }
    CHECK (loadSettings (home.path()).problem.empty());   // no file: the defaults
}

TEST_CASE ("a settings file with any byte changed is read safely")
{
    const auto whole = writeSettings (some());
    for (std::size_t n = 0; n < whole.size(); ++n)
    {
        auto text = whole;
        text[n] = static_cast<char> (text[n] ^ 0x11);
        const auto read = readSettings (text);
        REQUIRE ((read.settings.scale == 0.0 || (read.settings.scale >= 0.5 && read.settings.scale <= 4.0)));
        REQUIRE (read.settings.recent.size() <= Settings::most_recent);
    }
}

TEST_CASE ("the latest file comes first in the recent files, without duplicates, and the oldest ones drop out")
{
    Settings s;
    for (int i = 0; i < 20; ++i)
        s.noteRecent (std::to_string (i) + ".json");
    s.noteRecent ("15.json");
    CHECK (s.recent.size() == Settings::most_recent);
    CHECK (s.recent.front() == "15.json");
    CHECK (std::ranges::count (s.recent, "15.json") == 1);
    CHECK (s.recent.back() == "8.json");
}

TEST_CASE ("a favourite is toggled on and off")
{
    Settings s;
    s.toggleFavourite ("a.json");
    CHECK (s.isFavourite ("a.json"));
    s.toggleFavourite ("a.json");
    CHECK_FALSE (s.isFavourite ("a.json"));
}

TEST_CASE ("the user interface is scaled up on displays with more pixels")
{
    CHECK (automaticScale (720) == 1.0);
    CHECK (automaticScale (1080) == 1.0);
    CHECK (automaticScale (1440) == 1.25);
    CHECK (automaticScale (2160) == 2.0);
}
