// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "paint_scene.hpp"
#include "squares.hpp"

#include <optional>
#include <unordered_map>
#include <vector>

namespace tactus::host
{

/// A picture of what lies below the nodes of a patch that has very many wires: the grid, the notes, and the wires that are painted together. It
/// is kept from one paint to the next, and only the parts are painted again in which one of these has changed. So a node that moves costs what its
/// own wires cost, not what all wires cost that cross them.
class Backdrop
{
public:
    /// Paints the picture, which covers an area that begins at the origin. Returns false, and paints nothing, if there is none: the patch has
    /// fewer wires, or pixels of the picture would not be pixels of the screen.
    bool paint (juce::Graphics&, juce::Rectangle<int> area, const Scene&, const View&, const Look&, const Highlights&);

    /// The number of squares of the picture that have been painted so far, and the number that it has. For tests.
    std::size_t squaresPainted() const noexcept { return painted; }
    std::size_t squares() const noexcept { return old.size(); }

private:
    /// The values that the whole picture depends on. If one changes, the picture is old.
    struct Ground
    {
        View view;
        int width = 0, height = 0;   // of the picture in pixels
        float scale = 1.0f;          // pixels of the picture for one of the component
        const Theme* theme = nullptr;
        std::vector<std::tuple<juce::Rectangle<float>, std::string, std::string, bool>> notes {};   // area, text, colour, selected

        bool operator== (const Ground&) const = default;
    };

    /// The look and the place of a wire.
    struct Drawn
    {
        juce::Point<float> from, to;
        std::vector<juce::Point<float>> waypoints;
        bool has_bends = false;
        Quantity quantity = Quantity::any;
        int width = 1, level = 0;
        std::uint64_t pass = 0;   // the last one in which the scene had it

        bool looksAs (const SceneWire&, int level_now) const;
        juce::Path path() const { return has_bends ? curveThroughBends (from, waypoints, to) : curveThrough (from, waypoints, to); }
    };

    static std::optional<Ground> groundOf (const juce::Graphics&, juce::Rectangle<int> area, const Scene&, const View&, const Look&, const Highlights&);
    void noteWires (const Scene&, const Highlights&);
    void paintOld (const Scene&, const Look&, const Highlights&);

    juce::Image picture;
    Ground ground;
    std::unordered_map<graph::Id, Drawn> drawn;
    Squares old;
    std::uint64_t pass = 0;
    std::size_t painted = 0;
};

}   // namespace tactus::host
