// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "emergency.hpp"
#include "live_recording.hpp"
#include "play_status.hpp"
#include "remote.hpp"
#include "report.hpp"

#include <framework/number_text.hpp>
#include <host/osc/osc_options.hpp>
#include <host/platform/signals.hpp>
#include <host/platform/terminal.hpp>
#include <host/runtime/file_watch.hpp>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

namespace tactus::host
{

namespace
{
struct Options : SessionOptions
{
    bool watch = false, costs = false;
    std::string osc = std::to_string (OscPort::usual), osc_answer;
    bool osc_asked_for = false;
    std::optional<int> core;
};

/// The port that others reach this by; null if nobody is to, or if it is taken and nobody asked for just this one.
std::unique_ptr<OscPort> openPort (const Options& options)
{
    if (options.osc == "off") return nullptr;
    auto listen = readListen (options.osc).value();
    listen.answered = options.osc_answer;
    auto opened = OscPort::open (listen);
    if (opened)
    {
        if (const auto warning = warningOf (listen); ! warning.empty()) std::fprintf (stderr, "warning: %s\n", warning.c_str());
        return std::move (*opened);
    }
    if (options.osc_asked_for) fail (opened.error());
    std::fprintf (stderr, "warning: %s\n", describe (opened.error()).c_str());
    return nullptr;
}

/// The clock that a device of the run is; null if none is to tick it.
std::unique_ptr<RunClock> clockOf (const Session& session)
{
    for (const auto& real : session.realDevices())
        if (real.role == session.clockRole())
            return real.present != nullptr ? std::make_unique<RunClock> (*real.present, session.rate()) : std::make_unique<RunClock> (*real.awaited, session.rate());
    return nullptr;
}

[[noreturn]] void failOverrun (Runner& runner, double rate_hz)
{
    char took[32];
    std::snprintf (took, sizeof took, "%.3f", 1e3 * runner.account().computing().quantile (0.5));
    const auto costs = runner.costs();
    fail ("run/overrun", "stopped, because the graph takes longer than its ticks last: " + std::string (took) + " ms of " + numberText (1e3 / rate_hz) + " ms; " + (costs.empty() ? "no node was measured" : describe (costs.front())), "give it less to do, or a lower --rate");
}

/// The run goes on without it.
void warn (const std::string& file, const Error& error) { std::fprintf (stderr, "%s: warning: %s, and what the sound card is given is not written any more; the run goes on [%s]\n", file.c_str(), error.what.c_str(), error.id.c_str()); }

void run (const Options& options)
{
    if (! options.records.empty() && options.outputs.empty())
        throw CLI::RequiredError ("--record names what to record, but not where to: --out FILE");
    FileWatch watch { { options.graph } };   // before it is read, so that no edit is missed
    Session session { options, Session::Pace::live };
    watchForStop();   // until now there was nothing that had to be brought to an end
    std::optional<LiveRecording> recording;
    if (! options.outputs.empty()) recording.emplace (session, options.outputs);
    const auto port = openPort (options);
    watch.watch (session.files());

    AbsoluteTimer timer { 1.0 / session.rate() };
    const auto device_clock = clockOf (session);
    auto& audio = session.audio();
    TickClock& clock = audio.clock() ? *audio.clock() : device_clock ? static_cast<TickClock&> (*device_clock)
                                                                     : timer;
    Runner runner { session.engine(), clock, session.rate(), { .length = session.ticks(), .core = options.core, .stop_wanted = stopRequested, .hooks = recording ? static_cast<TickHooks*> (&*recording) : &session } };
    Emergency emergency { session.engine() };
    Remote remote { session, runner };
    std::optional<RemoteControl> control;
    if (port) control.emplace (*port, remote);

    const bool terminal = stderrIsTerminal();
    const auto reload = [&]
    {
        if (terminal) std::fprintf (stderr, "\r\033[K");
        const bool taken_over = session.reload();
        if (taken_over && control) control->graphChanged();
        std::fprintf (stderr, taken_over ? "%s: taken over\n" : "%s: not taken over; the graph before goes on\n", options.graph.c_str());
        watch.watch (session.files());
    };

    std::string reached;
    if (port) reached = ", OSC on " + port->listensTo().address + ":" + std::to_string (port->number());
    const auto ticked_by = audio.clock() ? std::string (", ticked by the sound card") : device_clock ? ", ticked by " + session.clockRole()
                                                                                                     : std::string();
    std::fprintf (stderr, "%s at %g Hz%s%s%s; %s\n", (session.name().empty() ? options.graph : session.name()).c_str(), session.rate(), ticked_by.c_str(), reached.c_str(), options.watch ? ", following its file" : "", emergency.hasKeys() ? "Ctrl-C ends it, the space bar is the emergency stop, R lets go on" : "Ctrl-C stops");

    for (const auto& refused : runner.start())
        std::fprintf (stderr, "note: %s\n", refused.c_str());
    HealthWatch health { session.clockRole() };
    for (int i = 0; ! runner.isOver(); ++i)
    {
        std::this_thread::sleep_for (std::chrono::milliseconds (20));
        emergency.attend();   // before all that may take a while
        if (recording) recording->drain();
        session.drainLog();
        if (const auto error = audio.attend()) warn (options.capture, *error);
        if (options.watch && i % 10 == 0 && watch.look()) reload();
        if (control)
        {
            session.drainProbes ([&] (std::uint64_t tick, std::span<const double> values)
                                 { control->values (tick, values); });
            control->attend();
        }
        runner.attend();
        if (i % 5 == 0) health.look (session.realDevices());
        if (terminal && i % 5 == 0) printStatus (runner, session.rate(), true, (statusOf (health.health(), device_clock.get()) + statusOf (audio.status())).c_str());
    }
    runner.wait();
    const auto sound = audio.status();   // before the card is let go
    if (const auto error = audio.end()) warn (options.capture, *error);
    const auto log_failure = session.finishLog();
    printStatus (runner, session.rate(), terminal, "\n");

    std::fputs (accountOf (session.realDevices(), health.health(), device_clock.get()).c_str(), stderr);
    std::fputs (accountOf (sound).c_str(), stderr);
    session.reportRun();
    const auto end = runner.status();
    if (end.let_go_under_force)
        std::fprintf (stderr, "warning: the slew limit kept force on a device for %g s, so it was let go under force\n", Runner::longest_halt_s);
    const auto not_recorded = recording ? recording->commit() : std::nullopt;
    if (options.costs) printCosts (runner);
    if (log_failure) fail (*log_failure);
    if (not_recorded) fail (*not_recorded);
    if (end.end == RunStatus::End::overrun) failOverrun (runner, session.rate());
}
}   // namespace

void addPlay (CLI::App& app)
{
    const auto options = std::make_shared<Options>();
    auto* command = app.add_subcommand ("play", "Run a graph in real time, until its gesture or trace ends, --duration is over, or Ctrl-C");
    options->addTo (*command);
    command->add_flag ("--watch", options->watch, "Take the graph file over each time it is edited; what has not changed in it goes on");
    command->add_flag ("--costs", options->costs, "At the end, say what the costliest nodes took of a tick");
    command->add_option ("--log", options->log, "Write down all that comes in, for `tactus render --replay`: see docs/replay.md");
    command->add_option ("--core", options->core, "Keep the ticks on this core of the processor")->check (CLI::Range (0, 1023));
    command->add_option ("--clock", options->clock, "The role whose HID device ticks the run, at the rate of its reports, audio for the sound card, or timer; default: as the session has it, else the first that can, unless there is a --rate or --feed");
    command->add_option ("--session", options->session, "Which devices the roles are bound to: a file (docs/sessions.md), or off; default: the user's, as `tactus session` shows it");
    command->add_flag ("--strict", options->strict, "A device of the session that is not there ends the run; without, it is waited for, and nothing pushes meanwhile");
    command->add_option ("--route", options->routes, "PORT=CHANNEL[@FULLSCALE]: play a port on a channel of the sound card, as in mix.out=3@\"4 N\"; may be given more than once")->allow_extra_args (false);
    command->add_option ("--audio", options->card, "The sound card: TYPE:NAME, TYPE or NAME, as `tactus devices` lists them");
    command->add_option ("--capture", options->capture, "A WAV of what the sound card is given");
    auto* osc = command->add_option ("--osc", options->osc, "The UDP port to be reached by from this machine, see docs/osc.md; 0 for any that is free, off, or ADDRESS:PORT to be reached by others too")->check (oscCheck());
    command->add_option ("--osc-answer", options->osc_answer, "The one other machine that gets answers, by its address: 192.168.1.7")->check (addressCheck());
    command->footer ("However it stops, the guards bring all forces to zero smoothly first. The space bar, or SIGUSR1, is the emergency\n"
                     "stop: no forces, and the graph goes on; R, or SIGUSR2, lets them rise again, after a stop by a limit too.\n"
                     "With --watch, a file with errors is reported and the graph before goes on. Roles keep the devices they have,\n"
                     "a new one gets its own, --set outranks the file as ever, and what is recorded stays the same.\n\n"
                     "Examples:\n"
                     "  tactus play graphs/dry_wood.json\n"
                     "  tactus play graphs/dry_wood.json --device stylus=gesture:circle --duration 10\n"
                     "  tactus play graphs/dry_wood.json --device stylus=hid:auto\n"
                     "  tactus play graphs/dry_wood.json --watch\n"
                     "  tactus play graphs/dry_wood.json --record drag.force,drag.state --out wood.csv\n"
                     "  tactus play graphs/steel_bar.json --route bar.value=1@\"2 N\" --audio JACK\n"
                     "  tactus play graphs/dry_wood.json --log wood.jsonl");
    command->callback ([options, osc]
                       {
        options->osc_asked_for = osc->count() > 0;
        run (*options); });
}

}   // namespace tactus::host
