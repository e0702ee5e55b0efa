// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "live_run.hpp"

#include <host/app/limits/limit_list.hpp>

#include <juce_core/juce_core.h>

#include <chrono>
#include <mutex>
#include <optional>

namespace tactus::host
{

class DeviceSetup;

/// Checks the graph of a document on its devices after each edit, on its own thread with a low priority. A series of edits, such as the
/// drag of a knob, is checked when it pauses, and about once a second until then. [message thread]
class LimitWatch final : private Document::Listener, private juce::Thread
{
public:
    /// All of them must outlive this object.
    LimitWatch (Document&, const DeviceSetup&, const LiveRun&, const Catalogue&);
    ~LimitWatch() override;

    void poll();   ///< call many times a second

    /// The result of the latest check. While the next one runs, this is that of an earlier state of the same graph.
    const LimitList& list() const noexcept { return shown; }

    /// The same list as messages, for the Problems tab.
    const Messages& messages() const noexcept { return said; }
    const Messages& remarks() const noexcept { return remarked; }   ///< what is not judged

    /// False from an edit until its check is done. poll() notices a change of the devices at most a fifth of a second late.
    bool isUpToDate() const noexcept { return ! changed_at && ! is_busy; }

private:
    using Clock = std::chrono::steady_clock;

    struct CheckRequest
    {
        const void* document = nullptr;   // identity of the document
        LimitJob job;
        Catalogue types;   // a copy, because live C++ may replace types meanwhile
    };
    struct CheckResult
    {
        const void* document = nullptr;
        LimitList list;
        std::string problem;   // why there is no list; empty if there is one
    };

    void documentChanged() override;
    void changed();
    void lookAtDevices();
    void take();
    void begin();
    void show (LimitList);
    void run() override;

    Document& document;
    const DeviceSetup& setup;
    const LiveRun& live;
    const Catalogue& catalogue;

    LimitList shown;
    Messages said, remarked;
    const void* seen = nullptr;             // identity of the document at the latest edit
    std::optional<std::uint64_t> version;   // of the document
    std::vector<LimitRole> roles;
    double rate_hz = 0.0;
    std::optional<Clock::time_point> changed_at, last_changed_at;   // the first change that no check includes; the latest change
    bool is_busy = false;
    int attended = 0;

    std::stop_source closing;
    std::mutex lock;   // guards the members below
    std::optional<CheckRequest> ordered;
    std::optional<CheckResult> done;
};

}   // namespace tactus::host
