// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "window_parts.hpp"

#include <functional>
#include <vector>

namespace tactus::host
{

/// The end of a window: it asks about each thing that would be lost, one after the other. [main thread]
class Closing
{
public:
    explicit Closing (WindowParts& p) : parts (p) {}

    /// Calls `close` once unsaved changes, a take and a film are saved or discarded.
    void whenSaved (std::function<void()> close);

    /// Leaves unsaved changes for the next start.
    void atOnce();

    /// Call many times a second: shows how much of the film is saved, and closes when it is. If that fails, the window stays open and says why.
    void poll();

private:
    void askPanels (std::size_t first, const std::function<void()>& close);
    void askAboutFilm (const std::function<void()>& close);
    std::vector<const void*> work() const;

    WindowParts& parts;
    std::function<void()> close_after_film;   // while the window waits for a film that is being saved
};

}   // namespace tactus::host
