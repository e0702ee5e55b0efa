// SPDX-License-Identifier: MIT
#include "trial.hpp"
#include "free_motion.hpp"

#include <host/devices/device_plugins/plugin_device.hpp>
#include <tactus/check/factors.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <thread>
#include <utility>

namespace tactus::host
{

namespace
{
using namespace std::chrono_literals;

constexpr double push_s = 1.0, still_s = 1.0, frozen_s = 0.3, pushes_after_s = 0.2;
constexpr double wall_below = 5e-3;                          // m below the tool
constexpr double free_push_s = 1.5, pushed_travel = 1e-2;    // m
constexpr double least_move = 5e-3, clear_of_others = 2.0;   // m, and how much larger than along the other axes
constexpr int most_tries = 3;                                // at homing

/// A direction, in the words of a person.
struct Direction
{
    const char* name;
    int axis;
    double sign;
};
constexpr std::array<Direction, 6> directions { {
    { "right", 0, 1.0 },
    { "left", 0, -1.0 },
    { "away", 1, 1.0 },
    { "towards", 1, -1.0 },
    { "up", 2, 1.0 },
    { "down", 2, -1.0 },
} };
constexpr const char* ways_round = "right, left, away (from you), towards (you), up, down or none";

std::string mm (const Vec3& v)
{
    char text[96];
    std::snprintf (text, sizeof text, "%+.2f, %+.2f, %+.2f mm", 1e3 * v.x(), 1e3 * v.y(), 1e3 * v.z());
    return text;
}

std::string rounded (double v) { return roundedText (v, 3); }

/// Thrown where a person ends the trial; the report says so.
struct Ended
{
};

class Trial
{
public:
    Trial (Device& d, const GuardLimits& l, const TrialSetting& s, TrialPerson& p) : device (d), limits (l), setting (s), person (p) {}

    Json report()
    {
        try
        {
            if (! isHomed()) throw Ended {};
            measureStill();
            for (const auto* name : { "right", "away", "up" })
                tryDirection (named (name));
            tryButtons();
            for (const auto& direction : directions)
                tryPush (direction);
            tryWalls (findDamping());
            tryStops();
            tryCable();
        }
        catch (const Ended&)
        {
            add ("end", "not tried", "the trial ended here; no later step was tried");
        }
        add ("kill -9, a frozen computer", "not tried", "a trial cannot watch its own end; docs/hazards.md says what should happen");
        Json all { { "format", "tactus-trial" }, { "version", 1 }, { "tried", setting.tried } };
        all["steps"] = steps;
        all["numbers"] = numbers;
        all["capture"] = capture;
        return all;
    }

private:
    static const Direction& named (std::string_view name)
    {
        return *std::ranges::find (directions, name, [] (const Direction& d) { return std::string_view (d.name); });
    }

    void add (const std::string& step, const char* verdict, const std::string& text)
    {
        steps.push_back ({ { "step", step }, { "verdict", verdict }, { "text", text } });
        person.tell (step + ": " + verdict + (text.empty() ? "" : "; " + text));
    }

    std::string ask (const std::string& question)
    {
        auto answer = person.ask (question);
        if (! answer) throw Ended {};
        std::ranges::transform (*answer, answer->begin(), [] (char c) { return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c; });
        return *std::move (answer);
    }

    bool saysYes (const std::string& question)
    {
        for (;;)
        {
            const auto answer = ask (question + " (yes or no)");
            if (answer == "yes" || answer == "y") return true;
            if (answer == "no" || answer == "n") return false;
        }
    }

    TrialRun::Options options (double max_force, double length_s = 0.0) const
    {
        auto o = setting.run;
        o.max_force = max_force;
        o.length = static_cast<std::uint64_t> (setting.pace * length_s * o.rate_hz);
        return o;
    }

