// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "number_field.hpp"
#include "set_row.hpp"

#include <functional>
#include <string>
#include <vector>

namespace tactus::host
{

/// Where a value is read, and written: as the file has it. Null if there is none; nothing takes it away.
struct Slot
{
    std::function<Json()> get;
    std::function<void (std::optional<Json>, bool goes_on)> set;

    /// Of a member of an object in this slot. An object that is left empty goes.
    Slot member (const std::string& key) const;

    /// Of an entry of an array in this slot.
    Slot entry (std::size_t) const;
};

/// One line, or several, of text that is taken on return or when it is left, and given up on Esc.
class TextField final : public juce::TextEditor
{
public:
    TextField();

    void show (const juce::String&);   ///< unless somebody is writing in it
    void apply();

    std::function<void (const juce::String&)> onApply;

private:
    juce::String shown;
};

std::unique_ptr<Block> textRow (const juce::String& label, std::function<juce::String()> get, std::function<void (const juce::String&)> set, const juce::String& about, int lines = 1);
std::unique_ptr<Block> choiceRow (const juce::String& label, std::vector<std::string> choices, std::function<std::string()> get, std::function<void (const std::string&)> set, const juce::String& about);
std::unique_ptr<Block> switchRow (const juce::String& label, std::function<bool()> get, std::function<void (bool)> set, const juce::String& about);

/// A number of its own sheet.
std::unique_ptr<Block> numberRow (const juce::String& label, const PortSheet&, Slot, std::function<void (const juce::String&)> refused);

/// A button with words.
std::unique_ptr<Block> buttonRow (const juce::String& words, std::function<void()> press, const juce::String& about);

/// The sheet of a number that is none of a node's ports.
PortSheet sheetOfNumber (std::string_view id, UnitRule, std::string_view about, Limits, double initial);

}   // namespace tactus::host
