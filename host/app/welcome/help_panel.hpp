// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/inspector/blocks/block.hpp>
#include <host/app/look/plain_button.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/node/catalogue.hpp>

#include <functional>

namespace tactus::host
{

/// Help over the canvas: the datasheet of a node, or the keyboard shortcuts.
class HelpPanel final : public juce::Component
{
public:
    static constexpr int width = 560;

    explicit HelpPanel (const Catalogue&);

    /// A key of a panel, and what it does, for the list of shortcuts; both in English.
    void addKey (const char* key, const char* does) { panel_keys.emplace_back (key, does); }

    void showNode (const std::string& type);
    void showKeys();
    void close();

    void setArea (juce::Rectangle<int>);   ///< the panel is centred at the top of the area, and as high as its text

    bool isOpen() const { return isVisible(); }
    const std::string& type() const noexcept { return shown_type; }   ///< empty: keyboard shortcuts

    std::function<void (const std::string& type)> onExample;

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress& key) override { return scroll.keyPressed (key); }   ///< arrows, Page Up, Page Down, Home and End scroll

private:
    void show (std::unique_ptr<Column>);
    void place();

    const Catalogue& catalogue;
    juce::Rectangle<int> area;
    std::string shown_type;
    std::vector<std::pair<const char*, const char*>> panel_keys;
    std::unique_ptr<Column> column;
    juce::Viewport scroll;
    PlainButton example { TRANS ("Open example") }, keys { TRANS ("Keyboard shortcuts") }, done { TRANS ("Close") };
};

}   // namespace tactus::host
