// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/canvas/commands.hpp>
#include <host/app/look/key_text.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

using namespace tactus::host;
namespace fs = std::filesystem;

TEST_CASE ("keys are written in one way: Ctrl+S, Shift+Esc, Space", "[app][keys]")
{
    CHECK (keyText ("ctrl + z") == "Ctrl+Z");
    CHECK (keyText ("ctrl + shift + z") == "Ctrl+Shift+Z");
    CHECK (keyText ("alt + shift + cursor right") == "Alt+Shift+Right");
    CHECK (keyText ("spacebar") == "Space");
    CHECK (keyText ("return") == "Enter");
    CHECK (keyText ("shift + F10") == "Shift+F10");
    CHECK (keyText ("+") == "+");
    const std::regex one ("((Ctrl|Alt|Shift)\\+)*([A-Z]|[-+=0]|\\[|\\]|Space|Tab|Enter|Delete|Backspace|Home|Left|Right|Up|Down|F[0-9]{1,2})");
    for (const auto& c : canvasCommands())
        for (const auto& keys : juce::StringArray::fromTokens (c.keys, "|", {}))
        {
            INFO (c.name << ": " << keyText (keys));
            CHECK (std::regex_match (keyText (keys).toStdString(), one));
        }
}

TEST_CASE ("no text of the window writes a key in another way", "[app][keys]")
{
    const std::regex literal ("\"(\\\\.|[^\"\\\\\\n])*\""), other ("\\b(Shift|Ctrl|Alt)-[a-zA-Z]|\\bEscape\\b|\\bhold shift\\b|\\bctrl\\+");
    std::size_t texts = 0;
    for (const auto& entry : fs::recursive_directory_iterator (TACTUS_SOURCE_DIR "/host/app"))
    {
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
        std::stringstream all;
        all << std::ifstream (entry.path()).rdbuf();
        const auto source = all.str();
        for (auto at = std::sregex_iterator (source.begin(), source.end(), literal); at != std::sregex_iterator(); ++at, ++texts)
            if (const auto text = at->str(); std::regex_search (text, other)) FAIL_CHECK (entry.path() << ": " << text);
    }
    CHECK (texts > 1000);
}
