// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <tactus/graph/graph.hpp>

#include <functional>

namespace tactus::host
{

/// One item of a Column. Its height follows from its width.
class Block : public juce::Component
{
public:
    Block() { setMouseClickGrabsKeyboardFocus (false); }   // a click beside the fields must not give the keyboard to the first one

    virtual int heightFor (int width) = 0;
    virtual void refresh (const graph::Node*) {}   ///< shows the current values; the node may be null
    virtual void refreshLive() {}                  ///< shows what wires set; call it while a graph runs, and once after that

    std::function<void()> onHeight;   ///< called when its height has changed
};

/// Wrapped text, perhaps with a tooltip.
class TextBlock final : public Block, public juce::SettableTooltipClient
{
public:
    enum class Kind
    {
        title,
        text,
        small,
        heading
    };

    TextBlock (juce::String, Kind, const juce::String& tooltip = {});

    int heightFor (int width) override;
    void paint (juce::Graphics&) override;

private:
    juce::TextLayout layout (int width) const;

    juce::String text;
    Kind kind;
};

/// A vertical stack of blocks.
class Column : public Block
{
public:
    struct Margins
    {
        int left, right, vertical;
    };

    explicit Column (Margins m = { 16, 16, 16 }) : margins (m) {}

    void add (std::unique_ptr<Block>);
    void add (const juce::String& text, TextBlock::Kind, const juce::String& tooltip = {});   ///< no effect if the text is empty

    int heightFor (int width) override;
    void refresh (const graph::Node*) override;
    void refreshLive() override;
    void resized() override;
    void layOut (int width);   ///< places the blocks, and sets the size of the column itself

    std::size_t size() const noexcept { return blocks.size(); }
    Block& operator[] (std::size_t i) { return *blocks[i]; }

protected:
    std::vector<std::unique_ptr<Block>> blocks;

private:
    int inner (int width) const noexcept { return width - margins.left - margins.right; }

    const Margins margins;
};

}   // namespace tactus::host