    /// A run without a force, while a person does something.
    template <typename F>
    std::unique_ptr<TrialRun> watch (F&& meanwhile)
    {
        auto run = std::make_unique<TrialRun> (device, limits, TrialGraph {}, options (0.0));
        meanwhile();
        const auto from = run->ticks();
        while (run->ticks() < from + 20 && ! run->isOver())   // what the person has done last counts, too
            std::this_thread::sleep_for (1ms);
        run->end();
        return run;
    }

    /// A run with a force, for a time. False if the person has stopped it.
    bool play (TrialRun& run)
    {
        bool was_stopped = false;
        while (! run.isOver())
        {
            std::this_thread::sleep_for (2ms);
            if (was_stopped || ! person.wantsStop()) continue;
            was_stopped = true;
            run.emergencyStop();
            run.stop();
        }
        wait (run);
        return ! was_stopped;
    }

    /// The end of a run with a length, which Enter does not stop.
    void wait (TrialRun& run) const
    {
        run.end();
        if (setting.run.stop_wanted != nullptr && setting.run.stop_wanted()) throw Ended {};
    }

    void keep (const std::string& name, const TrialGraph& graph, const TrialRun& run)
    {
        auto rows = Json::array();
        for (const auto& r : run.rows())
            if (! r.halts)
                rows.push_back (Json::array ({ r.position.x(), r.position.y(), r.position.z(),
                                               r.is_valid, r.asked.x(), r.asked.y(), r.asked.z() }));
        capture.push_back ({ { "name", name }, { "graph", Json::tryParse (graph.text (setting.run.rate_hz)).value() }, { "rows", std::move (rows) } });
    }

    //==========================================================================
    bool isHomed()
    {
        for (int tries = 0;; ++tries)
        {
            TrialRun run (device, limits, {}, options (0.0, 0.5));
            wait (run);
            const auto& last = run.last();
            if (last.is_valid)
            {
                add ("homing", "as expected", tries == 0 ? "it knew its position at once" : "it knew its position after a person had homed it");
                return true;
            }
            const std::string why (describe (last.fault));
            if (last.fault != ReadingFault::not_homed || tries == most_tries)
            {
                add ("homing", "differs", "no reading can be used: " + (why.empty() ? "none came" : why));
                return false;
            }
            ask ("The device does not know its position. Move each axis to both of its ends by hand, or put its stylus into the inkwell. Then press Enter.");
        }
    }

    /// Noise, quantum, rate and age of readings.
    void measureStill()
    {
        ask ("Lay the tool down, or let it hang, so that nothing moves. Then press Enter, and wait for a second.");
        const auto* plugin = dynamic_cast<const PluginDevice*> (&device);
        const auto readings = plugin != nullptr ? plugin->counts().readings : 0;
        const auto begin = std::chrono::steady_clock::now();
        TrialRun run (device, limits, {}, options (0.0, still_s));
        wait (run);
        const double took_s = std::chrono::duration<double> (std::chrono::steady_clock::now() - begin).count();
        Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
        double quantum = 0.0, n = 0.0;
        const TrialRow* before = nullptr;
        Position origin = Position::Zero();
        for (const auto& row : run.rows())
        {
            if (! row.is_valid) continue;
            if (before == nullptr) origin = row.position;
            // In space: where each encoder moves the tool along all axes, the steps along one axis may be as small as one likes.
            if (const double step = before != nullptr ? (row.position - before->position).norm() : 0.0; step > 0.0)
                quantum = quantum > 0.0 ? std::min (quantum, step) : step;
            for (int i = 0; i < 3; ++i)
            {
                const auto off = row.position[i] - origin[i];
                sum[i] += off;
                squares[i] += off * off;
            }
            n += 1.0;
            before = &row;
        }
        if (n < 2.0) return add ("noise", "differs", "no reading could be used while the tool was still");
        const Vec3 noise = (squares / n - (sum / n).cwiseProduct (sum / n)).cwiseMax (0.0).cwiseSqrt();
        const auto step = quantum > 0.0 ? rounded (1e6 * quantum) + " um" : std::string ("none, nothing changed");
        add ("noise", "measured", "standard deviation along x, y, z: " + mm (noise) + "; smallest step between two readings: " + step);
        delay_s = run.meanAge();
        auto text = "age of a reading at its tick: " + rounded (1e3 * delay_s) + " ms on average, " + rounded (1e3 * run.oldest()) + " ms at most";
        if (plugin != nullptr) text += "; " + rounded (static_cast<double> (plugin->counts().readings - readings) / took_s) + " readings per second";
        const int told = indexOf (device.layout().axes, "delay");
        if (const double by_driver = device.read().axes[told]; by_driver > 0.0)
        {
            delay_s = by_driver;
            text += "; from a place to the force that answers it, by the driver: " + rounded (1e3 * by_driver) + " ms";
        }
        else
            text += "; how long a force takes to the motors is not measured";
        add ("rate and delay", "measured", text);
        numbers["delay_s"] = delay_s;
        if (quantum > 0.0) numbers["quantum"] = quantum;
    }

