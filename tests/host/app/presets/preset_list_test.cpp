// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/presets/force_picture.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/base/platform/home_folder.hpp>

#include "support/temporary_folder.hpp"

using namespace tactus;
using namespace tactus::host;

namespace
{
const std::filesystem::path graphs = TACTUS_SOURCE_DIR "/graphs";
const std::atomic<bool> not_cancelled { false };

std::vector<Preset> some()
{
    return { { "a.json", "Dry wood", "It catches and lets go.", { "wood", "stroke" }, {}, {}, {} },
             { "b.json", "Oak", "A nail across the grain.", { "wood", "rough" }, {}, {}, {} },
             { "c.json", "Gel", "Soft WOOD glue.", { "press" }, {}, {}, {} } };
}
}   // namespace

TEST_CASE ("presets are found by words of their name, tags and description, ignoring case")
{
    CHECK (matching (some(), "wood").size() == 3);
    CHECK (matching (some(), "Wood grain").size() == 1);
    CHECK (matching (some(), "  ").size() == 3);
    CHECK (matching (some(), "steel").empty());
}

TEST_CASE ("own graphs are in the documents of the user, and settings in the configurations, where XDG says they are")
{
    const TemporaryFolder home;
    const auto isFor = [&] (std::initializer_list<std::pair<const char*, std::string>> variables, const std::filesystem::path& graphs,
                            const std::string& settings) {
        std::vector<std::pair<const char*, std::string>> before;
        for (const auto* name : { "HOME", "TACTUS_HOME", "TACTUS_GRAPHS", "XDG_CONFIG_HOME", "XDG_DOCUMENTS_DIR" })
        {
            if (const auto* old = std::getenv (name)) before.emplace_back (name, old);
            unsetenv (name);
        }
        setenv ("HOME", home.path().c_str(), 1);
        for (const auto& [name, value] : variables)
            setenv (name, value.c_str(), 1);
        CHECK (ownFolder() == graphs);
        CHECK (homeFolder() == std::filesystem::path (settings));
        for (const auto& [name, value] : variables)
            unsetenv (name);
        for (const auto& [name, value] : before)
            setenv (name, value.c_str(), 1);
    };
    const auto usual = (home / ".config/Tactus").string();
    isFor ({}, home / "Documents/Tactus", usual);
    isFor ({ { "XDG_DOCUMENTS_DIR", "/srv/papers" } }, "/srv/papers/Tactus", usual);
    isFor ({ { "XDG_CONFIG_HOME", "relative" } }, home / "Documents/Tactus", usual);   // is ignored, as the standard says
    std::filesystem::create_directories (home / ".config");
    home.write (".config/user-dirs.dirs", "# of this user\nXDG_MUSIC_DIR=\"$HOME/Music\"\nXDG_DOCUMENTS_DIR=\"$HOME/Dokumente\"\n");
    isFor ({}, home / "Dokumente/Tactus", usual);
    std::filesystem::create_directories (home / "etc");
    home.write ("etc/user-dirs.dirs", "XDG_DOCUMENTS_DIR=\"/srv/shared\"\n");
    isFor ({ { "XDG_CONFIG_HOME", (home / "etc").string() } }, "/srv/shared/Tactus", (home / "etc/Tactus").string());
    isFor ({ { "TACTUS_GRAPHS", "/elsewhere" }, { "TACTUS_HOME", (home / "own").string() } }, "/elsewhere", (home / "own").string());
}

TEST_CASE ("each tag narrows the search")
{
    CHECK (matching (some(), "", { "wood" }).size() == 2);
    CHECK (matching (some(), "", { "wood", "rough" }).size() == 1);
    CHECK (matching (some(), "catches", { "rough" }).empty());
}

