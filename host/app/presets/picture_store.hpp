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

/// Force pictures, drawn up behind the scenes one after another and kept. [main thread]
class PictureStore final : private juce::Thread
{
public:
    explicit PictureStore (const Catalogue&);
    ~PictureStore() override;

    /// Null while it is not done yet; then it is begun, before those that were asked for earlier.
    std::shared_ptr<const ForcePicture> get (const std::filesystem::path&);

    /// Counts those that are done: who shows one paints again when it has changed.
    int done() const noexcept { return finished.load(); }

private:
    void run() override;

    const Catalogue& catalogue;
    std::mutex lock;   // over the two below
    std::map<std::filesystem::path, std::shared_ptr<const ForcePicture>> pictures;
    std::deque<std::filesystem::path> wanted;
    std::atomic<bool> cancelled { false };
    std::atomic<int> finished { 0 };
};

/// Draws one into an area, with its peak; or says why there is none.
void drawPicture (juce::Graphics&, const Look&, juce::Rectangle<float>, const ForcePicture*);

}   // namespace tactus::host
