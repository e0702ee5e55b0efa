// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flat_button.hpp"
#include "scope_plot.hpp"

#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <filesystem>

namespace tactus::host
{

/// One scope: what it is and what it shows, and the drawing below. Frozen, it shows what stood there then.
class ScopeView final : public juce::Component
{
public:
    static constexpr int header_height = 26, chips_height = 26;

    ScopeView (ScopeSpec&, ScopeDesk&, Signals live);

    std::function<void()> onClose, onFreeze;
    std::function<void (juce::Component& below)> onSave;   ///< asked for a file

    void refresh();   ///< [not from what the header calls: it may make the header anew]
    void redraw();
    void freeze (bool);
    bool isFrozen() const noexcept { return spec.is_frozen; }

    const ScopeSpec& shown() const noexcept { return spec; }
    ScopePlot& plot() noexcept { return *drawing; }

    /// What is drawn, twice as large as on the screen.
    [[nodiscard]] tl::expected<void, Error> savePicture (const std::filesystem::path&);

    /// All ticks that are held of what it shows.
    [[nodiscard]] tl::expected<void, Error> saveNumbers (const std::filesystem::path&);

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    TraceList of (const std::string& port) const;
    void rebuildHeader();
    void addChip (const juce::String& text, const std::string& port, juce::Colour, std::function<void()> onClick, const juce::String& about, bool is_removable = false);
    std::string headerKey();

    ScopeSpec& spec;
    ScopeDesk& desk;
    Signals live;
    std::map<std::string, TraceList> held;   // while frozen
    std::unique_ptr<ScopePlot> drawing;
    std::vector<std::unique_ptr<FlatButton>> links, chips;
    std::unique_ptr<FlatButton> freeze_button, save_button, close_button;
    std::string header_of;   // what the header was built for
};

/// Its name in the header and on the button that adds it.
juce::String titleOf (ScopeKind);

}   // namespace tactus::host
