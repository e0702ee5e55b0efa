// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/desk/panel.hpp>
#include <host/app/look/splitter.hpp>
#include <host/app/look/tabs.hpp>
#include <host/app/run/views/hand_panel.hpp>

#include <array>
#include <optional>
#include <utility>

namespace tactus::host
{

/// The places of the panels around the canvas: tabs at the left and at the bottom, the inspector at the right, the hand, and the edges between them, which
/// the user drags. A small window has no room for all of them side by side: there, a row of pages chooses what is at the left. [main thread]
class PanelLayout
{
public:
    /// The components must be children of the window, which lays itself out again when an edge moves.
    PanelLayout (juce::Component& window, const Desk&, HandPanel&, juce::Component& inspector);

    Tabs left, bottom, pages;

    using Edges = std::array<std::pair<const char*, Splitter*>, 5>;
    using Parts = std::array<std::pair<const char*, juce::Component*>, 4>;
    Edges edges();       ///< of the panels, by the names that the settings give them; only the first three fold
    Parts pageParts();   ///< what is on each page of a small window, with its name in English

    /// Returns the place of pages that lie over the canvas: from it to the right edge of the window; in a small window, all of the area.
    juce::Rectangle<int> layOut (juce::Rectangle<int> area);
    void readSettings();

    bool isSmall() const;
    void turnTo (const juce::Component& part);   ///< in a small window, shows the page of this part

    void toFront (const juce::Component& panel);   ///< of its tabs
    void reveal (const juce::Component& panel);    ///< like toFront(), even if the tabs are folded
    void rename (const juce::Component& panel, const Panel::Title&);

    /// Leaves the window to the canvas, or brings back the panels that were open before.
    void foldPanels();
    bool isCanvasAlone() const noexcept { return is_canvas_alone; }

    /// Gives the keyboard to the next part that is open, or to the previous one if `step` is -1.
    void nextPart (int step);

private:
    using Shares = std::array<std::optional<double>, 5>;
    Shares shares();
    void edgeMoved();
    void noteMoves();   ///< makes a step of the history of what has changed since the last call
    void restore (const Shares&);
    void layOutPages (juce::Rectangle<int>);
    juce::Rectangle<int> layOutPanels (juce::Rectangle<int>);   ///< returns the area of the canvas

    juce::Component& window;
    const Desk& desk;
    HandPanel& hand;
    juce::Component& inspector;
    Splitter left_edge { Splitter::Edge::right, 232, 160 }, right_edge { Splitter::Edge::left, 304, 220 }, bottom_edge { Splitter::Edge::top, 264, 140 };
    Splitter hand_edge { Splitter::Edge::right, 420, 280, Splitter::Folds::no };
    Splitter page_edge { Splitter::Edge::right, 320, 224, Splitter::Folds::no };   // of the pages of a small window
    Shares shares_before {};                                                       // at the last step of the history
    std::array<bool, 3> folded_before {};                                          // by panel, before foldPanels() folded them all
    bool is_canvas_alone = false;                                                  // foldPanels() has folded them, until it brings them back
};

}   // namespace tactus::host
