// SPDX-License-Identifier: GPL-3.0-or-later
#include "translated.hpp"
#include "filled.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

namespace
{
using Values = std::vector<std::string_view>;

/// An entry of a translation. Its pattern is cut at %1, %2 and so on.
struct Phrase
{
    std::vector<std::string> fixed { {} };
    juce::String translation;
    std::ptrdiff_t letters = 0;                     ///< in the fixed texts
    bool continues = false, is_continued = false;   ///< part of a longer sentence, so that a text may precede or follow it

    /// Empty if the values of the pattern do not come in order.
    static std::optional<Phrase> from (const std::string& pattern, const juce::String& to)
    {
        Phrase p;
        p.translation = to;
        for (std::size_t i = 0; i < pattern.size(); ++i)
        {
            const bool is_value = pattern[i] == '%' && i + 1 < pattern.size() && pattern[i + 1] >= '1' && pattern[i + 1] <= '9';
            if (! is_value)
                p.fixed.back() += pattern[i];
            else if (static_cast<std::size_t> (pattern[++i] - '0') == p.fixed.size())
                p.fixed.emplace_back();
            else
                return {};
        }
        for (const auto& f : p.fixed)
            p.letters += std::ranges::count_if (f, [] (unsigned char c) { return std::isalpha (c) != 0; });
        if (pattern.empty()) return {};
        p.continues = std::string_view (" ,;").find (pattern.front()) != std::string_view::npos;
        p.is_continued = pattern.back() == ' ';
        return p;
    }

    /// What precedes the pattern, the values, and what follows it. Empty if the pattern has not made this text.
    std::optional<Values> match (std::string_view text) const
    {
        Values found;
        std::size_t from = 0;
        for (std::size_t i = 0; i < fixed.size(); ++i)
        {
            const bool at_start = i == 0 && ! continues, at_end = i + 1 == fixed.size() && ! is_continued;
            const auto& f = fixed[i];
            auto at = at_start ? (text.starts_with (f) ? 0 : text.npos) : text.find (f, from);
            if (at_end)
                at = text.ends_with (f) && text.size() - f.size() >= from && (! at_start || text.size() == f.size()) ? text.size() - f.size() : text.npos;
            if (at == text.npos) return {};
            found.push_back (text.substr (from, at - from));
            from = at + f.size();
        }
        found.push_back (text.substr (from));
        return found;
    }

    /// `value` counts from 1, as in the pattern.
    bool isQuoted (std::size_t value) const
    {
        const auto& before = fixed[value - 1];
        const auto& after = fixed[value];
        return ! before.empty() && ! after.empty() && before.back() == after.front() && (after.front() == '\'' || after.front() == '"');
    }
};

using Phrases = std::vector<Phrase>;

std::mutex phrases_lock;
std::shared_ptr<const Phrases> phrases_in_use;

Phrases phrasesOf (const juce::LocalisedStrings& texts)
{
    constexpr int least = 4;   // letters of a phrase with values: "%1 of %2" would fit too many sentences
    Phrases all;
    const auto& entries = texts.getMappings();
    const auto& translations = entries.getAllValues();
    for (int i = 0; i < entries.size(); ++i)
        if (auto p = Phrase::from (entries.getAllKeys()[i].toStdString(), translations[i]); p && (p->letters >= least || p->fixed.size() == 1))
            all.push_back (*std::move (p));
    return all;
}

/// Translates a sentence so that as many of its letters as possible are in an entry.
class Translator
{
public:
    explicit Translator (const Phrases& p) : phrases (p) {}

    juce::String operator() (std::string_view text) { return best (text).text; }

private:
    struct Said
    {
        juce::String text;
        std::ptrdiff_t letters = 0;   // of the English text, in entries
    };

    const Phrases& phrases;
    std::map<std::string_view, Said> known {};

    const Said& best (std::string_view text)
    {
        if (const auto found = known.find (text); found != known.end()) return found->second;
        auto said = inParts (text);
        for (const auto& p : phrases)
            if (const auto found = p.match (text))
                if (auto by = translatedBy (p, *found); by.letters > said.letters) said = std::move (by);
        return known[text] = std::move (said);
    }

    Said translatedBy (const Phrase& p, const Values& found)
    {
        std::vector<juce::String> values;
        auto letters = p.letters;
        for (std::size_t i = 0; i < found.size(); ++i)
        {
            const bool is_quoted = i > 0 && i + 1 < found.size() && p.isQuoted (i);
            const auto said = is_quoted ? Said { valueText (found[i]) } : best (found[i]);
            values.push_back (said.text);
            letters += said.letters;
        }
        const auto before = values.front(), after = values.back();
        return { before + filledWith (p.translation, std::span (values).subspan (1, values.size() - 2)) + after, letters };
    }

    /// Without an entry for the whole text: as two messages in one.
    Said inParts (std::string_view text)
    {
        const auto at = std::min (text.find ("; "), text.find (": "));
        if (at == text.npos) return { valueText (text) };
        const auto first = best (text.substr (0, at)), second = best (text.substr (at + 2));
        return { first.text + valueText (text.substr (at, 2)) + second.text, first.letters + second.letters };
    }
};
}   // namespace

juce::String translated (std::string_view english)
{
    const auto phrases = [] {
        const std::scoped_lock guard (phrases_lock);
        return phrases_in_use;
    }();
    constexpr std::size_t longest = 2000;   // the output of a compiler would take seconds
    return phrases && english.size() <= longest ? Translator (*phrases) (english) : valueText (english);
}

void useTexts (std::unique_ptr<juce::LocalisedStrings> texts)
{
    auto phrases = texts ? std::make_shared<const Phrases> (phrasesOf (*texts)) : nullptr;
    {
        const std::scoped_lock guard (phrases_lock);
        phrases_in_use = std::move (phrases);
    }
    juce::LocalisedStrings::setCurrentMappings (texts.release());
}

}   // namespace tactus::host
