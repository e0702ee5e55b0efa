// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>
#include <host/app/model/course.hpp>

#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// The port or wire under the pointer, whose value the canvas shows.
struct PointedPort
{
    /// The side on which the card is, so that it covers neither the node nor the pointer.
    enum class Side
    {
        left,
        right,
        below
    };

    std::string port {};        ///< its path in the graph, "grain/wave.value"; "" for none
    juce::Point<float> at {};   ///< where the card points, in canvas units
    Side side = Side::below;

    bool operator== (const PointedPort&) const = default;
};

/// The values that a port carries now, and their course over the last seconds. They are drawn on the canvas next to the port.
struct PortCard
{
    static constexpr int width = 240, plot_height = 40;   ///< pixels

    PointedPort where {};
    std::string title {};
    std::vector<std::string> values {};   ///< with units; one, or one per component of a vector
    Quantity quantity = Quantity::any;
    std::string high {}, low {};   ///< the range of the plot, with units
    std::string seconds {};        ///< the time that the plot covers
    std::shared_ptr<const Course> course {};
    std::size_t columns = 0;   ///< how many columns fill the plot

    bool operator== (const PortCard&) const = default;
};

/// The area of the card in pixels of the canvas: next to a point, and within the canvas.
juce::Rectangle<int> boundsOf (const PortCard&, juce::Point<float> pixel, juce::Rectangle<int> canvas);

void paintCard (juce::Graphics&, const PortCard&, juce::Rectangle<int>, const Look&);

}   // namespace tactus::host
