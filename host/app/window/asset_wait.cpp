// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset_wait.hpp"

#include <host/app/text/filled.hpp>

#include <utility>

namespace tactus::host
{

void AssetWait::begin (const graph::Graph& graph, const juce::String& name, std::function<void()> show)
{
    load.start ({}, [graph, &types = parts.catalogue] (JobCourse&) { return loadAssets (graph, types); });
    began = std::chrono::steady_clock::now();
    after = std::move (show);
    title = filled (TRANS ("Opening %1"), name);
    const auto cancel = [this] {
        load.cancel();
        after = {};
    };
    parts.question.ask (title, {}, { { TRANS ("Cancel"), cancel } });
    poll();
}

void AssetWait::poll()
{
    if (! load.isRunning() || ! parts.question.isOpen() || parts.question.title() != title) return;   // or another question comes first
    const auto taken = load.take();
    if (! taken)
        return parts.question.say (filled (TRANS ("Its large files are being read and prepared: %1 s. Until then, the open graph stays as it is."),
                                           std::chrono::round<std::chrono::seconds> (std::chrono::steady_clock::now() - began).count()));
    loaded = *taken ? taken->value() : nullptr;   // after an exception, the main thread will meet the same error, and report it
    if (loaded) parts.playback.run().adopt (loaded->assets);
    const auto show = std::exchange (after, {});
    parts.question.cancel();
    show();
    loaded_for = parts.edited.identity();
}

void AssetWait::otherGraph()
{
    if (loaded_for != parts.edited.identity()) loaded.reset();
}

}   // namespace tactus::host
