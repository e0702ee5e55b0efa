// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/face.hpp>

#include <functional>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// A port on a node: where it is, and where wires connect.
struct Socket
{
    const FacePort* port = nullptr;   ///< a port of the face from which the box was made
    juce::Point<float> at;            ///< position relative to the top left corner of the node
    juce::Rectangle<float> row;       ///< the area of its label, for hit testing
    std::string value;                ///< a param's value as shown; empty for other ports, and if a wire sets it
    std::string label {};             ///< its readable name
    std::string driver {};            ///< the output whose wire sets the param, such as "lfo.out"; empty if none does
    std::string depth {};             ///< how far modulators move the param around its value, such as "±6 mN"; empty if none does
};

/// The layout of a node in canvas units, which are pixels at 100 %. The node is only as wide as its text.
struct Box
{
    static constexpr float header_height = 28.0f, row_height = 20.0f, grid = 8.0f, padding = 10.0f;
    static constexpr float title_size = 13.0f, label_size = 12.0f;
    static constexpr std::size_t most_params = 3;   ///< how many params are shown, apart from wired ones
    static constexpr float widest_title = 220.0f;   ///< longer names are cut off
    static constexpr float plot_height = 32.0f;
    static constexpr float before_depth = 6.0f;   ///< the space between a value and its depth

    float width = 0.0f, height = 0.0f;
    juce::Rectangle<float> plot {};   ///< the place of the small curve, relative to the node; empty if there is none
    std::vector<Socket> sockets;

    const Socket* find (Role, std::string_view id) const noexcept;
};

/// Measures text in a font size.
using TextWidth = std::function<float (const std::string&, float size, bool bold)>;

/// Lays out a node: inputs and params on the left, outputs on the right. Shows a few params, first of all those that the node sets, and all for
/// which `wired` is true, in the order of the datasheet. Each has its `valueNow`, or the name of its `driver`, and the `depth` of its modulators. The
/// face must outlive the box.
Box boxOf (const graph::Node&, const Face&, const std::function<bool (const FacePort&)>& wired,
           const std::function<Json (const FacePort&)>& valueNow, const std::function<std::string (const FacePort&)>& driver,
           const std::function<std::string (const FacePort&)>& depth, bool has_plot, const TextWidth&);

/// Formats a value from a file for display: "0.4 mm", "0.3", "(0, 0, 1)".
std::string valueText (const Json&, const FacePort&);

}   // namespace tactus::host