    void tryDirection (const Direction& d)
    {
        const auto name = "direction " + std::string (d.name);
        const auto place = [&] (const std::string& question) { return watch ([&] { ask (question); })->last(); };
        const auto from = place ("Hold the tool still, near the middle of its space. Then press Enter.");
        const auto to = place ("Move it about 5 cm " + wordsOf (d) + ", hold it there, and press Enter.");
        if (! from.is_valid || ! to.is_valid) return add (name, "differs", "a reading could not be used");
        const Vec3 moved = to.position - from.position;
        Vec3 others = moved.cwiseAbs();
        others[d.axis] = 0.0;
        const double along = d.sign * moved[d.axis];
        const bool fits = along > least_move && along > clear_of_others * others.maxCoeff();
        add (name, fits ? "as expected" : "differs", "the reading moved by " + mm (moved));
    }

    static std::string wordsOf (const Direction& d)
    {
        const std::string name = d.name;
        return name == "right" || name == "left" ? "to the " + name : name == "away"  ? "away from you"
                                                                  : name == "towards" ? "towards you"
                                                                                      : name;
    }

    void tryButtons()
    {
        const auto names = device.layout().buttons;
        if (names.empty()) return add ("buttons", "not tried", "the device names none");
        const auto run = watch ([&] { ask ("Press each button of the tool once. Then press Enter."); });
        std::string seen, unseen;
        for (std::size_t i = 0; i < names.size(); ++i)
            addToList ((run->buttons() >> i & 1u) != 0 ? seen : unseen, names[i]);
        add ("buttons", "measured", "pressed: " + (seen.empty() ? "none" : seen) + "; not seen: " + (unseen.empty() ? "none" : unseen));
    }

    void tryPush (const Direction& d)
    {
        const auto name = "push " + std::string (d.name);
        ask ("Hold the tool loosely, and press Enter: it is pushed for a second, with " + numberText (trial_push) + " N. Enter stops it.");
        TrialGraph graph;
        graph.push[d.axis] = d.sign * trial_push;
        TrialRun run (device, limits, graph, options (trial_push, push_s));
        const bool whole = play (run);
        keep (name, graph, run);
        if (! whole) return add (name, "not tried", "the person stopped it");
        const auto first = std::ranges::find_if (run.rows(), &TrialRow::is_valid);
        const Vec3 moved = first != run.rows().end() ? Vec3 (run.last().position - first->position) : Vec3 (Vec3::Zero());
        double acting = 0.0;
        for (const auto& row : run.rows())
            acting = std::max (acting, row.acting.norm());
        const auto felt = ask ("Which way did it push: " + std::string (ways_round) + "?");
        add (name, felt == d.name && acting > 0.0 ? "as expected" : "differs",
             "the person felt: " + (felt.empty() ? "nothing said" : felt) + "; the reading moved by " + mm (moved) + "; the guard let " + rounded (acting)
                 + " N through");
    }

