// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/inspector/blocks/fields.hpp>
#include <host/fitting/fitting.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace tactus::host
{

/// Which column of a recording is which, and its unit: for each quantity that a kind needs, a list of the columns and a field. [main thread]
class FitColumns final : public juce::Component
{
public:
    static constexpr int height = 46;   ///< in pixels

    void show (const Table&, FitKind);   ///< begins with what the names of the columns say
    void clear();

    /// What is chosen. A unit that does not fit is left out; see problem().
    ColumnChoice choice() const;
    juce::String problem() const;   ///< what is missing or does not fit; empty: nothing

    void chooseColumn (const std::string& role, const juce::String& column);   ///< as in the list; an empty name: not recorded
    void setUnit (const std::string& role, const juce::String& unit);          ///< as typed, such as "mm" or "0.5 N"

    std::function<void()> onChange, onEscape;

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    struct Cell
    {
        FitColumn wanted;
        juce::ComboBox column;
        TextField unit;
    };

    Cell* find (const std::string& role);
    void changed();

    std::vector<std::string> names;   // of the columns
    std::vector<std::unique_ptr<Cell>> cells;
};

}   // namespace tactus::host
