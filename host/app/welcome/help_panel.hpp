// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/catalogue.hpp>
#include <host/app/inspector/block.hpp>
#include <host/app/window/plain_button.hpp>

#include <functional>

namespace tactus::host
{

/// What a node does, from its datasheet, or which keys there are. Over the canvas, until it is closed.
class HelpPanel final : public juce::Component
{
public:
    static constexpr int width = 560;

    explicit HelpPanel (const Catalogue&);

    void showNode (const std::string& type);
    void showKeys();
    void close();

    void setArea (juce::Rectangle<int>);   ///< it is in the middle of its top, as high as it needs to be

    bool isOpen() const { return isVisible(); }
    const std::string& type() const noexcept { return shown_type; }   ///< empty: the keys

    std::function<void (const std::string& type)> onExample;

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    void show (std::unique_ptr<Column>);
    void place();

    const Catalogue& catalogue;
    juce::Rectangle<int> area;
    std::string shown_type;
    std::unique_ptr<Column> column;
    juce::Viewport scroll;
    PlainButton example { "Open a small example" }, keys { "All keys" }, done { "Close" };
};

}   // namespace tactus::host
