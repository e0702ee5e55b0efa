// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_account.hpp"
#include "emergency.hpp"
#include "live_recording.hpp"
#include "play_status.hpp"
#include "remote.hpp"

#include <host/base/files/file_watch.hpp>
#include <host/base/platform/patient_output.hpp>
#include <host/base/platform/signals.hpp>
#include <host/base/platform/terminal.hpp>
#include <host/cli/command_run.hpp>
#include <host/cli/commands.hpp>
#include <host/cli/report.hpp>
#include <host/code/fuse/fuser.hpp>
#include <host/code/plugins/live_plugins.hpp>
#include <host/devices/failsafe/failsafe.hpp>
#include <host/devices/osc/osc_options.hpp>
#include <host/devices/osc/token_file.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>

namespace tactus::host
{

namespace
{
struct PlayOptions : RunOptions
{
    bool costs = false, fuse = false, untried = false;
    std::vector<std::string> live;   ///< headers of nodes
    std::string osc = std::to_string (OscPort::usual), osc_answer;
    bool osc_asked_for = false;
    std::optional<int> core;
};

/// The OSC port of the run; null if it is off, or if the default port is taken.
std::unique_ptr<OscPort> openPort (const PlayOptions& options)
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
    std::fprintf (stderr, "warning: %s\n", inOneLine (describe (opened.error())).c_str());
    return nullptr;
}

[[noreturn]] void failOverrun (Runner& runner, double rate_hz)
{
    char took[32];
    std::snprintf (took, sizeof took, "%.3f", 1e3 * runner.account().computing().quantile (0.5));
    const auto costs = runner.costs();
    const auto worst = costs.empty() ? "no node was measured" : describe (costs.front());
    fail ("run/overrun",
          "stopped, because the graph takes longer than a tick period: " + std::string (took) + " ms instead of at most "
              + numberText (1e3 / rate_hz) + " ms; " + worst,
          "simplify the graph, or use a lower --rate");
}

/// Prints a warning that the capture has failed. The run continues without the capture.
void warnOfCapture (const std::string& file, const Message& error)
{
    std::fprintf (stderr, "%s: warning: %s, and the signal to the sound card is no longer written; the run continues [%s]\n",
                  printableName (file).c_str(), inOneLine (error.text).c_str(), error.id.c_str());
}

/// The code of nodes to watch: the headers that --live names and, with --watch, the plugins that were built here. The headers are
/// compiled before the graph is read.
std::unique_ptr<LivePlugins> openLive (const PlayOptions& options)
{
    std::vector<LiveSource> sources;
    for (const auto& header : options.live)
        sources.push_back (orFail (liveHeader (header)));
    if (options.watch) std::ranges::move (liveBuilds (catalogue()), std::back_inserter (sources));
    auto live = std::make_unique<LivePlugins> (std::move (sources));
    for (const auto& header : options.live)
        std::fprintf (stderr, "compiling %s\n", printableName (header).c_str());
    if (! options.live.empty()) watchForStop();   // so that a stop also ends the compiler, which would otherwise keep running without us
    auto built = live->buildHeaders (stopRequested);
    if (stopRequested()) throw Stop {};
    for (auto& news : built)
    {
        if (report (news.messages, {}, news.file.string()) > 0) throw Stop {};
        extendCatalogue (std::move (news.types));
    }
    if (const auto prepared = live->prepare(); ! prepared) warn (options.graph, prepared.error());
    return live;
}

constexpr double look_apart_s = 0.02;   // interval between two checks of the run

/// A play command, from its first tick to its last.
class Playing
{
public:
    Playing (const PlayOptions& o, LivePlugins& l) : options (o), live (l)
    {
        watchForStop();                                    // before this there is nothing to shut down
        stops.started();                                   // by the person who entered the command
        giveUpBlockedOutputs (std::chrono::seconds (5));   // longer than usual: a recording cannot be repeated
        if (! options.outputs.empty()) command.run().add (recording.emplace (command.run(), options.outputs));
        if (port) control.emplace (*port, remote, token);
        if (options.fuse) session.fuse (Fuser::Options { .compiler = { .cache = FusionCompiler::usualCache() } });
        file_watch.watch (command.files());
    }

    ~Playing() { session.end(); }   // before the listeners are destroyed
    Playing (const Playing&) = delete;
    Playing& operator= (const Playing&) = delete;

