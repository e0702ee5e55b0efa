// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "number_field.hpp"
#include "set_row.hpp"

#include <functional>
#include <string>
#include <vector>

namespace tactus::host
{

/// Reads and writes a value as stored in the file. get() returns null if there is none; set() without a value removes it.
struct Binding
{
    std::function<Json()> get;
    std::function<void (std::optional<Json>, bool continues)> set;

    /// A member of the bound object. An object that becomes empty is removed.
    Binding member (const std::string& key) const;

    /// Rounds numbers to integers when they are set.
    Binding asInteger() const;

    /// An entry of the bound array.
    Binding entry (std::size_t) const;
};

/// Reads what the user typed: JSON if it parses, else text.
Json parseText (const juce::String&);

/// A value as the user edits it: text without quotes, anything else as JSON. Empty for null.
juce::String editText (const Json&);

/// A text field, single or multi-line. Return or losing focus applies the text; Esc reverts what was typed since it was last applied.
class TextField final : public juce::TextEditor
{
public:
    TextField();

    void show (const juce::String&);   ///< no effect on what the user has typed until it is applied
    void apply();
    void refuse();   ///< call it in onApply: the text stays for another try while the field has the keyboard, else the text from before comes back

    std::function<void (const juce::String&)> onApply;

private:
    void put (const juce::String&);

    juce::String shown, before_typing;
    bool refused = false;
};

/// A text field with a label. A text of more than two lines is also applied while it is being typed.
std::unique_ptr<Block> textRow (const juce::String& label, std::function<juce::String()> get, std::function<void (const juce::String&)> set,
                                const juce::String& about, int lines = 1);
std::unique_ptr<Block> choiceRow (const juce::String& label, std::vector<std::string> choices, std::function<std::string()> get,
                                  std::function<void (const std::string&)> set, const juce::String& about);
std::unique_ptr<Block> switchRow (const juce::String& label, std::function<bool()> get, std::function<void (bool)> set, const juce::String& about);

/// A number field. The sheet is copied.
std::unique_ptr<Block> numberRow (const juce::String& label, const PortSheet&, Binding, std::function<void (const juce::String&)> refused);

/// A text button.
std::unique_ptr<Block> buttonRow (const juce::String& text, std::function<void()> press, const juce::String& about);

/// A sheet for a number that is not a port of a node.
PortSheet sheetOfNumber (std::string_view id, UnitRule, std::string_view about, Limits, double initial);

}   // namespace tactus::host
