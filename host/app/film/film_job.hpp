// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "film_files.hpp"

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

namespace tactus::host
{

/// Saves a film on its own thread. [main thread]
class FilmJob
{
public:
    FilmJob (std::shared_ptr<const Film>, const Theme&, juce::Rectangle<int> view, int width, std::filesystem::path);
    ~FilmJob();   ///< stops the work, and waits until it has ended

    double progress() const noexcept { return done.load (std::memory_order_relaxed); }   ///< the fraction that is done, 0…1
    void stop() noexcept { is_stopped.store (true, std::memory_order_relaxed); }

    /// The result, once the work is done.
    const std::optional<Result<FilmFiles>>& result();

private:
    std::shared_ptr<const Film> film;
    FilmPicture picture;
    std::filesystem::path named;
    std::atomic<double> done = 0.0;
    std::atomic<bool> is_stopped = false, is_over = false;
    std::optional<Result<FilmFiles>> outcome;
    std::thread worker;
};

}   // namespace tactus::host
