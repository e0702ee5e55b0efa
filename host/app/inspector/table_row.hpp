// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fields.hpp"
#include "tool_button.hpp"

namespace tactus::host
{

/// A line of a table: a cell for each column, and a cross that takes the line away.
class TableRow final : public Block
{
public:
    struct Cell
    {
        PortSheet sheet;
        Slot slot;
        bool is_text = false;   ///< what is no number is written as in the file
    };

    TableRow (std::vector<Cell>, std::function<void()> remove, const std::function<void (const juce::String&)>& refused);

    int heightFor (int) override { return 26; }
    void refresh (const graph::Node*) override;
    void resized() override;

private:
    std::vector<Cell> cells;
    std::vector<std::unique_ptr<juce::Component>> fields;
    ToolButton cross { juce::String::fromUTF8 ("\xc3\x97"), ToolButton::Kind::plain, "Remove this line" };
};

/// The names of the columns over such, and their units under these.
class TableHead final : public Block
{
public:
    explicit TableHead (std::vector<std::pair<juce::String, juce::String>> names) : columns (std::move (names)) {}

    int heightFor (int) override { return 32; }
    void paint (juce::Graphics&) override;

private:
    std::vector<std::pair<juce::String, juce::String>> columns;
};

}   // namespace tactus::host
