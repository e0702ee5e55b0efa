// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_runs.hpp"

#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/check/trials/trials.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/run.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <thread>
#include <utility>
#include <vector>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

constexpr double longest_gesture_s = 30.0;
constexpr double faintest = 0.05;    // N, N m or the unit of a signal: less cannot be felt
constexpr double strongest = 10.0;   // N

/// The efforts that a run lets the hand feel.
struct Played
{
    std::vector<double> efforts {};   // all components, tick after tick
    double lasts_s = 0.0;
    bool is_too_long = false;                       // to be played
    double largest = 0.0, last = 0.0, step = 0.0;   // of the forces, in N
    double most_effort = 0.0;                       // of force, torque, axes and signals
    std::string role {};                            // whose guard stopped, or lets no more through
    Guard::Event stop {};                           // the first one
    double clipped_at = 0.0;                        // the largest force that a guard allows and that the preset reached, in N; 0: none
    Messages messages {};
};

GuardLimits partOf (GuardLimits limits, double share)
{
    for (auto* limit : { &limits.max_speed, &limits.max_impulse, &limits.max_energy })
        *limit *= share;
    return limits;
}

class Play
{
public:
    Play (const check::Subject& s, const fs::path& f, double most) : subject (s), folder (f), most_ticks (most) {}

    Played run (const plan::Override* knob, double share_of_limits) const
    {
        Played p;
        auto options = subject.options;
        if (knob != nullptr) options.overrides.push_back (*knob);
        ByRole most;
        const auto open = [&] (const std::string& role, const graph::Graph& g, const Plan&, Messages&) {
            auto made = makeDevice (*g.device (role), folder);
            most[role] = made.limits.max_force;
            return Run::RoleDevice { std::move (made.device), partOf (made.limits, share_of_limits) };
        };
        Run run { subject.catalogue, options, open };
        p.messages = run.load (subject.graph);
        if (! hasErrors (p.messages)) run.openDevices (subject.graph, p.messages);
        if (hasErrors (p.messages)) return p;
        for (const auto& [role, device] : run.devices())
            if (device.device) p.lasts_s = std::max (p.lasts_s, device.device->duration());
        p.is_too_long = p.lasts_s > longest_gesture_s || p.lasts_s * run.rate() > most_ticks;
        if (p.lasts_s > 0.0 && ! p.is_too_long) play (run, most, p);
        return p;
    }

private:
    using ByRole = std::map<std::string, double, std::less<>>;   // the largest force that its guard allows, in N

    const check::Subject& subject;
    const fs::path& folder;
    double most_ticks;

    static void play (Run& run, const ByRole& most, Played& p)
    {
        const auto ticks = static_cast<std::size_t> (p.lasts_s * run.rate());
        const auto window = std::max<std::size_t> (1, static_cast<std::size_t> (std::lround (run.rate() * 1e-3)));
        auto& engine = run.engine();
        std::vector<std::vector<Vec3>> forces (engine.roleCount());
        for (std::size_t k = 0; k < ticks && p.stop.why == Guard::Stop::none; ++k)
        {
            run.tick();
            p.last = 0.0;
            for (std::size_t r = 0; r < engine.roleCount(); ++r)
                note (engine.role (r), most.find (engine.role (r).name)->second, forces[r], window, p);
        }
    }

    static void note (const Engine::RoleView& role, double most, std::vector<Vec3>& forces, std::size_t window, Played& p)
    {
        const auto& e = role.applied;
        p.efforts.insert (p.efforts.end(), e.force.data(), e.force.data() + 3);
        p.efforts.insert (p.efforts.end(), e.torque.data(), e.torque.data() + 3);
        p.efforts.insert (p.efforts.end(), e.axes.begin(), e.axes.end());
        p.efforts.insert (p.efforts.end(), e.signals.begin(), e.signals.end());
        const double size = e.force.norm();
        forces.push_back (e.force);
        p.step = std::max (p.step, (e.force - (forces.size() > window ? forces[forces.size() - 1 - window] : Vec3 (Vec3::Zero()))).norm());
        p.largest = std::max (p.largest, size);
        p.last = std::max (p.last, size);
        p.most_effort = std::max ({ p.most_effort, size, e.torque.norm() });
        for (const auto* channels : { &e.axes, &e.signals })
            for (const double v : *channels)
                p.most_effort = std::max (p.most_effort, std::abs (v));
        if (size >= most * (1.0 - 1e-9))
        {
            p.clipped_at = most;
            p.role = role.name;
        }
        if (role.guard.stop() != Guard::Stop::none && p.stop.why == Guard::Stop::none)
        {
            p.stop = role.guard.latest();
            p.role = role.name;
        }
    }
};

Message fault (const char* id, std::string where, std::string text, std::string remedy)
{
    return Message::error (std::string ("preset/") + id, std::move (where), std::move (text), std::move (remedy));
}