    void play()
    {
        announce();
        const LiveSession::Start wanted { .length = command.ticks(), .length_s = command.seconds(), .core = options.core, .stop_wanted = stopRequested };
        for (const auto& refused : session.start (wanted))
            std::fprintf (stderr, "note: %s\n", refused.c_str());
        for (int i = 0; ! command.run().live().isOver(); ++i)
        {
            std::this_thread::sleep_for (std::chrono::duration<double> (look_apart_s));
            poll (i);
            if (stopRequested()) endIfStuck();
        }
        finish();
    }

private:
    void announce()
    {
        const auto& name = command.name().empty() ? options.graph : command.name();
        std::string more;
        if (command.audio().clock() != nullptr)
            more += ", ticked by the sound card";
        else if (! session.clockRole().empty())
            more += ", ticked by " + printableName (session.clockRole());
        if (port) more += ", OSC on " + port->listensTo().address + ":" + std::to_string (port->number());
        if (port) more += " (token: " + token + ")";
        if (options.watch) more += ", reloading the graph file when it is edited";
        if (live.count() > 0) more += ", compiling nodes when their code is edited";
        const auto* keys = emergency.hasKeys() ? "Ctrl-C ends the run, the space bar is the emergency stop, R rearms, S moves the workspace" : "Ctrl-C stops";
        std::fprintf (stderr, "%s at %g Hz%s; %s\n", printableName (name).c_str(), command.rate(), more.c_str(), keys);
    }

    void print (const std::string& lines)
    {
        if (! lines.empty()) std::fprintf (stderr, "%s%s", terminal ? "\r\033[K" : "", lines.c_str());
    }

    void tell (const LiveSession::Events& news)
    {
        if (news.alarm) print ("warning: " + sentence (*news.alarm) + (emergency.hasKeys() ? " (R)" : "") + " [" + news.alarm->id + "]\n");
        if (news.sound) warnOfCapture (options.capture, *news.sound);
        if (news.log)
        {
            const auto ending = news.log->id == "log/broken" ? "; the run continues\n    " + news.log->remedy : ", and the log ends here; the run continues";
            print (printableName (options.log) + ": warning: " + inOneLine (news.log->text) + printable (ending) + " [" + news.log->id + "]\n");
        }
        if (news.fusion)
        {
            if (terminal) std::fprintf (stderr, "\r\033[K");
            warn (options.graph, *news.fusion);
        }
    }

    /// Says once what is wrong with the wire or the profile of a device.
    void tellDevices()
    {
        for (const auto& h : session.health())
            if (h.warning && told.insert (h.role + " " + h.warning->id).second)
                print (printableName (h.role) + ": warning: " + inOneLine (h.warning->text) + "\n    " + printable (h.warning->remedy) + " ["
                       + h.warning->id + "]\n");
    }

    /// The work that is done every 20 ms.
    void poll (int i)
    {
        print (emergency.takeNotes());
        if (emergency.takeClutch()) turnClutch();
        if (recording) recording->drain();
        tell (session.poll());
        tellDevices();
        if (options.watch && i % 10 == 0 && file_watch.poll()) reload();
        if (i % 2 == 0)
            if (auto news = live.poll()) takeOver (*news);
        if (options.fuse) tellFusion();
        if (control)
        {
            command.probes().drain ([&] (std::uint64_t tick, std::span<const double> values) { control->values (tick, values); });
            control->poll();
            if (port->dropped() > 0 && ! std::exchange (told_of_losses, true))
                print ("warning: an OSC message was dropped; the end of the run says how many, and why [osc/dropped]\n");
        }
        if (i % 5 != 0 || ! terminal) return;
        const auto fusion = options.fuse ? "   " + session.fuser()->describe() : std::string {};
        const auto more = statusOf (session.health(), session.deviceClock()) + statusOf (command.audio().status()) + fusion;
        printStatus (command.run().live(), command.rate(), true, more, false);
    }

    /// Lets the workspaces move with the hand, or stay. The force of a workspace that moves is zero, so it does not matter that this waits for the main
    /// thread.
    void turnClutch()
    {
        const bool may_move = session.holdWorkspaces (! holds_clutch);
        holds_clutch = may_move && ! holds_clutch;
        if (! may_move)
            print ("S moves the workspace of a device; this run has no device whose position its graph reads\n");
        else
            print (holds_clutch ? "the workspace moves with the hand, without force; press S again to end this\n"
                                : "the workspace stays; the force comes back along the ramp\n");
    }

