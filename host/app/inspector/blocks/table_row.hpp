// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fields.hpp"

#include <host/app/look/tool_button.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

/// A table row: a cell per column and a button that removes the row.
class TableRow final : public Block
{
public:
    struct Cell
    {
        PortSheet sheet;
        Binding binding;
        bool is_text = false;   ///< true if the cell is edited as JSON text
    };

    TableRow (std::vector<Cell>, std::function<void()> remove, const std::function<void (const juce::String&)>& refused);

    int heightFor (int) override { return 26; }
    void refresh (const graph::Node*) override;
    void resized() override;

private:
    std::vector<Cell> cells;
    std::vector<std::unique_ptr<juce::Component>> fields;
    ToolButton cross { juce::String::fromUTF8 ("\xc3\x97"), ToolButton::Kind::plain, TRANS ("Remove this row") };
};

/// The header of a table: column names and units.
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