    /// The smallest damping, in N s/m, that the device may have: as it tells, or measured; 0 if nothing tells it, and then no wall is passive.
    double findDamping()
    {
        if (const double told = device.layout().mechanics.damping; told > 0.0)
        {
            add ("damping", "not tried", numberText (told) + " N s/m, as the device is described");
            return told;
        }
        const auto unknown = [this] (const std::string& why) {
            add ("damping", "not tried", "it is not known: " + why);
            return 0.0;
        };
        if (! saysYes ("Nothing tells the damping of this device, so it is measured. Can you let go of the tool, so that it stays where it is, with 6 cm of "
                       "free space to its right and to its left?"))
            return unknown ("a tool in a hand moves with the damping of the hand");
        ask ("Put it into the middle of its space, let go of it, and press Enter: it is pushed four times, to the right and to the left, with "
             + numberText (trial_push) + " N for 1 cm. Enter stops it.");
        std::vector<FreePush> pushes;
        for (int i = 0; i < free_pushes; ++i)
        {
            pushes.push_back ({ .direction = i % 2 == 0 ? Vec3 (Vec3::UnitX()) : Vec3 (-Vec3::UnitX()), .rows = {} });
            auto o = options (trial_push, free_push_s);
            o.most_travel = pushed_travel;
            TrialRun run (device, limits, { .push = trial_push * pushes.back().direction }, o);
            if (! play (run)) return unknown ("the person stopped a push");
            pushes.back().rows = run.rows();
        }
        std::string why;
        const auto found = mechanicsOf (pushes, std::max (delay_s, 1.0 / setting.run.rate_hz), why);
        if (! found) return unknown (why);
        const auto range = [] (const Between& b) { return rounded (b.least) + " to " + rounded (b.most); };
        add ("damping", "measured",
             range (found->damping) + " N s/m, with a mass of " + range (found->mass) + " kg and a friction of " + range (found->friction)
                 + " N, by four pushes of the free tool. The smallest damping counts.");
        numbers["mass"] = 0.5 * (found->mass.least + found->mass.most);
        numbers["damping"] = std::max (0.0, found->damping.least);
        numbers["coulomb"] = std::max (0.0, found->friction.least);
        return found->damping.least;
    }

    void tryWalls (double damping)
    {
        if (damping <= 0.0) return add ("walls", "not tried", "the device may have no damping, as far as is known, and then no wall is passive on it");
        const double delay_ticks = delay_s * setting.run.rate_hz;
        const double stiffest = check::stiffestWall (damping, 1.0 / setting.run.rate_hz, delay_ticks);
        for (const double part : { 0.25, 0.5, 1.0 })
        {
            const auto here = watch ([&] { ask ("Hold the tool in the middle of its space, and press Enter. For ten seconds, there is a wall "
                                                + rounded (1e3 * wall_below) + " mm below it. Press on it. Enter ends it."); })->last();
            const TrialGraph graph { .stiffness = part * stiffest, .offset = here.position.z() - wall_below };
            const auto name = "wall of " + rounded (graph.stiffness) + " N/m";
            TrialRun run (device, limits, graph, options (trial_wall, 10.0));
            play (run);
            keep (name, graph, run);
            const bool was_touched = std::ranges::any_of (run.rows(), [] (const TrialRow& r) { return r.asked.norm() > 0.0; });
            if (! was_touched)
                add (name, "not tried", "the tool did not reach it");
            else if (saysYes ("Did it buzz?"))
                return add (name, "differs", "it buzzed, at " + rounded (100.0 * part) + " % of the stiffest passive wall; no stiffer one was tried");
            else
                add (name, "as expected", "no buzz, at " + rounded (100.0 * part) + " % of the stiffest passive wall");
        }
    }

