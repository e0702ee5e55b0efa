// SPDX-License-Identifier: GPL-3.0-or-later
#include "setting_editor.hpp"

namespace tactus::host
{

void Stack::put (std::unique_ptr<Block> b)
{
    addAndMakeVisible (*b);
    b->onHeight = [this]
    {
        if (onHeight) onHeight();
    };
    blocks.push_back (std::move (b));
}

void Stack::remake()
{
    for (auto& b : blocks)
        removeChildComponent (b.get());
    retired = std::move (blocks);
    blocks.clear();
    made = true;
    made_for = shape();
    fill();
    resized();
}

int Stack::heightFor (int width)
{
    int h = 0;
    for (auto& b : blocks)
        h += b->heightFor (width - indent);
    return h;
}

void Stack::refresh (const graph::Node* node)
{
    if (! made || made_for != shape()) remake();
    for (auto& b : blocks)
        b->refresh (node);
}

void Stack::resized()
{
    int y = 0;
    for (auto& b : blocks)
    {
        const int h = b->heightFor (getWidth() - indent);
        b->setBounds (indent, y, getWidth() - indent, h);
        y += h;
    }
}

}   // namespace tactus::host
