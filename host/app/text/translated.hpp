// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string_view>

#include <juce_core/juce_core.h>

namespace tactus::host
{

/// A text from code that knows nothing of translations, such as a message of the framework, in the language of the user. Such code writes
/// whole English sentences; this finds the entry of the translation whose pattern has made the sentence, such as "there is no node %1", and
/// translates the values, too. What no entry fits stays as it is, as do values in quotation marks and texts of more
/// than 2000 characters. [any thread]
juce::String translated (std::string_view english);

/// From now on, TRANS and translated() use these texts. Null: all texts are in English. [main thread]
void useTexts (std::unique_ptr<juce::LocalisedStrings>);

}   // namespace tactus::host