    //==========================================================================
    void tryStops()
    {
        tryStop ("Enter", "Press Enter while it pushes up.", [this] (TrialRun& run) {
            waitFor (run, pushes_after_s);   // a person who presses Enter at once would otherwise stop the push before it begins
            const bool goes_on = person.ask ("It pushes up now. Press Enter to stop it.").has_value();
            run.emergencyStop();
            if (! goes_on) throw Ended {};
        });
        for (const auto& way : setting.ways)
            tryStop (way.name, "The tool is pushed up, and stopped by " + way.name + ".", [&] (TrialRun& run) {
                waitFor (run, push_s);
                way.press (run);
            });
        tryStop ("the end of the run", "The tool is pushed up, and the run ends as with Ctrl-C.", [this] (TrialRun& run) {
            waitFor (run, push_s);
            run.stop();
        });
        tryFreeze();
    }

    /// The last step, because the device is away afterwards.
    void tryCable()
    {
        if (! saysYes ("Last, the cable: the tool is pushed up, and you pull the cable of the device out of the computer. Will you do that?"))
            return add ("a pulled cable", "not tried", "the person did not want to");
        TrialRun run (device, limits, up(), options (trial_push));
        const bool goes_on = person.ask ("It pushes up now. Pull the cable, then press Enter.").has_value();
        waitFor (run, push_s);
        run.end();
        if (! goes_on) throw Ended {};
        const bool felt_end = saysYes ("Has the push ended?");
        add ("a pulled cable", run.hasLost() && felt_end ? "as expected" : "differs",
             std::string (run.hasLost() ? "the readings ended" : "the readings went on") + "; the person felt the push " + (felt_end ? "end" : "go on"));
    }

    void waitFor (const TrialRun& run, double s) const
    {
        const auto until = run.ticks() + static_cast<std::uint64_t> (setting.pace * s * setting.run.rate_hz);
        while (run.ticks() < until && ! run.isOver())
            std::this_thread::sleep_for (2ms);
    }

    template <typename F>
    void tryStop (const std::string& way, const std::string& announced, F&& press)
    {
        const auto name = "stop by " + way;
        ask (announced + " Hold it loosely, and press Enter.");
        TrialRun run (device, limits, up(), options (trial_push));
        press (run);
        const auto pressed_at = run.ticks();
        waitFor (run, 0.5);
        run.end();
        std::size_t last_force = 0;
        bool pushed = false;
        for (std::size_t i = 0; i < run.rows().size(); ++i)
            if (! run.rows()[i].acting.isZero (0.0)) last_force = i, pushed = true;
        const bool ended = ! run.rows().empty() && run.rows().back().acting.isZero (0.0);
        const double ms = last_force > pressed_at ? 1e3 * static_cast<double> (last_force - pressed_at) / setting.run.rate_hz : 0.0;
        const bool felt_end = saysYes ("Has the push ended?");
        add (name, pushed && ended && felt_end ? "as expected" : "differs",
             ! pushed ? "nothing was pushed"
                      : "the force was " + (ended ? "zero " + rounded (ms) + " ms later" : std::string ("not zero at the end")) + "; the person felt it "
                            + (felt_end ? "end" : "go on"));
    }

    /// No tick for longer than any watchdog of a limit: the device, not the guard, must end the force.
    void tryFreeze()
    {
        const auto* plugin = dynamic_cast<const PluginDevice*> (&device);
        if (plugin == nullptr) return add ("stop by silence", "not tried", "this device does not tell whether it was brought to rest");
        ask ("The tool is pushed up, and then the ticks stop for " + rounded (frozen_s) + " s, as in a frozen program. Hold it loosely, and press Enter.");
        auto o = options (trial_push, push_s);
        o.frozen_after = o.length / 2;
        o.frozen_s = frozen_s;
        const auto before = plugin->counts().silences;
        TrialRun run (device, limits, up(), o);
        play (run);
        const bool has_rested = plugin->counts().silences > before;
        const bool felt_end = saysYes ("Did the push end for a moment, before it came back?");
        add ("stop by silence", has_rested && felt_end ? "as expected" : "differs",
             std::string (has_rested ? "the device was brought to rest while no tick came" : "nothing brought the device to rest") + "; the person felt it "
                 + (felt_end ? "end" : "go on"));
    }

    static TrialGraph up() { return { .push = { 0.0, 0.0, trial_push } }; }