TEST_CASE ("tags are sorted by the number of presets, and each preset counts once")
{
    auto presets = some();
    presets[2].tags = { "press", "press" };
    const auto tags = tagsOf (presets);
    CHECK (tags.front() == std::pair<std::string, int> { "wood", 2 });
    CHECK (std::ranges::find (tags, "press", &std::pair<std::string, int>::first)->second == 1);
}

TEST_CASE ("all shipped presets can be read and have no placeholders")
{
    const auto presets = presetsIn (graphs, catalogue());
    CHECK (presets.size() >= 30);
    for (const auto& p : presets)
    {
        INFO (p.name);
        CHECK (p.problem.empty());
        CHECK (p.placeholders.empty());
        CHECK_FALSE (p.about.empty());
        CHECK_FALSE (p.tags.empty());
    }
}

TEST_CASE ("damaged graphs of a folder are listed with their problem, other files are skipped")
{
    TemporaryFolder folder;
    folder.write ("torn.json", R"({"format": "tactus-graph", "version": 1, "nodes": {)");
    folder.write ("other.json", R"({"colour": "blue"})");
    folder.write ("strange.json", R"({"format": "tactus-graph", "version": 1, "name": "Strange",
        "nodes": {"a": {"type": "foo.bar"}, "b": {"type": "foo.baz"}, "c": {"type": "signal.gain"}}, "wires": []})");
    const auto presets = presetsIn (folder.path(), catalogue());
    REQUIRE (presets.size() == 2);
    CHECK (placeholderText (presets[0]) == "2 placeholders: foo.bar, foo.baz");
    CHECK (presets[1].name == "torn");
    CHECK_FALSE (presets[1].problem.empty());
    CHECK (presetsIn (folder / "nowhere", catalogue()).empty());
}

TEST_CASE ("the force picture has the peak force of the preset")
{
    const auto wood = pictureOf (graphs / "dry_wood.json", catalogue(), not_cancelled);
    CHECK (wood.problem.empty());
    REQUIRE (wood.peaks.size() == ForcePicture::columns);
    CHECK (wood.peak > 0.5);
    CHECK (wood.peak < 6.0);              // the guard's limit
    CHECK (wood.peaks.front() == 0.0f);   // the gesture begins above the board
    CHECK (wood.unit == std::string ("N"));
    CHECK (pictureOf (graphs / "dry_wood.json", catalogue(), not_cancelled).peaks == wood.peaks);   // deterministic
}

TEST_CASE ("a force picture that cannot be computed says why")
{
    TemporaryFolder folder;
    folder.write ("still.json", R"({"format": "tactus-graph", "version": 1, "nodes": {"m": {"type": "device.force", "role": "pen"}}, "wires": []})");
    CHECK (pictureOf (folder / "still.json", catalogue(), not_cancelled).problem == "no preview: the hand does not move by itself");
    CHECK_FALSE (pictureOf (folder / "nowhere.json", catalogue(), not_cancelled).problem.empty());
    const std::atomic<bool> cancelled { true };
    CHECK (pictureOf (graphs / "dry_wood.json", catalogue(), cancelled).problem == "cancelled");
}

TEST_CASE ("the picture of a preset shows its material under the tool, in both themes", "[app][presets]")
{
    const auto wood = pictureOf (graphs / "dry_wood.json", catalogue(), not_cancelled).material;
    REQUIRE_FALSE (wood.isEmpty());
    CHECK (wood.dark.getWidth() == MaterialPicture::width);
    const auto isSame = [] (const juce::Image& a, const juce::Image& b) {
        for (int y = 0; y < a.getHeight(); ++y)
            for (int x = 0; x < a.getWidth(); ++x)
                if (a.getPixelAt (x, y) != b.getPixelAt (x, y)) return false;
        return true;
    };
    CHECK_FALSE (isSame (wood.dark, wood.light));
    CHECK_FALSE (isSame (wood.dark, pictureOf (graphs / "soft_pad.json", catalogue(), not_cancelled).material.dark));
    CHECK (materialOf ({}, {}).isEmpty());
}
