// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "highlights.hpp"

#include <host/app/canvas/navigation/view.hpp>
#include <host/app/look/look.hpp>

#include <cstdint>
#include <unordered_map>

namespace tactus::host
{

/// Pictures of the nodes that stay as they are while others are dragged. So a step of a drag paints only the nodes that move, however many they cross.
class NodePictures
{
public:
    /// Paints the nodes as paintNodes() does, in the graphics context of the component. `version` is that of the document: nodes may look different if it
    /// changes. Pictures are used from the second paint on in which nothing but wires and the places of nodes has changed.
    void paint (juce::Graphics&, const Scene&, const View&, const Look&, const Highlights&, std::uint64_t version);

    std::size_t size() const noexcept { return pictures.size(); }

private:
    /// The values that the looks of all nodes depend on.
    struct Ground
    {
        View view;
        float scale = 1.0f;   // pixels of the screen per pixel of the component
        const Theme* theme = nullptr;
        std::uint64_t version = 0;
        std::set<graph::Id> selected {};
        graph::Id hovered = 0;
        LiveState live {};   // of the nodes

        bool operator== (const Ground&) const = default;
    };

    struct Picture
    {
        juce::Point<float> at;   // of the node, in canvas units
        juce::Image image {};
    };

    Ground ground;
    std::unordered_map<graph::Id, Picture> pictures;
};

}   // namespace tactus::host