    /// Says once that compiled code has taken over.
    void tellFusion()
    {
        const bool is_fused = session.fuser()->state() == Fuser::State::fused;
        if (is_fused && ! std::exchange (was_fused, is_fused)) print (printableName (options.graph) + ": fused " + session.fuser()->account() + "\n");
        was_fused = is_fused;
    }

    void reload()
    {
        if (terminal) std::fprintf (stderr, "\r\033[K");
        const bool taken_over = command.reload();
        if (taken_over && control) control->graphChanged();
        std::fprintf (stderr, taken_over ? "%s: reloaded\n" : "%s: not reloaded; the previous graph keeps running\n", printableName (options.graph).c_str());
        file_watch.watch (command.files());
    }

    /// Ends the program if a stop was requested, but the tick does not end: a plugin loops, or a file asks for too much. The writing threads
    /// have already sent the neutral reports, because the ticks have stopped; the guardian sends them again, and the exit steps.
    void endIfStuck()
    {
        const auto ticks = command.run().live().status().ticks;
        looks_without_tick = ticks == last_ticks ? looks_without_tick + 1 : 0;
        last_ticks = ticks;
        if (looks_without_tick * look_apart_s < std::max (2.0, 5.0 / command.rate())) return;
        std::fprintf (stderr,
                      "%serror: a tick does not end, so the program ends without finishing its files\n"
                      "    the graph asks for too much in one tick, or a plugin loops; `tactus check-plugin` examines plugins [run/stuck]\n",
                      terminal ? "\n" : "");
        emergency.restoreTerminal();
        std::_Exit (1);
    }

    /// Uses a new version of the code of a node.
    void takeOver (LivePlugins::RebuiltPlugin& news)
    {
        if (terminal) std::fprintf (stderr, "\r\033[K");
        report (news.messages, {}, news.file.string());
        const bool is_built = ! news.types.empty();
        if (is_built) extendCatalogue (std::move (news.types));
        const bool taken_over = is_built && command.reload();
        if (taken_over && control) control->graphChanged();
        const auto name = printableName (news.file.string());
        if (taken_over)
            std::fprintf (stderr, "%s: in use %.1f s after it was saved\n", name.c_str(), news.secondsSinceSaved());
        else
            std::fprintf (stderr, "%s: not in use; the previous version keeps running\n", name.c_str());
    }

    void finish()
    {
        print (emergency.takeNotes());
        const auto sound = command.audio().status();   // before the card is released
        const auto ended = session.end();
        if (! ended.sound) warnOfCapture (options.capture, ended.sound.error());
        auto& runner = command.run().live();
        printStatus (runner, command.rate(), terminal, "", true);

        std::fputs (accountOf (session.realDevices(), session.pluginRoles(), session.health(), session.deviceClock()).c_str(), stderr);
        std::fputs (accountOf (sound).c_str(), stderr);
        if (const auto losses = port ? port->losses() : std::string(); ! losses.empty())
            std::fprintf (stderr, "OSC: packets or messages dropped: %s\n", losses.c_str());
        command.reportRun();
        const auto end = runner.status();
        if (end.let_go_under_force)
            std::fprintf (stderr, "warning: after %g s the slew limit still held force on a device, so the device was released before its force reached zero\n",
                          Runner::longest_halt_s);
        const auto not_recorded = recording ? recording->commit() : std::nullopt;
        if (options.costs) printCosts (runner);
        if (! ended.log) fail (ended.log.error());
        if (not_recorded) fail (*not_recorded);
        if (end.end == RunStatus::End::overrun) failOverrun (runner, command.rate());
    }

    const PlayOptions& options;
    LivePlugins& live;
    FileWatch file_watch { { options.graph } };   // before the file is read, so that no edit is missed
    StopSwitch stops;
    CommandRun command { options, CommandRun::Pace::live, &stops };
    LiveSession& session = command.session();
    std::optional<LiveRecording> recording;
    const std::unique_ptr<OscPort> port = openPort (options);
    Emergency emergency { session, stops };
    Remote remote { command, stops };
    const std::string token = randomToken();
    const std::optional<TokenFile> token_file = port ? std::optional<TokenFile> (std::in_place, port->number(), token) : std::nullopt;
    std::optional<RemoteControl> control;
    bool was_fused = false, holds_clutch = false, told_of_losses = false;
    const bool terminal = stderrIsTerminal();

