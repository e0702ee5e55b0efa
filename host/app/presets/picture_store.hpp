// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "force_picture.hpp"

#include <host/app/look/look.hpp>

#include <deque>
#include <map>
#include <memory>
#include <mutex>

namespace tactus::host
{

/// Computes force pictures in the background, one at a time, and caches them. [main thread]
class PictureStore final : private juce::Thread
{
public:
    explicit PictureStore (const Catalogue&);
    ~PictureStore() override;

    /// Returns null until the picture is done, and queues it ahead of earlier requests. If the file has been written since, returns the earlier picture
    /// until the new one is done.
    std::shared_ptr<const ForcePicture> get (const std::filesystem::path&);

    /// The node types for pictures that are computed from now on.
    void use (const Catalogue&);

    /// The number of finished pictures. Repaint when it changes.
    int done() const noexcept { return finished.load(); }

private:
    void run() override;

    struct Drawn
    {
        std::shared_ptr<const ForcePicture> picture {};
        std::filesystem::file_time_type written {};   // the file, before it was read
    };

    std::mutex lock;       // guards `catalogue`, `pictures` and `wanted`
    Catalogue catalogue;   // a copy: live C++ changes the original while the thread draws
    std::map<std::filesystem::path, Drawn> pictures;
    std::deque<std::filesystem::path> wanted;
    std::atomic<bool> cancelled { false };
    std::atomic<int> finished { 0 };
};

/// Draws a picture with its peak value, or the reason why there is none.
void drawPicture (juce::Graphics&, const Look&, juce::Rectangle<float>, const ForcePicture*);

}   // namespace tactus::host
