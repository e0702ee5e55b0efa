// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "recorder.hpp"
#include "report.hpp"
#include "session.hpp"

#include <framework/number_text.hpp>
#include <framework/turn.hpp>
#include <host/osc/remote_control.hpp>
#include <host/platform/realtime.hpp>
#include <host/platform/signals.hpp>
#include <host/platform/terminal.hpp>
#include <host/runtime/costliest_node.hpp>
#include <host/runtime/file_watch.hpp>
#include <host/runtime/frame_ring.hpp>
#include <host/runtime/tick_account.hpp>
#include <host/runtime/tick_clock.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

namespace tactus::host
{

namespace
{
/// A slew limit may make the way to zero long; a device that still has force on it after this is let go, with a warning.
constexpr double longest_halt_s = 30.0;

struct Options : SessionOptions
{
    bool watch = false;
    std::string osc = std::to_string (OscPort::usual);
    bool osc_asked_for = false;
    std::optional<int> core;
};

/// What the tick thread tells the others; all of it may be read while it runs.
struct Seen
{
    explicit Seen (double rate_hz) : account (1.0 / rate_hz) {}

    TickAccount account;
    std::atomic<double> force { 0.0 }, peak { 0.0 };
    std::atomic<bool> overrun { false }, let_go_under_force { false };
    std::atomic<bool> done { false };
};

/// The tick thread: ticks when the clock says so, notes how it went. After the last tick, on a request to stop, or when the
/// graph takes longer than its ticks last, goes on until the guards have brought all forces to zero.
void runTicks (Session& session, TickClock& clock, FrameRing* ring, Seen& seen)
{
    bool halting = false;
    const auto longest_halt = static_cast<std::size_t> (longest_halt_s * session.rate());

    clock.begin();
    for (std::size_t k = 0, halted_at = 0;; ++k)
    {
        if (seen.account.isOverrun()) seen.overrun = true;
        if (! halting && (stopRequested() || seen.overrun || (session.ticks() && k >= *session.ticks())))
        {
            halting = true;
            halted_at = k;
            session.engine().halt();
        }
        if (halting && session.engine().isAtRest()) break;
        if (halting && k - halted_at > longest_halt)
        {
            seen.let_go_under_force = true;
            break;
        }

        const double late = clock.wait(), begin = clock.now();
        session.tick();
        seen.account.note (late, clock.now() - begin);

        const auto& plan = session.engine().plan();
        double force = 0.0;
        for (const auto& role : plan.roles)
            force = std::max (force, role.state->applied.force.norm());
        seen.force.store (force, std::memory_order_relaxed);
        if (force > seen.peak.load (std::memory_order_relaxed)) seen.peak.store (force, std::memory_order_relaxed);
        if (ring && ! halting)
            if (auto frame = ring->next(); ! frame.empty())
            {
                for (std::size_t i = 0; i < frame.size(); ++i)
                    frame[i] = *plan.taps[i].value;
                ring->push();
            }
    }
    seen.done.store (true, std::memory_order_release);
}

void printStatus (const Seen& s, double rate_hz, bool over_the_last, const char* end)
{
    const auto& late = s.account.lateness();
    std::fprintf (stderr, "%s%8.2f s   force %6.3f N, peak %6.3f N   late p50 %.1f us, p99 %.1f us, max %.0f us, missed %zu of %zu ticks%s", over_the_last ? "\r\033[K" : "", static_cast<double> (s.account.ticks()) / rate_hz, s.force.load(), s.peak.load(),
                  1e6 * late.quantile (0.5), 1e6 * late.quantile (0.99), 1e6 * late.longest(), static_cast<std::size_t> (s.account.misses()), static_cast<std::size_t> (s.account.ticks()), end);
    std::fflush (stderr);
}

/// What runs here, for those who reach it by OSC.
class Remote : public Controlled
{
public:
    Remote (Session& s, const Seen& n) : session (s), now (n) {}

    std::optional<Message> setParam (const std::string& name, const Json& value) override { return turnParam (session.engine(), name, value); }
    std::optional<Message> turnControl (const std::string& id, double value) override { return tactus::turnControl (session.engine(), session.graph(), id, value); }

    std::variant<std::vector<std::string>, Message> probe (const std::vector<std::string>& ports) override { return session.probe (ports); }

    Status status() override
    {
        const auto ticks = now.account.ticks();
        return { session.name(), session.rate(), static_cast<double> (ticks) / session.rate(), now.force, now.peak, ticks, now.account.misses() };
    }

