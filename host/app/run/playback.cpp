// SPDX-License-Identifier: GPL-3.0-or-later
#include "playback.hpp"

namespace tactus::host
{

Playback::Playback (Document& document, const Catalogue& c, Sound& sound, DeviceSetup& setup, std::function<void()> b)
    : catalogue (c), before_run (std::move (b)), live_run (document, c, &sound)
{
    live_run.obey (stop_switch);
    live_run.use (setup);
    setup.onChange = [this] { live_run.setupChanged(); };
}

void Playback::start (LiveRun::Hand hand)
{
    before_run();
    live_run.start (std::move (hand));
}

void Playback::stop() noexcept
{
    resumes = false;
    current().stop();
}

void Playback::emergencyStop() noexcept
{
    resumes = false;
    current().emergencyStop();
}

void Playback::preview (graph::Graph g)
{
    endPreview();
    resumes = live_run.isWanted() && ! live_run.isStoppedForGood();
    live_run.letGo();
    preview_document = std::make_unique<Document> (std::move (g));
    preview_run = std::make_unique<LiveRun> (*preview_document, catalogue);
    preview_run->obey (stop_switch);
    before_run();
    preview_run->start (LiveRun::Hand {});
}

void Playback::endPreview()
{
    if (! isPreviewing()) return;
    preview_run.reset();
    preview_document.reset();
    if (resumes) restart();
}

void Playback::attend()
{
    if (stop_switch.isAhead())
    {
        const auto before = stop_switch.notice();
        stop_switch.noticed().emergencies != before.emergencies ? emergencyStop() : stop();
    }
    live_run.attend();
    if (preview_run) preview_run->attend();
}

}   // namespace tactus::host
