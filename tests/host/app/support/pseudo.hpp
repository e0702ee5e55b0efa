// SPDX-License-Identifier: MIT
#pragma once

#include <host/app/text/translated.hpp>

#include <string>
#include <vector>

namespace tactus::host::test
{

/// The entries of en.txt.
std::vector<juce::String> templateTexts();

/// A translation of en.txt into no language: each word that has letters gets ~ at its end, so that it is about a third longer.
juce::String pseudoTranslation();

/// While this lives, all texts are in the pseudo-translation.
struct InPseudo
{
    InPseudo() { useTexts (std::make_unique<juce::LocalisedStrings> (pseudoTranslation(), false)); }
    ~InPseudo() { useTexts (nullptr); }
};

/// What need not be translated: names, ids and sentences of nodes, everything in the preset files, units, and what is added.
class Data
{
public:
    Data();

    void add (const juce::String&);

    /// The first words of a text that are neither translated nor in the data; empty if there are none.
    juce::String wordsLeft (const juce::String&) const;

private:
    bool has (const juce::String& words) const;

    juce::String all;   // in lower case, a line each
};

}   // namespace tactus::host::test