std::string newtons (double v) { return roundedText (v, 3) + " N"; }

/// The messages about a single run.
Messages examine (const Played& p, const std::string& where, const std::string& when)
{
    if (hasErrors (p.messages)) return p.messages;
    if (p.lasts_s <= 0.0 || p.is_too_long)
        return { fault ("gesture", "/devices",
                        p.lasts_s <= 0.0 ? "no hand moves along a path that ends"
                                         : "its gesture takes " + roundedText (p.lasts_s, 3) + " s, which is too long for its nodes, knobs and rate",
                        "give the `hand` a path of at most 30 s, such as \"stroke\"; a large graph needs a shorter one") };
    if (p.stop.why != Guard::Stop::none)
        return { fault ("stopped", where, when + "the guard of " + quote (p.role) + " stops: " + describe (p.stop),
                        "make the preset weaker or slower; its gesture may use half of the limits of its guard on speed, impulse and energy") };
    Messages messages;
    if (p.largest > strongest || p.clipped_at > 0.0)
        messages.push_back (fault ("strong", where,
                                   when + "the force on " + quote (p.role) + " reaches " + newtons (p.largest) + ", where its guard cuts it off",
                                   "make the preset weaker, or, up to 10 N, its guard wider"));
    if (p.last >= faintest)
        messages.push_back (fault ("lasting", where, when + "the force is still " + newtons (p.last) + " when the gesture has ended",
                                   "let the tool leave the surface, and let clips and oscillators end"));
    return messages;
}
}   // namespace

PresetForces playPreset (const check::Subject& subject, const fs::path& folder, double most_ticks)
{
    const Play play { subject, folder, most_ticks / (2.0 + 2.0 * static_cast<double> (subject.graph.controls.size())) };
    PresetForces all;
    const auto take = [&] (const Played& p, Messages found) {
        ++all.runs;
        all.lasts_s = p.lasts_s;
        all.largest = std::max (all.largest, p.largest);
        all.step = std::max (all.step, p.step);
        std::ranges::move (found, std::back_inserter (all.messages));
        return ! hasErrors (all.messages);
    };

    const auto first = play.run (nullptr, 0.5);
    if (! take (first, examine (first, "", ""))) return all;
    if (first.most_effort < faintest)
        all.messages.push_back (fault ("weak", "", "nothing can be felt: no effort reaches " + newtons (faintest),
                                       "let the gesture touch something, or make it stronger"));
    const auto again = play.run (nullptr, 0.5);
    if (again.efforts != first.efforts)
        all.messages.push_back (fault ("varies", "", "two runs give different forces", "leave out the node that is not the same in each run"));
    if (! take (again, {})) return all;

    for (const auto& control : subject.graph.controls)
    {
        const auto where = "/controls/" + pointerPart (control.id);
        const plan::Override ends[] { { control.id, 0.0 }, { control.id, 1.0 } };
        const auto low = play.run (&ends[0], 1.0), high = play.run (&ends[1], 1.0);
        const auto at = [&] (const char* end) { return "with the knob " + quote (control.id) + " at " + end + ", "; };
        if (! take (low, examine (low, where, at ("0"))) || ! take (high, examine (high, where, at ("1")))) return all;
        if (low.efforts == high.efforts)
            all.messages.push_back (fault ("knob", where, "the knob " + quote (control.id) + " changes nothing",
                                           "let it move a parameter that the gesture feels, or remove it"));
    }
    return all;
}

Messages judgePreset (const check::Subject& subject, const fs::path& folder, std::size_t ticks)
{
    auto recorded = check::recordMotion (subject, {}, folder);
    if (hasErrors (recorded.messages)) return std::move (recorded.messages);
    const std::size_t threads = std::max (1u, std::thread::hardware_concurrency());
    const auto demand = check::measure (subject, recorded.motion, { .ticks = ticks, .threads = threads });
    std::vector<check::RoleDevice> devices;
    for (const auto& [role, description] : subject.graph.devices)
        devices.push_back ({ role, check::numbersOf (description, folder).value_or (DeviceNumbers {}), "sim", check::simulationOf (description, folder) });
    Messages messages;
    const auto trials = check::tryLoops (subject, recorded.motion, demand, devices, { .ticks = ticks / 2, .threads = threads });
    for (const auto& c : check::judge (demand, devices, { .trials = &trials }))
        if (c.isBroken())
            messages.push_back (Message::warning ("preset/condition", c.node.empty() ? "/devices/" + pointerPart (c.role) : "/nodes/" + pointerPart (c.node),
                                                  "on its own device, the preset breaks the condition `" + std::string (c.id) + "`: " + c.text,
                                                  (c.remedy.empty() ? "" : c.remedy + "; ") + "or give the reason when you send the preset"));
    return messages;
}

}   // namespace tactus::host
