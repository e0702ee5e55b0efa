// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_watch.hpp"
#include "device_setup.hpp"

#include <host/app/text/filled.hpp>
#include <tactus/text/caught.hpp>

namespace tactus::host
{

namespace
{
using namespace std::chrono_literals;

// A check begins this long after the latest change, or after the first unchecked one, whichever comes first.
constexpr std::chrono::milliseconds pause = 300ms, patience = 1s;
constexpr int ticks_per_look = 6;   // every sixth call to poll() checks the devices: five times a second
}   // namespace

LimitWatch::LimitWatch (Document& d, const DeviceSetup& s, const LiveRun& l, const Catalogue& c)
    : Thread ("limits"), document (d), setup (s), live (l), catalogue (c)
{
    document.add (*this);
    documentChanged();
}

LimitWatch::~LimitWatch()
{
    document.remove (*this);
    closing.request_stop();
    stopThread (-1);
}

void LimitWatch::documentChanged()
{
    if (std::exchange (seen, document.identity()) != document.identity()) show ({});
    if (std::exchange (version, document.version()) != document.version()) changed();
}

void LimitWatch::changed()
{
    last_changed_at = Clock::now();
    if (! changed_at) changed_at = last_changed_at;
}

/// Notices a change of the devices or of the rate: a device with its own clock may tick the run at a different rate from that of the graph.
void LimitWatch::lookAtDevices()
{
    auto roles_now = limitRolesOf (document.graph(), setup.session(), setup.profiles());
    const double rate_now = live.isRunning() && ! live.clockRole().empty() ? live.rate() : 0.0;
    if (roles_now == roles && rate_now == rate_hz) return;
    roles = std::move (roles_now);
    rate_hz = rate_now;
    changed();
}

void LimitWatch::poll()
{
    if (attended++ % ticks_per_look == 0) lookAtDevices();
    if (is_busy) take();
    if (is_busy || ! changed_at) return;
    const auto now = Clock::now();
    if (now - *last_changed_at >= pause || now - *changed_at >= patience) begin();
}

/// Shows the result of a check, unless another graph has been opened since it began.
void LimitWatch::take()
{
    std::optional<CheckResult> finished;
    {
        const std::scoped_lock guard (lock);
        finished.swap (done);
    }
    if (! finished) return;
    is_busy = false;
    if (finished->document != document.identity()) return;
    show (std::move (finished->list));
    if (! finished->problem.empty()) said.push_back (Message::warning ("program/exception", {}, finished->problem));
}

void LimitWatch::begin()
{
    lookAtDevices();   // an edit may have added a role
    changed_at.reset();
    is_busy = true;
    {
        const std::scoped_lock guard (lock);
        ordered = CheckRequest { document.identity(), { document.graph(), rate_hz, roles }, catalogue };
    }
    if (! isThreadRunning()) startThread (Priority::low);
    notify();
}

void LimitWatch::show (LimitList list)
{
    shown = std::move (list);
    said = shown.messages (document.graph());
    remarked = shown.remarks (document.graph());
}

void LimitWatch::run()
{
    FileAssets assets;   // its own, because the assets of the run belong to other threads
    while (! threadShouldExit())
    {
        std::optional<CheckRequest> order;
        {
            const std::scoped_lock guard (lock);
            order.swap (ordered);
        }
        if (! order)
        {
            wait (-1);
            continue;
        }
        CheckResult result { order->document, {}, {} };
        auto list = caught ({}, [&] { return limitsOf (order->job, order->types, assets, closing.get_token()); });
        if (list)
            result.list = std::move (*list);
        else
            result.problem = filled (TRANS ("the graph was not checked: %1"), list.error().text).toStdString();
        const std::scoped_lock guard (lock);
        done = std::move (result);
    }
}

}   // namespace tactus::host
