// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "frame_ring.hpp"
#include "recorder.hpp"
#include "report.hpp"
#include "session.hpp"

#include <host/platform/signals.hpp>
#include <host/platform/terminal.hpp>
#include <host/runtime/file_watch.hpp>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

namespace tactus::host
{

namespace
{
using Clock = std::chrono::steady_clock;

/// A slew limit may make the way to zero long; a device that still has force on it after this is let go, with a warning.
constexpr double longest_halt_s = 30.0;

struct Options : SessionOptions
{
    bool watch = false;
};

/// What the tick thread tells the others.
struct Status
{
    std::atomic<std::size_t> ticks { 0 }, misses { 0 };
    std::atomic<double> force { 0.0 }, peak { 0.0 }, latest_s { 0.0 };
    std::atomic<bool> let_go_under_force { false };
    std::atomic<bool> done { false };
};

/// The tick thread: waits for each deadline, ticks, notes how it went. After the last tick, or on a request to stop,
/// goes on until the guards have brought all forces to zero.
void runTicks (Session& session, FrameRing* ring, Status& status)
{
    const auto period = std::chrono::duration_cast<Clock::duration> (std::chrono::duration<double> (1.0 / session.rate()));
    auto deadline = Clock::now();
    bool halting = false;
    const auto longest_halt = static_cast<std::size_t> (longest_halt_s * session.rate());

    for (std::size_t k = 0, halted_at = 0;; ++k)
    {
        if (! halting && (stopRequested() || (session.ticks() && k >= *session.ticks())))
        {
            halting = true;
            halted_at = k;
            session.engine().halt();
        }
        if (halting && session.engine().isAtRest()) break;
        if (halting && k - halted_at > longest_halt)
        {
            status.let_go_under_force = true;
            break;
        }

        std::this_thread::sleep_until (deadline);
        const auto now = Clock::now();
        const double late = std::chrono::duration<double> (now - deadline).count();
        if (late > status.latest_s.load (std::memory_order_relaxed)) status.latest_s.store (late, std::memory_order_relaxed);
        if (now - deadline > period)
        {
            status.misses.fetch_add (1, std::memory_order_relaxed);
            deadline = now;   // what was missed is not made up for in a burst
        }
        deadline += period;

        session.tick();

        const auto& plan = session.engine().plan();
        double force = 0.0;
        for (const auto& role : plan.roles)
            force = std::max (force, role.state->applied.force.norm());
        status.force.store (force, std::memory_order_relaxed);
        if (force > status.peak.load (std::memory_order_relaxed)) status.peak.store (force, std::memory_order_relaxed);
        if (ring && ! halting)
            if (auto frame = ring->next(); ! frame.empty())
            {
                for (std::size_t i = 0; i < frame.size(); ++i)
                    frame[i] = *plan.taps[i].value;
                ring->push();
            }
        status.ticks.store (k + 1, std::memory_order_relaxed);
    }
    status.done.store (true, std::memory_order_release);
}

void printStatus (const Status& s, double rate, bool over_the_last, const char* end)
{
    std::fprintf (stderr, "%s%8.2f s   force %6.3f N, peak %6.3f N   %zu missed of %zu ticks, latest by %.3f ms%s", over_the_last ? "\r\033[K" : "", static_cast<double> (s.ticks) / rate,
                  s.force.load(), s.peak.load(), s.misses.load(), s.ticks.load(), 1e3 * s.latest_s.load(), end);
    std::fflush (stderr);
}

void run (const Options& options)
{
    if (! options.records.empty() && options.outputs.empty())
        throw CLI::RequiredError ("--record names what to record, but not where to: --out FILE");
    watchForStop();
    FileWatch watch { { options.graph } };   // before it is read, so that no edit is missed
    Session session { options, Session::Pace::live };
    const auto& taps = session.engine().plan().taps;
    std::optional<Recorder> recorder;
    std::optional<FrameRing> ring;
    if (! options.outputs.empty())
    {
        recorder.emplace (options.outputs, taps, session.rate(), false);
        ring.emplace (taps.size(), static_cast<int> (session.rate()) + 1);   // one second
    }

    const bool terminal = stderrIsTerminal();
    watch.watch (session.files());
    const auto reload = [&]
    {
        if (terminal) std::fprintf (stderr, "\r\033[K");
        std::fprintf (stderr, session.reload() ? "%s: taken over\n" : "%s: not taken over; the graph before goes on\n", options.graph.c_str());
        watch.watch (session.files());
    };

    std::fprintf (stderr, "%s at %g Hz%s; Ctrl-C stops\n", (session.name().empty() ? options.graph : session.name()).c_str(), session.rate(), options.watch ? ", following its file" : "");

    Status status;
    std::jthread ticking ([&]
                          { runTicks (session, ring ? &*ring : nullptr, status); });
    const auto drain = [&]
    {
        if (ring) ring->drain ([&] (std::span<const double> frame)
                               { recorder->frame (frame); });
    };
    try
    {
        for (int i = 0; ! status.done.load (std::memory_order_acquire); ++i)
        {
            std::this_thread::sleep_for (std::chrono::milliseconds (20));
            drain();
            if (options.watch && i % 10 == 0 && watch.look()) reload();
            session.engine().clear();
            if (terminal && i % 5 == 0) printStatus (status, session.rate(), true, "");
        }
    }
    catch (...)
    {
        requestStop();   // forces go to zero before the message ends the program
        throw;
    }
    ticking.join();
    drain();
    printStatus (status, session.rate(), terminal, "\n");

    session.reportRun();
    if (status.let_go_under_force)
        std::fprintf (stderr, "warning: the slew limit kept force on a device for %g s, so it was let go under force\n", longest_halt_s);
    if (ring && ring->lost() > 0)
        std::fprintf (stderr, "warning: %zu ticks were not recorded, because writing could not keep up\n", ring->lost());
    if (recorder) recorder->commit();
}
}   // namespace

void addPlay (CLI::App& app)
{
    const auto options = std::make_shared<Options>();
    auto* command = app.add_subcommand ("play", "Run a graph in real time, until its gesture or trace ends, --duration is over, or Ctrl-C");
    options->addTo (*command);
    command->add_flag ("--watch", options->watch, "Take the graph file over each time it is edited; what has not changed in it goes on");
    command->footer ("However it stops, the guards bring all forces to zero smoothly first.\n"
                     "With --watch, a file with errors is reported and the graph before goes on. Roles keep the devices they have\n"
                     "from the start, --set outranks the file as ever, and what is recorded stays the same.\n\n"
                     "Examples:\n"
                     "  tactus play graphs/dry_wood.json\n"
                     "  tactus play graphs/dry_wood.json --device stylus=gesture:circle --duration 10\n"
                     "  tactus play graphs/dry_wood.json --watch\n"
                     "  tactus play graphs/dry_wood.json --record drag.force,drag.state --out wood.csv");
    command->callback ([options]
                       { run (*options); });
}

}   // namespace tactus::host
