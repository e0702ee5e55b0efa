// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flat_button.hpp"
#include "scope_plot.hpp"

#include <tactus/text/result.hpp>

#include <filesystem>

namespace tactus::host
{

/// One scope: a header with its ports, and the plot below. It can be frozen.
class ScopeView final : public juce::Component
{
public:
    static constexpr int header_height = 26, chips_height = 26, low = 172;   ///< a scope that is lower than `low` has its chips in the header

    ScopeView (ScopeSpec&, ScopeContext&, Signals live);

    std::function<void()> onClose, onFreeze;
    std::function<void (juce::Component& below)> onSave;   ///< called when the save button is clicked

    void refresh();   ///< call many times a second; may rebuild the header, so do not call it from a header button
    void redraw();
    void freeze (bool);
    bool isFrozen() const noexcept { return spec.is_frozen; }

    const ScopeSpec& shown() const noexcept { return spec; }
    std::size_t redraws() const noexcept { return times_drawn; }   ///< how often the plot has been updated
    ScopePlot& plot() noexcept { return *drawing; }

    /// Saves the scope as an image, at twice its size on the screen. Ids: scope/picture, and those of createFile.
    Result<> saveImage (const std::filesystem::path&);

    /// Saves all stored ticks of the traces. Ids: those of writeTraces.
    Result<> saveData (const std::filesystem::path&);

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    TraceList of (const std::string& port) const;
    void rebuildHeader();
    void addTraceChips();
    void addAxisChips();
    void addNodeChip();
    void choosePortFor (std::string ScopeSpec::*);
    void changed();

    /// A button with the name of a port, or of an action if the port is empty.
    struct Chip
    {
        juce::String text;
        std::string port {};
        juce::Colour dot {};
        std::function<void()> onClick {};
        juce::String about {};
        bool is_removable = false;   // true: the chip has a close button, and only that calls onClick
    };
    void add (Chip);

    /// The values that the plot and the header depend on.
    struct Seen
    {
        ScopeSpec of;
        std::uint64_t edits = 0, samples = 0;
        const Theme* theme = nullptr;
        juce::Rectangle<int> place {};
        bool operator== (const Seen&) const = default;
    };
    bool isAtRest();

    std::string headerKey();
    juce::Rectangle<int> title_area;

    ScopeSpec& spec;
    ScopeContext& context;
    Signals live;
    std::map<std::string, TraceList> held;   // the traces that are shown while frozen
    std::unique_ptr<ScopePlot> drawing;
    std::vector<std::unique_ptr<FlatButton>> links, chips;
    std::unique_ptr<FlatButton> freeze_button, save_button, close_button;
    std::string header_of;   // the headerKey() of the current header
    std::optional<Seen> seen;
    int still_for = 0;   // calls to refresh() since something changed
    std::size_t times_drawn = 0;
};

/// The title in the header, and on the button that adds such a scope.
juce::String titleOf (ScopeKind);

}   // namespace tactus::host
