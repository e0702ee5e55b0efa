// SPDX-License-Identifier: MIT
#include "judging.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

namespace tactus::check
{

DeviceNumbers numbersFor (std::span<const RoleDevice> devices, const RoleDemand& role)
{
    const auto device = std::ranges::find (devices, role.role, &RoleDevice::role);
    if (device == devices.end()) return {};
    if (role.axis.empty()) return device->numbers;
    DeviceNumbers numbers;
    if (! device->simulated) return numbers;
    const auto axis = std::ranges::find (device->simulated->axes, role.axis, &Simulation::Axis::name);
    if (axis == device->simulated->axes.end()) return numbers;
    const auto given = [] (double v) { return DeviceNumber { .value = v, .source = "the description of the simulated device" }; };
    numbers.mass = given (axis->mass);
    numbers.damping = given (axis->damping);
    for (auto* none : { &numbers.quantum, &numbers.coulomb, &numbers.delay })
        *none = given (0.0);
    numbers.first_mode = given (std::numeric_limits<double>::infinity());
    return numbers;
}

namespace judging
{

namespace
{
std::string handText (const HeldHand& hand)
{
    if (hand.mass == 0.0 && hand.stiffness == 0.0) return "without a hand";
    return "with a hand of " + text (1e3 * hand.mass, "g") + ", " + text (hand.damping, "N*s/m") + " and " + text (hand.stiffness, "N/m");
}

/// The result of the trials of these roles.
struct Shown
{
    const Trial* worst = nullptr;      // the largest swing; null if no tool swings
    const Trial* doubtful = nullptr;   // nearly a swing
    const Trial* played = nullptr;     // the tool does not come to rest, but does without the nodes that play and that a device turns up
    bool are_tried = true, is_lost = false;
};

Shown shownBy (const Trials& trials, std::span<const RoleDemand* const> roles)
{
    Shown shown;
    for (const auto* role : roles)
    {
        const auto trial = std::ranges::find_if (trials.by_role, [&] (const Trial& t) { return t.role == role->role && t.axis == role->axis; });
        shown.are_tried = shown.are_tried && trial != trials.by_role.end() && trial->is_tried;
        if (trial == trials.by_role.end()) continue;
        if (trial->rests_without && (shown.played == nullptr || trial->range > shown.played->range)) shown.played = &*trial;
        if (trial->rests_without) continue;
        if (trial->swings && (shown.worst == nullptr || trial->range > shown.worst->range)) shown.worst = &*trial;
        shown.is_lost = shown.is_lost || trial->is_lost;
        if (trial->is_doubtful) shown.doubtful = &*trial;
    }
    return shown;
}

/// True if dry friction of the device or of the graph, a brake or a passivity controller may hold a tool whose linear loop swings. Without them, a trial in
/// which the tool comes to rest only began at the wrong place.
bool mayRest (const Demand& demand, const Trials& trials, std::span<const RoleDemand* const> roles)
{
    const auto brakes = [] (const RoleDemand* role) { return std::ranges::any_of (role->slopes, [] (const Slope& s) { return s.brake > 0.0; }); };
    const bool is_controlled = demand.roles.size() == 1 && std::ranges::find (demand.nodes, "safety.passivity", &MeasuredNode::type) != demand.nodes.end();
    return trials.are_dry || ! demand.stretches.empty() || is_controlled || std::ranges::any_of (roles, brakes);
}

/// The reason why a contact with passive slopes is not passive for every motion; empty if it is. `is_here`: it is passive along this one.
std::string doubt (const Demand& demand, std::span<const RoleDemand* const> roles, bool turns, bool holds_as_claimed, bool& is_here)
{
    is_here = false;
    double given = demand.given_together, uncertain = 1e-5;   // J
    if (roles.size() == 1) given = roles.front()->given;
    for (const auto& t : demand.textures)   // a motion that begins on the crest of a ridge has its energy stored
        if (std::ranges::any_of (roles, [&] (const auto* role) { return role->role == t.role; }))
            uncertain += 1.01 * t.amplitude / (std::numbers::pi * t.spatial_frequency);
    for (const auto* role : roles)
    {
        if (std::ranges::any_of (demand.deadbeats, [&] (const Deadbeat& d) { return d.role == role->role; })) return "a hold.deadbeat has no slope";
        if (std::ranges::any_of (demand.jumps, [&] (const Jump& j) { return j.role == role->role; })) return "a force steps";
    }
    if (turns) return "its force turns the tool, so a closed path gains energy";
    if (given > uncertain) return "the graph gives " + text (1e3 * given, "mJ") + " along this motion";
    is_here = true;
    if (! demand.players.empty()) return "'" + demand.nodes[demand.players.front()].path + "' plays by itself, and is left out";
    if (! demand.modulated.empty()) return "'" + demand.nodes[demand.modulated.front()].path + "' plays by itself, and a device turns it up or down";
    for (const auto* role : roles)
    {
        if (! role->claims_nothing.empty()) return "'" + role->claims_nothing.front() + "' claims nothing about other motions";
        for (const auto& u : demand.unreached)
            if (u.role == role->role) return "'" + demand.nodes[u.node].path + "' is not reached";
    }
    return holds_as_claimed ? "" : "the contact may be stiffer deeper or elsewhere";
}
}   // namespace

void weigh (const Demand& demand, const Trials* trials, Condition& c, std::span<const RoleDemand* const> roles, bool turns, bool holds_as_claimed)
{
    if (c.verdict == Verdict::unknown) return;
    const auto of_slopes = c.verdict == Verdict::passive ? c.text + "; the slopes alone are passive" : std::string();
    if (c.verdict == Verdict::passive)
    {
        bool is_here = false;
        const auto why = doubt (demand, roles, turns, holds_as_claimed, is_here);
        if (! why.empty())
        {
            c.verdict = is_here ? Verdict::passive_here : Verdict::stable;
            c.text += "; passive " + std::string (is_here ? "along this motion" : "in its slopes") + " only, as " + why;
            if (! is_here) c.may_grow = c.value > 0.0 ? c.limit / c.value : std::numeric_limits<double>::quiet_NaN();   // at least
        }
    }
    if (trials == nullptr) return;
    auto [worst, doubtful, played, are_tried, is_lost] = shownBy (*trials, roles);
    const Trial* slowest = nullptr;                                          // a passive contact near its limit takes long to settle
    if (worst != nullptr && worst->dies && c.verdict != Verdict::unstable)   // only the trial says that it swings, and the swing dies there
        (c.verdict == Verdict::passive ? slowest : doubtful) = std::exchange (worst, nullptr);
    const auto letGo = [] (const Trial& t) {
        const auto from = t.off > 0.0 ? text (1e3 * t.off, "mm") + " off its rest" : std::string ("at the speed of the motion");
        return "let go " + from + " at " + text (t.t_s, "s") + " " + handText (t.hand) + ", the tool ";
    };
    const auto moves = [] (const Trial& t) { return "by " + text (1e6 * t.range, "um") + " after " + text (t.after_s, "s"); };
    if (played != nullptr && worst == nullptr)
    {
        const auto name = "'" + demand.nodes[demand.modulated.front()].path + "'";
        c.text = letGo (*played) + "does not come to rest while " + name + " plays, which a device turns up or down; without it, the tool comes to rest; "
                 + c.text;
        if (c.verdict == Verdict::unstable) return;
        c.verdict = Verdict::unknown;
        c.remedy = "try it by hand with " + name + " at its strongest: what it does to the loop is not known";
        return;
    }
    if (worst != nullptr)
    {
        if (c.verdict != Verdict::unstable) c.may_grow = std::numeric_limits<double>::quiet_NaN();   // that of the linear loop says nothing here
        c.verdict = Verdict::unstable;
        if (! of_slopes.empty()) c.text = of_slopes;
        c.text = letGo (*worst) + (worst->runs_away ? "runs away" : "still moves to and fro " + moves (*worst)) + "; " + c.text;
        if (c.remedy.empty()) c.remedy = "softer or weaker forces at this place, or a device with more damping";
        return;
    }
    if (doubtful != nullptr)
    {
        c.verdict = Verdict::unknown;
        c.text = letGo (*doubtful) + "still moves " + moves (*doubtful) + "; " + c.text;
        c.remedy = "in a trial, the tool still moves at the end, but not clearly enough to call it unstable: try it by hand, or check the same graph "
                   "with softer or stiffer forces";
        return;
    }
    if (! are_tried || is_lost)
    {
        c.text += are_tried ? "; in a trial, the tool swung until the hand drove it away from the motion" : "; the tool was not let go as often as planned";
        if (c.verdict == Verdict::broken)   // it is not known to be passive, and no more is known
        {
            c.verdict = Verdict::unknown;
            c.remedy = std::string ("its loop is not known, and the tool ") + (are_tried ? "did not stay where it was let go" : "was not let go") + ": "
                       + c.remedy;
        }
        return;
    }
    auto tried = "in " + std::to_string (trials->runs) + " trials at " + std::to_string (trials->places) + " places, the tool comes to rest";
    if (! demand.players.empty()) tried += " without '" + demand.nodes[demand.players.front()].path + "', which plays by itself";
    if (slowest != nullptr) tried += ", or its swing dies slowly: " + letGo (*slowest) + "still moves to and fro " + moves (*slowest);
    if (c.verdict == Verdict::unstable && c.falls)
    {
        c.verdict = Verdict::stable;
        c.may_grow = std::numeric_limits<double>::quiet_NaN();   // that of a loop that runs away says nothing
        c.text = tried + ", somewhere else than where it was let go; " + c.text;
    }
    else if (c.verdict == Verdict::unstable && ! mayRest (demand, *trials, roles))
        c.text += "; " + tried + " where it was let go, but no dry friction, no brake and no safety.passivity holds it there";
    else if (c.verdict == Verdict::unstable)
    {
        c.verdict = Verdict::stable;
        c.text = tried + ", because of something that the linear loop leaves out, such as dry friction, a brake or a safety.passivity; " + c.text;
    }
    else if (c.verdict == Verdict::broken)   // no loop is known
    {
        c.verdict = Verdict::stable;
        c.may_grow = std::numeric_limits<double>::quiet_NaN();
        c.text = tried + "; " + c.text;
    }
    else
        c.text += "; " + tried;
    if (trials->driven_away > 0) c.text += "; in " + std::to_string (trials->driven_away) + " of these trials, the hand drives the tool away from the motion";
}

}   // namespace judging
}   // namespace tactus::check
