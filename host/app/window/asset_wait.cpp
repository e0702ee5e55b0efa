// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset_wait.hpp"

#include <host/app/text/filled.hpp>

#include <utility>

namespace tactus::host
{

void AssetWait::begin (const graph::Graph& graph, const juce::String& name, std::function<void()> show)
{
    load.start (graph, parts.catalogue);
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
    if (taken == nullptr)
        return parts.question.say (filled (TRANS ("Its large files are being read and prepared: %1 s. Until then, the open graph stays as it is."),
                                           juce::roundToInt (load.seconds())));
    parts.playback.run().adopt (taken->assets);
    const auto show = std::exchange (after, {});
    parts.question.cancel();
    show();
    loaded = taken;
    loaded_for = parts.edited.identity();
}

void AssetWait::otherGraph()
{
    if (loaded_for != parts.edited.identity()) loaded.reset();
}

}   // namespace tactus::host
