// SPDX-License-Identifier: MIT
#include "pseudo.hpp"

#include <host/app/model/node_doc.hpp>
#include <host/app/model/readable.hpp>

#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/gestures.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <cmath>
#include <regex>

namespace tactus::host::test
{

namespace
{
constexpr const char* mark = "~";

juce::File sourceFile (const char* path) { return juce::File (TACTUS_SOURCE_DIR).getChildFile (path); }

juce::String str (std::string_view s) { return juce::String::fromUTF8 (s.data(), static_cast<int> (s.size())); }

bool hasLetters (const juce::String& s, int in_a_row)
{
    int letters = 0;
    for (auto c = s.getCharPointer(); ! c.isEmpty(); ++c)
    {
        letters = c.isLetter() ? letters + 1 : 0;
        if (letters == in_a_row) return true;
    }
    return false;
}

/// "0.3", "N/mm", "drag.force.x", "stored_energy", "graphs/dry_wood.json"
bool isNumberOrId (const juce::String& word)
{
    static const std::regex number (R"(\W*[\d.,+-]*(e[+-]\d+)?(k|m|\xc2\xb5|n|M)?(N|m|s|g|Hz|J|W|Pa|rad|dB|min|x)?([/*^][\w/*^]+)?\W*|[xyz])");
    static const std::regex id (R"(\W*\w+(\.\w+|\[\d+\]|/\w+|_\w+)+(\[|=).*|\W*\w*(\.\w+|\[\d+\]|/[\w.-]+|_\w*)+\W*)");
    const auto text = word.toStdString();
    return std::regex_match (text, number) || std::regex_match (text, id);
}

void addStrings (const Json& json, Data& data)
{
    if (json.is_string()) data.add (str (json.asString()));
    if (json.is_object())
        for (const auto& [key, value] : json.items())
        {
            data.add (str (key));
            addStrings (value, data);
            if (! value.is_object()) continue;
            for (const auto& [inner, ignored] : value.items())
                data.add (str (key) + " " + str (inner));
        }
    if (! json.is_array()) return;
    juce::StringArray list;   // as the window shows tags
    for (const auto& value : json)
    {
        addStrings (value, data);
        if (value.is_string()) list.add (str (value.asString()));
    }
    data.add (list.joinIntoString (", "));
}

void addSheet (std::string_view id, std::string_view about, Data& data)
{
    data.add (str (nameWithId (id)));
    data.add (str (about));
    data.add (str (readable (id)));
    data.add (str (id));
}

void addSettings (const std::vector<SettingSheet>& settings, Data& data)
{
    for (const auto& s : settings)
    {
        addSheet (s.id, s.about, data);
        data.add (str (name (s.kind)));
        addSettings (s.fields, data);
    }
}
}   // namespace

std::vector<juce::String> templateTexts()
{
    juce::StringArray lines;
    sourceFile ("host/app/text/en.txt").readLines (lines);
    std::vector<juce::String> all;
    for (const auto& line : lines)
        if (line.startsWithChar ('"')) all.push_back (line.substring (1, line.indexOf ("\" = \"")).replace ("\\\"", "\""));
    return all;
}

juce::String pseudoTranslation()
{
    juce::String all ("language: Pseudo\n");
    for (const auto& text : templateTexts())
    {
        auto words = juce::StringArray::fromTokens (text, " ", {});
        for (auto& w : words)
            if (hasLetters (w, 1)) w << juce::String::repeatedString (mark, static_cast<int> (std::ceil (0.3 * w.length())));
        const auto quoted = [] (const juce::String& s) { return "\"" + s.replace ("\"", "\\\"") + "\""; };
        all << quoted (text) << " = " << quoted (words.joinIntoString (" ")) << "\n";
    }
    return all;
}

Data::Data()
{
    for (const auto& type : catalogue())
    {
        for (const auto text : { type.info.id, type.info.name, type.info.summary, type.info.source, type.info.keywords })
            add (str (text));
        add (str (type.info.id.substr (0, type.info.id.find ('.'))));
        for (const auto* ports : { &type.inputs, &type.params, &type.outputs })
            for (const auto& p : *ports)
            {
                addSheet (p.id, p.about, *this);
                juce::StringArray choices;
                for (const auto choice : p.choices)
                    choices.add (str (choice));
                add (choices.joinIntoString (", "));
            }
        addSettings (type.settings, *this);
        for (const auto& part : docOf (type.info.id))
            add (str (part.text));
    }
    for (const auto& file : sourceFile ("graphs").findChildFiles (juce::File::findFiles, false, "*.json"))
    {
        addStrings (Json::tryParse (file.loadFileAsString().toStdString()).value_or (Json()), *this);
        add (file.getFileNameWithoutExtension());
    }
    for (const auto& file : sourceFile ("host/profiles").findChildFiles (juce::File::findFiles, false, "*.json"))
        addStrings (Json::tryParse (file.loadFileAsString().toStdString()).value_or (Json()), *this);
    for (const auto& g : gestures())
        add ("in a hand that follows " + str (g.id));
}

void Data::add (const juce::String& s)
{
    juce::StringArray lines;
    lines.addLines (s.toLowerCase());
    for (const auto& line : lines)
        all << '\n'
            << juce::StringArray::fromTokens (line, " \t", {}).joinIntoString (" ");
}

bool Data::has (const juce::String& words) const
{
    if (all.contains (words.toLowerCase())) return true;
    for (const char* between : { ":", ";", "," })
    {
        const auto items = juce::StringArray::fromTokens (words, between, {});
        if (items.size() > 1 && std::ranges::all_of (items, [this] (const juce::String& i) { return ! hasLetters (i, 2) || has (i.trim()); })) return true;
    }
    return false;
}

juce::String Data::wordsLeft (const juce::String& text) const
{
    const auto around = juce::String::fromUTF8 ("'\"`()[]{}.,:;!?|+-=\xe2\x80\xa6\xe2\x80\x93\xe2\x86\x92");
    juce::StringArray lines;
    lines.addLines (text);
    for (const auto& line : lines)
    {
        juce::StringArray phrase;
        auto words = juce::StringArray::fromTokens (line, " \t", {});
        if (line.endsWith ("...")) words.remove (words.size() - 1);   // a part of a word
        words.add (mark);                                             // ends the last phrase
        for (const auto& w : words)
        {
            if (! w.contains (mark) && ! isNumberOrId (w))
            {
                phrase.add (w);
                continue;
            }
            const auto left = phrase.joinIntoString (" ").trimCharactersAtStart (around).trimCharactersAtEnd (around).trim().trimCharactersAtEnd (around);
            phrase.clear();
            if (hasLetters (left, 2) && ! has (left)) return left;
        }
    }
    return {};
}

}   // namespace tactus::host::test
