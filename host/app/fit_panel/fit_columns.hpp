// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/inspector/blocks/fields.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/tools/fitting/fitting.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace tactus::host
{

/// A form in which the user assigns the columns of a recording, their units and their signs. It has, for each quantity that a kind needs, a list of
/// the columns, a field and, where the tool is pressed on, a button. [main thread]
class FitColumns final : public juce::Component
{
public:
    static constexpr int height = 46;   ///< in pixels

    void show (const Table&, FitKind);   ///< begins with what the names of the columns say
    void clear();

    /// The choice of the user. A unit that does not fit is left out; see problem().
    ColumnChoice choice() const;
    juce::String problem() const;
    juce::StringArray turnedByUser() const;   ///< the columns whose signs the user has chosen   ///< what is missing or does not fit; empty: nothing

    void chooseColumn (const std::string& role, const juce::String& column);   ///< as in the list; an empty name: not recorded
    void setUnit (const std::string& role, const juce::String& unit);          ///< as typed, such as "mm" or "0.5 N"
    void turn (const std::string& role);                                       ///< as a click on its sign

    /// The roles whose sign is turned now, whether the user or the recording says so.
    void showTurned (const std::set<std::string>& roles);

    std::function<void()> onChange, onEscape;

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    struct Cell
    {
        FitColumn wanted;
        juce::ComboBox column;
        TextField unit;
        ToolButton sign { juce::String::fromUTF8 ("\xc2\xb1"), ToolButton::Kind::toggle };
        std::optional<bool> turned {};   // by the user; empty: the recording decides
    };

    Cell* find (const std::string& role);
    void changed();

    std::vector<std::string> names;   // of the columns
    std::vector<std::unique_ptr<Cell>> cells;
};

}   // namespace tactus::host
