// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "recorder.hpp"
#include "report.hpp"
#include "session.hpp"

#include <host/osc/remote_control.hpp>
#include <host/platform/signals.hpp>
#include <host/platform/terminal.hpp>
#include <host/runtime/file_watch.hpp>
#include <host/runtime/frame_ring.hpp>
#include <host/runtime/turn.hpp>

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
using Clock = std::chrono::steady_clock;

/// A slew limit may make the way to zero long; a device that still has force on it after this is let go, with a warning.
constexpr double longest_halt_s = 30.0;

struct Options : SessionOptions
{
    bool watch = false;
    std::string osc = std::to_string (OscPort::usual);
    bool osc_asked_for = false;
};

/// What the tick thread tells the others.
struct Seen
{
    std::atomic<std::size_t> ticks { 0 }, misses { 0 };
    std::atomic<double> force { 0.0 }, peak { 0.0 }, latest_s { 0.0 };
    std::atomic<bool> let_go_under_force { false };
    std::atomic<bool> done { false };
};

/// The tick thread: waits for each deadline, ticks, notes how it went. After the last tick, or on a request to stop,
/// goes on until the guards have brought all forces to zero.
void runTicks (Session& session, FrameRing* ring, Seen& status)
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

void printStatus (const Seen& s, double rate, bool over_the_last, const char* end)
{
    std::fprintf (stderr, "%s%8.2f s   force %6.3f N, peak %6.3f N   %zu missed of %zu ticks, latest by %.3f ms%s", over_the_last ? "\r\033[K" : "", static_cast<double> (s.ticks) / rate,
                  s.force.load(), s.peak.load(), s.misses.load(), s.ticks.load(), 1e3 * s.latest_s.load(), end);
    std::fflush (stderr);
}

/// What runs here, for those who reach it by OSC.
class Remote : public Controlled
{
public:
    Remote (Session& s, const Seen& n) : session (s), now (n) {}

    std::optional<Message> setParam (const std::string& name, const Json& value) override { return turnParam (session.engine(), name, value); }
    std::optional<Message> turnControl (const std::string& id, double value) override { return host::turnControl (session.engine(), session.graph(), id, value); }

    std::variant<std::vector<std::string>, Message> probe (const std::vector<std::string>& ports) override { return session.probe (ports); }

    Status status() override
    {
        const auto ticks = now.ticks.load();
        return { session.name(), session.rate(), static_cast<double> (ticks) / session.rate(), now.force, now.peak, ticks, now.misses };
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

    Seen status;
    Remote remote { session, status };
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
            if (control)
            {
                session.drainProbes ([&] (std::uint64_t tick, std::span<const double> values)
                                     { control->values (tick, values); });
                control->attend();
            }
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
