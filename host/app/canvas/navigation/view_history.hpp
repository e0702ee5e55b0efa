// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "view.hpp"

#include <host/app/model/document.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// A view of a patch, and whether it is fitted to it.
struct ViewState
{
    std::string patch;
    View window;
    std::optional<View> framed;             ///< the view when it was last fitted to the patch: at the first layout with enough room, or on request
    juce::Rectangle<float> framed_around;   ///< what the fitted view shows if it cannot show the whole patch readably; empty: it shows all

    bool isFitted() const { return framed && *framed == window; }   ///< the user has not moved it since
};

/// The views of a canvas before and after each step of the history, so that undo brings back what was seen. [main thread]
class ViewHistory
{
public:
    explicit ViewHistory (const Document& d) : document (d), seen_position (d.history().position()) {}

    void begin (const ViewState& now);   ///< call after an edit, before the view follows it
    void end (const ViewState& now);     ///< the view as it is now belongs to the latest edit

    /// Call after an undo or a redo. Returns the view to go back to if the edit has moved the view and the user has not moved it since.
    std::optional<ViewState> step (const ViewState& now);

private:
    struct ViewPair
    {
        ViewState before, after;
    };

    const Document& document;
    std::vector<ViewPair> views;   // by step
    std::size_t seen_position;     // of the history
};

}   // namespace tactus::host