    Device& device;
    const GuardLimits limits;
    const TrialSetting& setting;
    TrialPerson& person;
    Json steps = Json::array(), capture = Json::array();
    Json numbers = Json::object();
    double delay_s = 0.0;   // from a place to the force that answers it, as far as it is known
};

/// A device that reads what it is told.
struct ToldDevice final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return next; }
    void write (const Effort&) noexcept override {}

    Reading next;
};
}   // namespace

Json tryDevice (Device& device, const GuardLimits& limits, const TrialSetting& setting, TrialPerson& person)
{
    return Trial (device, limits, setting, person).report();
}

std::string trialText (const Json& report)
{
    std::string text;
    for (const auto& step : report.at ("steps"))
        text += step.value ("step", std::string()) + ": " + step.value ("verdict", std::string()) + "; " + step.value ("text", std::string()) + "\n";
    return text;
}

namespace
{
Message noReport (const std::string& where, const std::string& what)
{
    return Message::error ("trial/format", where, what, "give a report of `tactus devices --try`");
}
}   // namespace

Result<DeviceNumbers> trialNumbers (const Json& report, double rate_hz)
{
    const bool is_one = report.is_object() && report.value ("format", Json()) == Json ("tactus-trial");
    if (! is_one || ! report.contains ("numbers") || ! report.at ("numbers").is_object()) return noReport ("/numbers", "this is not the report of a trial");
    DeviceNumbers numbers;
    const auto take = [&] (const char* key, double most, DeviceNumbers::Number& to) {
        const auto value = report.at ("numbers").value (key, Json());
        if (value.is_number() && value.get<double>() >= 0.0 && value.get<double>() <= most)
            to = DeviceNumber { .value = value.get<double>(), .source = "measured by tactus devices --try" };
        return value.is_null() || to.has_value();
    };
    const bool is_fine = take ("quantum", 1.0, numbers.quantum) && take ("delay_s", 1.0, numbers.delay) && take ("mass", 100.0, numbers.mass)
                         && take ("damping", 1000.0, numbers.damping) && take ("coulomb", 100.0, numbers.coulomb);
    if (! is_fine || (numbers.mass && numbers.mass->value <= 0.0)) return noReport ("/numbers", "a number is out of its range");
    if (numbers.delay) numbers.delay->value = std::ceil (numbers.delay->value * rate_hz);
    return numbers;
}

Result<double> replayTrial (const Json& report)
{
    const auto refuse = noReport;
    if (! report.is_object() || report.value ("format", Json()) != Json ("tactus-trial")) return refuse ("/format", "this is not the report of a trial");
    if (! report.contains ("capture") || ! report.at ("capture").is_array()) return refuse ("/capture", "the report has no capture");
    double worst = 0.0;
    for (const auto& part : report.at ("capture"))
    {
        if (! part.is_object() || ! part.contains ("graph") || ! part.contains ("rows")) return refuse ("/capture", "a part lacks its graph or its rows");
        auto read = readGraph (part.at ("graph").dump());
        auto plan = compile (read.graph, catalogue()).plan;
        if (plan == nullptr || plan->taps().size() < 3) return refuse ("/capture", "a part has a graph that cannot be played");
        ToldDevice told;
        Engine engine { plan };
        engine.attach ("tool", told, {});
        for (const auto& row : part.at ("rows"))
        {
            if (! row.is_array() || row.size() != 7) return refuse ("/capture", "a row does not have seven values");
            const auto number = [&] (std::size_t i) { return row[i].is_number() ? row[i].get<double>() : std::nan (""); };
            told.next.position = { number (0), number (1), number (2) };
            told.next.valid = row[3] == Json (true);
            engine.tick();
            for (std::size_t i = 0; i < 3; ++i)
            {
                const double off = std::abs (*plan->taps()[i].value - number (4 + i));
                worst = std::isfinite (off) ? std::max (worst, off) : std::numeric_limits<double>::infinity();
            }
        }
    }
    return worst;
}

}   // namespace tactus::host