    void stop() override { requestStop(); }

private:
    Session& session;
    const Seen& now;
};

/// The port that others reach this by; null if nobody is to, or if it is taken and nobody asked for just this one.
std::unique_ptr<OscPort> openPort (const Options& options)
{
    if (options.osc == "off") return nullptr;
    auto opened = OscPort::open (std::stoi (options.osc));
    if (opened) return std::move (*opened);
    if (options.osc_asked_for) fail (opened.error());
    std::fprintf (stderr, "warning: %s\n", describe (opened.error()).c_str());
    return nullptr;
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

    const auto port = openPort (options);

    const bool terminal = stderrIsTerminal();
    watch.watch (session.files());

    Seen seen { session.rate() };
    Remote remote { session, seen };
    std::optional<RemoteControl> control;
    if (port) control.emplace (*port, remote);
    const auto reload = [&]
    {
        if (terminal) std::fprintf (stderr, "\r\033[K");
        const bool taken_over = session.reload();
        if (taken_over && control) control->graphChanged();
        std::fprintf (stderr, taken_over ? "%s: taken over\n" : "%s: not taken over; the graph before goes on\n", options.graph.c_str());
        watch.watch (session.files());
    };

    std::string reached;
    if (port) reached = ", OSC on 127.0.0.1:" + std::to_string (port->number());
    std::fprintf (stderr, "%s at %g Hz%s%s; Ctrl-C stops\n", (session.name().empty() ? options.graph : session.name()).c_str(), session.rate(), reached.c_str(), options.watch ? ", following its file" : "");

    if (const auto refused = lockMemory()) std::fprintf (stderr, "note: %s\n", refused->c_str());
    AbsoluteTimer timer { 1.0 / session.rate() };
    std::jthread ticking ([&]
                          {
        for (const auto& refused : becomeRealTime (options.core))
            std::fprintf (stderr, "note: %s\n", refused.c_str());
        runTicks (session, timer, ring ? &*ring : nullptr, seen); });
    const auto drain = [&]
    {
        if (ring) ring->drain ([&] (std::span<const double> frame)
                               { recorder->frame (frame); });
    };
    try
    {
        for (int i = 0; ! seen.done.load (std::memory_order_acquire); ++i)
        {
            std::this_thread::sleep_for (std::chrono::milliseconds (20));
            drain();
            if (options.watch && i % 10 == 0 && watch.look()) reload();
            if (control)
            {
                session.drainProbes ([&] (std::uint64_t tick, std::span<const double> values)
                                     { control->values (tick, values); });
                control->attend();
            }
            session.engine().clear();
            if (terminal && i % 5 == 0) printStatus (seen, session.rate(), true, "");
        }
    }
    catch (...)
    {
        requestStop();   // forces go to zero before the message ends the program
        throw;
    }
    ticking.join();
    drain();
    printStatus (seen, session.rate(), terminal, "\n");

    session.reportRun();
    if (seen.let_go_under_force)
        std::fprintf (stderr, "warning: the slew limit kept force on a device for %g s, so it was let go under force\n", longest_halt_s);
    if (ring && ring->lost() > 0)
        std::fprintf (stderr, "warning: %zu ticks were not recorded, because writing could not keep up\n", ring->lost());
    if (recorder) recorder->commit();
    if (seen.overrun)
    {
        char took[32];
        std::snprintf (took, sizeof took, "%.3f", 1e3 * seen.account.computing().quantile (0.5));
        fail ("run/overrun", "stopped, because the graph takes longer than its ticks last: " + std::string (took) + " ms of " + numberText (1e3 / session.rate()) + " ms; " + costliestNode (session.engine().plan()), "give it less to do, or a lower --rate");
    }
}
}   // namespace

void addPlay (CLI::App& app)
{
    const auto options = std::make_shared<Options>();
    auto* command = app.add_subcommand ("play", "Run a graph in real time, until its gesture or trace ends, --duration is over, or Ctrl-C");
    options->addTo (*command);
    command->add_flag ("--watch", options->watch, "Take the graph file over each time it is edited; what has not changed in it goes on");
    command->add_option ("--core", options->core, "Keep the ticks on this core of the processor")->check (CLI::Range (0, 1023));
    auto* osc = command->add_option ("--osc", options->osc, "The UDP port to be reached by from this machine, see docs/osc.md; 0 for any that is free, or off")->check (CLI::IsMember ({ "off" }) | CLI::Range (0, 65535));
    command->footer ("However it stops, the guards bring all forces to zero smoothly first.\n"
                     "With --watch, a file with errors is reported and the graph before goes on. Roles keep the devices they have\n"
                     "from the start, --set outranks the file as ever, and what is recorded stays the same.\n\n"
                     "Examples:\n"
                     "  tactus play graphs/dry_wood.json\n"
                     "  tactus play graphs/dry_wood.json --device stylus=gesture:circle --duration 10\n"
                     "  tactus play graphs/dry_wood.json --watch\n"
                     "  tactus play graphs/dry_wood.json --record drag.force,drag.state --out wood.csv");
    command->callback ([options, osc]
                       {
        options->osc_asked_for = osc->count() > 0;
        run (*options); });
}

}   // namespace tactus::host
