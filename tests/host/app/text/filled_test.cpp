// SPDX-License-Identifier: GPL-3.0-or-later
#include <support/property.hpp>

#include <host/app/storage/language.hpp>
#include <host/app/storage/settings.hpp>
#include <host/app/text/filled.hpp>

#include "support/temporary_folder.hpp"

#include <fstream>
#include <set>

using namespace tactus::host;

TEST_CASE ("a text is filled with its values in any order, each as many times as it occurs", "[app][text]")
{
    CHECK (filled ("%1 of %2", 3, "rail") == "3 of rail");
    CHECK (filled ("%2: %1", 3, std::string ("rail")) == "rail: 3");
    CHECK (filled ("press %1, or Ctrl+%1", juce::String ("4")) == "press 4, or Ctrl+4");
    CHECK (filled ("%1 % of %2", 50, "it") == "50 % of it");
    CHECK (filled ("100 %", 1) == "100 %");
    CHECK (filled ("%1 and %3", "a", "b") == "a and %3");
    CHECK (filled ("%1", "%2", "b") == "%2");   // a value is not filled again
    CHECK (filled ("") == juce::String());
    CHECK (filled ("%1", std::string_view ("\xc2\xb5m")) == juce::String::fromUTF8 ("\xc2\xb5m"));

    tactus::test::property ("each place has its value, and the rest stays", [] {
        const auto parts = *rc::gen::container<std::vector<std::string>> (rc::gen::element<std::string> ("a", "b c", "%", "50 %", "x%y", ".", ""));
        const auto values = *rc::gen::container<std::vector<std::string>> (3, rc::gen::element<std::string> ("1", "%1", "%2 %", "word", ""));
        juce::String text, expected;
        for (const auto& p : parts)
        {
            const auto n = *rc::gen::inRange<std::size_t> (0, 3);
            text << p << ' ' << '%' << juce::String (n + 1);
            expected << p << ' ' << values[n];
        }
        RC_ASSERT (filled (text, values[0], values[1], values[2]) == expected);
    });
}

TEST_CASE ("a translation in the settings folder is used, and what it lacks is in English", "[app][text]")
{
    const TemporaryFolder home;
    std::filesystem::create_directories (home / "text");
    const auto write = [&] (const std::string& name, const std::string& text) { std::ofstream (home / "text" / name) << text; };
    write ("de.txt", "language: Deutsch\n\"Save\" = \"Speichern\"\n\"%1 of %2\" = \"von %2 %1\"\n");
    write ("de-AT.txt", "\"Save\" = \"Sichern\"\n");
    write ("en.txt", "language: English\n");
    write ("notes.md", "");
    write ("..txt", "");
    using Found = std::vector<std::pair<std::string, juce::String>>;
    CHECK (translationsIn (home.path()) == Found { { "de", "Deutsch" }, { "de-AT", "de-AT" } });
    CHECK (translationsIn (home / "nowhere").empty());

    CHECK (translationFor ("de", home.path()) == home / "text" / "de.txt");
    CHECK (translationFor ("fr", home.path()).empty());
    CHECK (translationFor ("en", home.path()).empty());
    CHECK (translationFor ("../text/de", home.path()).empty());

    CHECK (languageSetIn (home.path()).empty());
    std::ofstream (home / "settings.json") << R"({"language": "de"})";
    useTranslation (translationFor (languageSetIn (home.path()), home.path()));
    CHECK (juce::translate ("Save") == "Speichern");
    CHECK (filled (juce::translate ("%1 of %2"), 1, "x") == "von x 1");
    CHECK (juce::translate ("Cancel") == "Cancel");
    useTranslation ({});
    CHECK (juce::translate ("Save") == "Save");
}

TEST_CASE ("the language is kept in the settings, and must be the name of a file", "[app][text]")
{
    Settings s;
    CHECK (readSettings (writeSettings (s)).settings.language.empty());
    s.language = "pt-BR";
    CHECK (readSettings (writeSettings (s)).settings.language == "pt-BR");
    for (const char* wrong : { R"({"language": 3})", R"({"language": "../../etc/passwd"})", R"({"language": "a b"})" })
    {
        const auto read = readSettings (wrong);
        CHECK (read.settings.language.empty());
        CHECK (read.problem == "invalid values for language");
    }
}
