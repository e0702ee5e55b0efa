// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_job.hpp"

#include <tactus/text/caught.hpp>

namespace tactus::host
{

FilmJob::FilmJob (std::shared_ptr<const Film> f, const Theme& theme, juce::Rectangle<int> view, int width, std::filesystem::path path)
    : film (std::move (f)), picture (theme, view, width), named (std::move (path))
{
    worker = std::thread ([this] {
        outcome = caught (named.string(), [this] {
            return writeFilm (*film, picture, named, [this] (double part) {
                done.store (part, std::memory_order_relaxed);
                return ! is_stopped.load (std::memory_order_relaxed);
            });
        });
        is_over.store (true, std::memory_order_release);
    });
}

FilmJob::~FilmJob()
{
    stop();
    if (worker.joinable()) worker.join();
}

const std::optional<Result<FilmFiles>>& FilmJob::result()
{
    static const std::optional<Result<FilmFiles>> none;
    if (! is_over.load (std::memory_order_acquire)) return none;
    if (worker.joinable()) worker.join();
    return outcome;
}

}   // namespace tactus::host
