// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <framework/graph/graph.hpp>

#include <functional>

namespace tactus::host
{

/// A part of a column of such, as high as it needs to be for a width.
class Block : public juce::Component
{
public:
    virtual int heightFor (int width) = 0;
    virtual void refresh (const graph::Node*) {}   ///< the node as it is now, if there is one

    std::function<void()> onHeight;   ///< it needs another height now
};

/// Text that wraps.
class Words final : public Block
{
public:
    enum class Kind
    {
        title,
        text,
        small,
        heading
    };

    Words (juce::String, Kind);

    int heightFor (int width) override;
    void paint (juce::Graphics&) override;

private:
    juce::TextLayout layout (int width) const;

    juce::String text;
    Kind kind;
};

/// Blocks, one under another.
class Column final : public juce::Component
{
public:
    void add (std::unique_ptr<Block>);
    void add (const juce::String& words, Words::Kind);   ///< nothing if there are none
    void refresh (const graph::Node*);
    void layOut (int width);

    std::function<void()> onHeight;   ///< of one of them

    std::size_t size() const noexcept { return blocks.size(); }
    Block& operator[] (std::size_t i) { return *blocks[i]; }

private:
    std::vector<std::unique_ptr<Block>> blocks;
};

}   // namespace tactus::host
