// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "device_setup.hpp"
#include "device_trial.hpp"
#include "live_run.hpp"

namespace tactus::host
{

/// Runs the document, or previews a preset in its place. [main thread]
class Playback
{
public:
    /// The sound and the device setup must outlive the playback. `before_run` is called before each start.
    Playback (Document&, const Catalogue&, Sound&, DeviceSetup&, std::function<void()> before_run);

    LiveRun& run() noexcept { return live_run; }   ///< the run of the document, even during a preview
    LiveRun& current() noexcept { return preview_run ? *preview_run : live_run; }

    void start (LiveRun::Hand);   ///< this and the next five: see LiveRun
    void startOther (LiveRun::Hand);
    void moveBy (LiveRun::Hand);
    void changeHand (LiveRun::Hand);
    void moveTool (std::string role);
    void startAgain (By = By::person);
    void restart() { start (live_run.hand()); }
    void stop (By = By::person) noexcept;   ///< stops the document's run or the preview, whichever is current
    void emergencyStop (By = By::person) noexcept;

    /// Call it when another program has changed the session. Stops a run that would get other devices by it, as if a person had stopped it, so only a
    /// person starts it again. Returns true if it has stopped one.
    bool sessionChanged() noexcept;

    /// Stops the document, and runs another graph with its own gesture until endPreview().
    void preview (graph::Graph);
    void endPreview();   ///< runs the document again if it ran before
    bool isPreviewing() const noexcept { return preview_run != nullptr; }

    /// Pauses the document, plays a short, gentle pulse on the device of a role, and runs the document again. Works only while the document
    /// runs: a user who has stopped the forces does not expect a pulse. Ids: device_trial/stopped, device_trial/no_motor.
    Result<> tryDevice (const std::string& role);
    bool isTrying() const noexcept { return trial.has_value(); }

    /// Stops the document's run or the preview, even if the message thread is busy. Valid as long as this object exists.
    StopSwitch& stopSwitch() noexcept { return stop_switch; }

    void poll();   ///< call many times a second

private:
    const Catalogue& catalogue;
    std::function<void()> before_run;
    StopSwitch stop_switch;   // declared before the runs that obey it
    LiveRun live_run;
    std::unique_ptr<Document> preview_document;
    std::unique_ptr<LiveRun> preview_run;
    bool resumes = false;   // runs the document again after the preview

    /// The device that is being tested. The test runs as a preview.
    struct Trial
    {
        DeviceTrial of;
        double began_ms = 0.0, pulsed_ms = 0.0;   // 0: not yet
    };
    void attendTrial();
    void runInstead (graph::Graph, bool on_devices);

    DeviceSetup& devices;
    std::optional<Trial> trial;
};

}   // namespace tactus::host