    std::uint64_t last_ticks = 0;
    std::set<std::string> told;   // roles and ids of warnings about devices
    int looks_without_tick = 0;   // counted in checks and not in seconds, so that a suspended program does not count
};

void run (const PlayOptions& options)
{
    if (! options.records.empty() && options.outputs.empty())
        throw UsageError ("--record names what to record but not where: --out FILE is required");
#if ! defined(__linux__)
    if (options.untried) Failsafe::allowUnguarded();
#endif
    holdEmergencySignals();   // so that only the thread of the emergency stop handles them
    const auto live = openLive (options);
    Playing { options, *live }.play();
}
}   // namespace

void addPlay (const Command& app)
{
    const auto options = std::make_shared<PlayOptions>();
    const auto command = app.add ("play", "Run a graph in real time until its gesture or trace ends, --duration is over, or you press Ctrl-C");
    options->addTo (command);
    command.addFlag ("--watch", options->watch,
                     "Play until Ctrl-C, repeating gestures; reload the graph file whenever it is edited, and compile plugins whose code is edited. "
                     "Unchanged parts keep running");
    command.addOption ("--live", options->live,
                       "The header of a node: compile it, and again whenever it is edited (docs/plugins.md); may be given more than once")
        .oneValueEach();
#if ! defined(__linux__)
    command.addFlag ("--untried", options->untried,
                     "Open devices with forces, although nothing brings them to rest if this program dies, and none was tried on this system "
                     "(docs/windows.md)");
#endif
    command.addFlag ("--fuse", options->fuse,
                     "Compile the graph while it plays, and switch to the compiled code, which computes the same in less time (docs/fusion.md)");
    command.addFlag ("--costs", options->costs, "At the end, list the most expensive nodes");
    command.addOption ("--log", options->log, "Log all inputs, for `tactus render --replay`: see docs/replay.md");
    command.addOption ("--core", options->core, "Pin the tick thread to this CPU core").check (within (0, 1023));
    command.addOption ("--clock", options->clock,
                       "What ticks the run: a role (its HID device, at the rate of its reports), audio (the sound card) or timer; "
                       "default: the session's choice, else the first device that can tick the run, unless there is a --rate or --feed");
    command.addOption ("--session", options->session,
                       "The session that binds roles to devices: a file (docs/sessions.md), or off; default: the user's session, as shown by `tactus session`");
    command.addFlag ("--strict", options->strict,
                     "End the run if a device of the session is missing; without this option, the run waits for the device, and its role gets no force");
    command.addOption ("--route", options->routes,
                       "PORT=CHANNEL[@FULLSCALE]: play a port on a channel of the sound card, as in mix.out=3@\"4 N\"; may be given more than once")
        .oneValueEach();
    command.addOption ("--audio", options->card, "The sound card: TYPE:NAME, TYPE or NAME, as `tactus devices` lists them");
    command.addOption ("--capture", options->capture, "Write the signal to the sound card into this WAV file");
    const auto* osc_help = "The UDP port for OSC from this machine (docs/osc.md); 0 for any free port, off, or ADDRESS:PORT for OSC from other machines too";
    const auto osc = command.addOption ("--osc", options->osc, osc_help).check (oscCheck());
    command.addOption ("--osc-answer", options->osc_answer, "Address of the only other machine that gets answers, such as 192.168.1.7").check (addressCheck());
    command.footer ("However the run stops, the guards first bring all forces smoothly to zero. The space bar or SIGUSR1 is the emergency\n"
                    "stop: no forces, but the graph keeps running. R, pressed at least a second later, rearms;\n"
                    "this also ends a stop that a limit caused. S lets the workspaces of real devices move with the hand, without force,\n"
                    "until S is pressed again.\n"
                    "With --watch, a file with errors is reported and the previous graph keeps running. Roles keep their devices,\n"
                    "a new role gets its own, --set still takes precedence over the file, and the recorded ports stay the same.\n\n"
                    "Examples:\n"
                    "  tactus play graphs/dry_wood.json\n"
                    "  tactus play graphs/dry_wood.json --device stylus=gesture:circle --duration 10\n"
                    "  tactus play graphs/dry_wood.json --device stylus=hid:auto\n"
                    "  tactus play graphs/dry_wood.json --watch\n"
                    "  tactus play my_graph.json --live rough_wood/rough_wood.hpp\n"
                    "  tactus play graphs/dry_wood.json --record drag.force,drag.state --out wood.csv\n"
                    "  tactus play graphs/steel_bar.json --route ring.value=1@\"2 N\" --audio JACK\n"
                    "  tactus play graphs/dry_wood.json --log wood.jsonl");
    command.callback ([options, osc] {
        options->osc_asked_for = osc.isGiven();
        run (*options);
    });
}

}   // namespace tactus::host
