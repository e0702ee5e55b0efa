// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/face.hpp>

#include <functional>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Where a port is on its node, and where a wire meets it.
struct Socket
{
    const FacePort* port = nullptr;   ///< of the face the box was made for
    juce::Point<float> at;            ///< from the top left corner of the node
    juce::Rectangle<float> row;       ///< of its label, as the mouse finds it
    std::string value;                ///< of a param, as it is written; empty for the others
};

/// A node as it is laid out, in canvas units, which are pixels at 100 %. As wide as its words, and not wider.
struct Box
{
    static constexpr float header_height = 28.0f, row_height = 20.0f, grid = 8.0f, padding = 10.0f;
    static constexpr float title_size = 13.0f, label_size = 12.0f;
    static constexpr int most_params = 3;           ///< that are shown although no wire leads to them
    static constexpr float widest_title = 220.0f;   ///< a longer name is cut

    float width = 0.0f, height = 0.0f;
    std::vector<Socket> sockets;

    const Socket* find (Role, std::string_view id) const noexcept;
};

/// How wide a text is, in a size, bold or not.
using TextWidth = std::function<float (const std::string&, float size, bool bold)>;

/// Inputs and params on the left, outputs on the right. Of the params those are shown that `wired` tells, and then a few,
/// those first that the node sets, with what `valueNow` says. The face must outlive the box.
Box boxOf (const graph::Node&, const Face&, const std::function<bool (const FacePort&)>& wired, const std::function<Json (const FacePort&)>& valueNow, const TextWidth&);

/// A value as it stands in a file, for people: "0.4 mm", "0.3", "(0, 0, 1)".
std::string valueText (const Json&, const FacePort&);

}   // namespace tactus::host
