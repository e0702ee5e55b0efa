// SPDX-License-Identifier: MIT
// Random contacts: the check judges a loop, and a simulation that shares no code with it shows whether the tool comes to rest. TACTUS_ROUNDS=5000 tries
// 500 contacts; TACTUS_SEED is the first.
// Without TACTUS_SEED, each run has the same contacts, counted from 0, so it never fails by chance. No trial has every start, so other seeds may show a
// contact that is called stable though it swings; docs/check.md has a table of longer series.
#include "random_contacts.hpp"

#include "support/rounds.hpp"
#include "support/sketch.hpp"

#include <tactus/check/judge.hpp>
#include <tactus/check/trials/trials.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <complex>
#include <cstdlib>
#include <sstream>

using namespace tactus;
using namespace tactus::test;

namespace
{
/// The verdicts of the check on a contact, and the trial behind them.
struct Judged
{
    std::vector<check::Condition> conditions;
    check::Trial trial;
};

Judged judged (const graph::Graph& graph, const RandomContact& contact)
{
    const check::Subject subject { graph, catalogue() };
    check::HandMotion motion { .rate_hz = contact.rate_hz, .ticks = contact.path.size() };
    auto& role = motion.roles.emplace_back (check::RoleMotion { .role = "h", .layout = SimulatedDevice { contact.device }.layout() });
    for (const auto& p : contact.path)
        role.readings.push_back ({ .position = p, .true_position = p });
    const std::vector<check::RoleDevice> devices { { .role = "h", .numbers = numbersOf (contact.device), .name = "sim", .simulated = contact.device } };
    const auto demand = check::measure (subject, motion, { .ticks = 10'000'000 });
    const auto trials = check::tryLoops (subject, motion, demand, devices);
    return { check::judge (demand, devices, { .trials = &trials }), trials.by_role.front() };
}

/// A simulation, apart from the check's, at a place of a contact.
class Place
{
public:
    /// `waits`: ticks that the hand stays there.
    Place (const graph::Graph& graph, const RandomContact& contact, std::size_t at, std::size_t waits = 0)
        : tick (at), threshold (std::max (1e-6, 2.0 * contact.device.quantum)), loop (graph, catalogue(), {}, own::mechanicsOf (contact.device))
    {
        loop.follow ({ contact.path.begin(), contact.path.begin() + std::ptrdiff_t (at) + 1 });
        if (waits > 0) loop.follow (std::vector (waits, contact.path[at]));
        f = loop.force();
        push = -f;
        const Vec3 step = contact.path[at] - contact.path[at - 1];
        if (step.norm() * contact.rate_hz > 1e-3) push += 0.5 * f.dot (step.normalized()) * step.normalized();
    }

    const Vec3& force() const { return f; }

    /// How far the tool moves in the end, of the threshold. More than `most`: it tells how.
    double moved (const Vec3& away, const own::Grip& grip, double most, std::string& how)
    {
        const auto third = loop.letGo (away, grip, push);
        const bool slides = third.push_work > 2.0 * push.norm() * third.swing && third.work <= third.push_work;   // over bumps
        const bool is_driven = third.is_far && third.most_work > third.most_push;
        const double moved = third.is_far ? (is_driven ? 1e3 : 0.0) : std::max (slides ? 0.0 : third.swing, third.gone) / threshold;
        if (moved <= most) return most;
        std::ostringstream text;
        text << "tick " << tick << ", " << 1e3 * away.norm() << " mm off, hand " << grip.mass << " kg: swing " << 1e6 * third.swing << " um, range "
             << 1e6 * third.range << " um, work " << third.work << (third.is_far ? ", far" : "");
        how = text.str();
        return moved;
    }

private:
    std::size_t tick;
    double threshold;
    own::Loop loop;
    Vec3 f, push;
};

/// The largest movement of a tool in the end, of the threshold, over some places, starts and hands, and how it came about.
struct Seen
{
    double most = 0.0;
    std::string how;
};

Seen simulated (const graph::Graph& graph, const RandomContact& contact, RandomContacts& draw)
{
    Seen seen;
    for (const auto at : contact.places)
    {
        Place place { graph, contact, at };
        const Vec3 f = place.force();
        const own::Grip grips[] { {}, { 6e-3, 2.0 + 2.0 * draw.part(), 200.0 + 600.0 * draw.part() }, { 0.554, 6.45, 135.0 } };
        for (const double off : { 2e-4, 2e-3 })
            for (const auto& grip : grips)
                seen.most = place.moved (off * (draw.chance (0.5) && f.norm() > 1e-6 ? Vec3 (f.normalized()) : draw.direction()), grip, seen.most, seen.how);
    }
    return seen;
}

/// Lets the tool go where the check says that it swings, with the same hand and as far off.
void simulateThere (const graph::Graph& graph, const RandomContact& contact, const check::Trial& trial, Seen& seen)
{
    const auto at = std::max<std::size_t> (1, std::size_t (std::lround (trial.t_s * contact.rate_hz)));
    Place place { graph, contact, at, std::size_t (0.1 * contact.rate_hz) };
    const double off = trial.off > 0.0 ? trial.off : 2e-3;
    const Vec3 out = place.force().norm() > 1e-6 ? Vec3 (place.force().normalized()) : Vec3 (Vec3::UnitZ());
    const Vec3 aside = out.unitOrthogonal(), other = out.cross (aside);
    const Vec3 up = 0.6 * out + 0.64 * aside + 0.48 * other, down = -0.8 * out + 0.48 * aside + 0.36 * other;
    for (const Vec3& way : { out, aside, Vec3 (-aside), other, Vec3 (-other), up, down })
        if (seen.most <= 1.0)
            seen.most = place.moved (off * way, { trial.hand.mass, trial.hand.damping, trial.hand.stiffness }, seen.most, seen.how);
}
}   // namespace

TEST_CASE ("no random contact that swings, bounces or runs away is called stable or passive", "[check]")
{
    const auto count = rounds (10);
    const bool tells = count != 10;
    int blessed = 0, alarms = 0, none = 0, swings = 0;
    std::ostringstream list;
    const auto* first = std::getenv ("TACTUS_SEED");   // count on from here
    const int from = first != nullptr ? static_cast<int> (std::strtol (first, nullptr, 10)) : 0;
    for (int i = from; i < from + count; ++i)
    {
        RandomContacts draw { std::uint64_t (i) };
        const auto contact = draw.draw();
        const auto loaded = readGraph (contact.text);
        INFO (contact.text << '\n'
                           << test::text (loaded.messages));
        REQUIRE_FALSE (hasErrors (loaded.messages));
        const auto compiled = compile (loaded.graph, catalogue());
        INFO (test::text (compiled.messages));
        REQUIRE (compiled.plan);
        const auto [conditions, trial] = judged (loaded.graph, contact);
        auto seen = simulated (loaded.graph, contact, draw);
        if (trial.swings && seen.most <= 1.0) simulateThere (loaded.graph, contact, trial, seen);   // the places above are not all that the check has tried
        const auto row = std::ranges::find (conditions, "stiffness", &check::Condition::id);
        const bool has_verdict = row != conditions.end() && row->verdict != check::Verdict::unknown && row->verdict != check::Verdict::broken;
        const bool is_blessed = has_verdict && row->verdict != check::Verdict::unstable, does_swing = seen.most > 1.0;
        swings += does_swing;
        none += ! has_verdict;
        blessed += is_blessed && does_swing;
        alarms += has_verdict && ! is_blessed && ! does_swing;
        if (! has_verdict || is_blessed == does_swing)
            list << i << ' ' << contact.kinds << (does_swing ? "SWINGS " : "rests ") << seen.most << " (" << seen.how << "), said "
                 << (row == conditions.end() ? "nothing" : std::string (nameOf (row->verdict)) + ": " + row->text) << '\n';
        if (const auto& m = contact.device; first != nullptr && count == 1)
            list << contact.text << " M " << m.mass << " B " << m.damping << " dry " << m.coulomb << " delta " << m.quantum << " F0 " << m.first_mode << " d "
                 << m.delay << '\n';
    }
    INFO (list.str());
    if (tells)
        WARN (count << " contacts, " << swings << " swing: " << blessed << " blessed though they swing, " << alarms << " called unstable though they rest, "
                    << none << " without a verdict\n"
                    << list.str());
    CHECK (blessed == 0);
    CHECK (alarms <= count / 50);
    CHECK (none <= std::max (1, count / 20));
}

TEST_CASE ("contacts that few starts make swing are not called stable or passive", "[check]")
{
    // 200: a friction whose loop is not known, with one of the hands only. 3050: a liquid that swings after a hard blow.
    for (const std::uint64_t seed : { 200u, 3050u })
    {
        RandomContacts draw { seed };
        const auto contact = draw.draw();
        const auto loaded = readGraph (contact.text);
        const auto conditions = judged (loaded.graph, contact).conditions;
        const auto seen = simulated (loaded.graph, contact, draw);
        const auto row = std::ranges::find (conditions, "stiffness", &check::Condition::id);
        REQUIRE (row != conditions.end());
        INFO (seed << ": " << row->text << '\n'
                   << seen.how);
        CHECK (seen.most > 1.0);
        CHECK ((row->verdict == check::Verdict::unstable || row->verdict == check::Verdict::unknown));
    }
}

namespace
{
/// A graph of one role on a device of 0.1 kg and 2 N s/m at 1 kHz. The tool is pressed with 1 N into the contact, or moved along a given path.
RandomContact made (const std::string& nodes, const std::string& wires, double depth = 5e-5, std::vector<Vec3> path = {})
{
    RandomContact c { .text = R"({ "format": "tactus-graph", "version": 2, "name": "made", "rate_hz": 1000, "nodes": {
                              "at": { "type": "device.position", "role": "h" }, "motor": { "type": "device.force", "role": "h" })"
                              + (nodes.empty() ? "" : ", " + nodes) + R"( }, "wires": [ )" + wires + " ] }",
                      .kinds = "made",
                      .device = { .mass = 0.1, .damping = 2.0 },
                      .rate_hz = 1000.0,
                      .path = std::move (path),
                      .places = {} };
    if (c.path.empty())
        for (int k = 0; k < 800; ++k)
            c.path.emplace_back (0.0, 0.0, -depth * std::min (1.0, k / 300.0));
    c.places = { c.path.size() - 1 };
    return c;
}

/// The verdict of the row `stiffness`, and whether the tool swings in a simulation.
struct Both
{
    check::Condition row;
    bool swings;
};

Both bothOf (const RandomContact& contact)
{
    const auto loaded = readGraph (contact.text);
    INFO (contact.text << '\n'
                       << test::text (loaded.messages));
    REQUIRE_FALSE (hasErrors (loaded.messages));
    RandomContacts draw { 7 };
    const auto conditions = judged (loaded.graph, contact).conditions;
    const auto row = std::ranges::find (conditions, "stiffness", &check::Condition::id);
    REQUIRE (row != conditions.end());
    return { *row, simulated (loaded.graph, contact, draw).most > 1.0 };
}

std::string plane (const std::string& name, const std::string& params) { return '"' + name + R"(": { "type": "deform.plane", "params": { )" + params + " } }"; }

const std::string felt_floor = R"("at.position -> floor.position", "floor.force -> motor.force")",
                  felt_side = R"(, "at.position -> side.position", "side.force -> motor.force")",
                  felt_drag = R"(, "at.position -> drag.position", "floor.resistance -> drag.normal_force", "drag.force -> motor.force")";
}   // namespace

TEST_CASE ("a damped floor does not hide an undamped wall beside it, nor the friction on it", "[check]")
{
    const auto floor = plane ("floor", R"("stiffness": 20000, "damping": 20)");
    const auto alone = bothOf (made (floor, felt_floor));
    INFO (alone.row.text);
    CHECK_FALSE (alone.swings);
    CHECK (alone.row.verdict == check::Verdict::stable);

    const auto side = bothOf (made (floor + ", " + plane ("side", R"("normal": [1, 0, 0], "offset": 0.0001, "stiffness": 10000)"), felt_floor + felt_side));
    INFO (side.row.text);
    CHECK (side.swings);
    CHECK (side.row.verdict == check::Verdict::unstable);

    const std::string drag = R"(, "drag": { "type": "friction.elasto_plastic", "params": { "mu": 0.5, "stiffness": 6000 } })";
    const auto rough = bothOf (made (floor + drag, felt_floor + felt_drag));
    INFO (rough.row.text);
    CHECK (rough.swings);
    CHECK (rough.row.verdict == check::Verdict::unstable);
}

TEST_CASE ("a tool on a saddle runs away, and a field that turns is not passive", "[check]")
{
    const auto field = [] (const char* x, const char* y, const char* more = "") {
        return std::string (R"({ "wire": "at.position.x -> motor.force.x", "gain": ")") + x
               + R"( N/m" }, { "wire": "at.position.y -> motor.force.y", "gain": ")" + y
               + R"( N/m" }, { "wire": "at.position.z -> motor.force.z", "gain": "-500 N/m" })" + more;
    };
    const auto saddle = bothOf (made ("", field ("-1000", "400")));
    INFO (saddle.row.text);
    CHECK (saddle.swings);
    CHECK (saddle.row.verdict == check::Verdict::unstable);
    CHECK (saddle.row.text.find ("runs away") != std::string::npos);

    std::vector<Vec3> circle;
    for (int k = 0; k < 1000; ++k)
        circle.emplace_back (5e-3 * std::sin (0.01 * k), 5e-3 * (1.0 - std::cos (0.01 * k)), 0.0);
    const char* turn = R"(, { "wire": "at.position.y -> motor.force.x", "gain": "-30 N/m" }, { "wire": "at.position.x -> motor.force.y", "gain": "30 N/m" })";
    const auto turning = bothOf (made ("", field ("-1000", "-1000", turn), 0.0, circle));
    INFO (turning.row.text);
    CHECK (turning.row.verdict == check::Verdict::stable);
    CHECK (turning.row.text.find ("turns the tool") != std::string::npos);
    CHECK (bothOf (made ("", field ("-1000", "-1000"), 0.0, circle)).row.verdict == check::Verdict::passive_here);
}

TEST_CASE ("only a contact whose nodes all claim it is passive whatever the hand does", "[check]")
{
    const auto soft = bothOf (made (plane ("floor", R"("stiffness": 1000)"), felt_floor, 1e-3));
    INFO (soft.row.text);
    CHECK (soft.row.verdict == check::Verdict::passive);

    // 1.9 N/mm at 1 mm, and more deeper down.
    const std::string hertz = R"("floor": { "type": "deform.plane", "settings": { "law": { "power": [40000, 1.5] } } })";
    const auto curved = bothOf (made (hertz, felt_floor, 1e-3));
    INFO (curved.row.text);
    CHECK (curved.row.verdict == check::Verdict::passive_here);

    const std::string scaled = plane ("floor", R"("stiffness": 1000)")
                               + R"(, "drag": { "type": "friction.elasto_plastic", "params": { "load": "scale", "d_max": 0.001 } })";
    CHECK (bothOf (made (scaled, felt_floor + felt_drag, 1e-3)).row.verdict != check::Verdict::passive);

    const std::string planned = R"("floor": { "type": "hold.deadbeat", "params": { "stiffness": "4 N/mm" } })";
    const auto deadbeat = bothOf (made (planned, felt_floor, 1e-3));
    INFO (deadbeat.row.text);
    CHECK (deadbeat.row.verdict == check::Verdict::stable);
}

TEST_CASE ("a liquid that swings at the speed of the motion is called unstable, though it rests in a tool at rest", "[check]")
{
    std::vector<Vec3> fast;
    for (int k = 0; k < 1000; ++k)
        fast.emplace_back (0.06 * std::sin (0.02 * k), 0.0, 0.0);   // 1.2 m/s
    const std::string wires = R"("at.position -> liquid.position", "liquid.force -> motor.force")";
    const auto liquid = [&] (double most) {
        const auto params = R"("linear": 1, "quadratic": 400, "max_damping": )" + std::to_string (most);
        auto c = made (R"("liquid": { "type": "field.viscous", "params": { )" + params + " } }", wires, 0.0, fast);
        c.places = { 10 };
        return bothOf (c).row;
    };
    const auto swings = liquid (2000.0), rests = liquid (100.0);
    INFO (swings.text << '\n'
                      << rests.text);
    CHECK (swings.verdict == check::Verdict::unstable);
    CHECK (rests.verdict != check::Verdict::unstable);
}

TEST_CASE ("dry friction and a brake may hold what the linear loop alone would let swing", "[check]")
{
    auto contact = made (plane ("floor", R"("stiffness": 6000)"), felt_floor, 2e-4);
    CHECK (bothOf (contact).row.verdict == check::Verdict::unstable);
    contact.device.brake = 20.0;
    contact.text.replace (contact.text.find (R"("at": {)"), 0, R"("brakes": { "type": "device.brake", "role": "h" },
                             "much": { "type": "signal.constant", "params": { "value": "3 N*s/m" } }, )");
    contact.text.replace (contact.text.find (R"("at.position -> floor)"), 0, R"("much.out -> brakes.damping", )");
    const auto braked = bothOf (contact);
    INFO (braked.row.text);
    CHECK_FALSE (braked.swings);
    CHECK (braked.row.limit == Approx (5.0));   // B and the brake
    CHECK (braked.row.verdict == check::Verdict::passive);
}

TEST_CASE ("what a device must dissipate with a delay is exact", "[check]")
{
    const auto needs = [] (double k, double b, int delay) {
        DeviceNumbers n = numbersOf (Simulation { .mass = 0.1, .damping = 1.0, .delay = delay });
        const std::array<const DeviceNumbers*, 1> axes { &n };
        constexpr std::array<double, 1> whole { 1.0 };
        const std::vector<check::Jacobian> response { check::Jacobian::Constant (1, 1, k + 1e3 * b), check::Jacobian::Constant (1, 1, k) };
        return check::passivityLoad (response, axes, whole, 1e-3).value();
    };
    CHECK (needs (4000.0, 0.0, 0) == Approx (2.0).epsilon (1e-3));
    CHECK (needs (1000.0, 1.0, 0) == Approx (1.5).epsilon (1e-3));
    CHECK (needs (1000.0, 1.0, 1) == Approx (1.625).epsilon (0.01));
    CHECK (needs (800.0, 2.0, 2) == Approx (2.53).epsilon (0.01));
    // By hand, on a grid of frequencies.
    double most = 0.0;
    for (double angle = 1e-3; angle < 3.1415; angle += 1e-3)
    {
        const auto late = [&] (double ticks) { return std::polar (1.0, -angle * ticks); };
        const auto h = (700.0 + 3000.0 * (1.0 - late (1.0))) * late (3.0);
        most = std::max (most, 0.5e-3 * ((1.0 - late (1.0)) * h).real() / (1.0 - std::cos (angle)));
    }
    CHECK (needs (700.0, 3.0, 3) == Approx (most).epsilon (1e-3));
}

TEST_CASE ("a swing that dies slowly is followed until it is clear, and not called unstable", "[check]")
{
    // The load of 1 N makes a friction of 3960 N/m, which is passive up to 4000 N/m: its swing dies by a tenth per second.
    const auto light = bothOf (made (plane ("floor", R"("stiffness": 1000)")
                                         + R"(, "drag": { "type": "friction.elasto_plastic", "params": { "mu": 0.4, "d_max": 101e-6 } })",
                                     felt_floor + felt_drag, 1e-3));
    INFO (light.row.text);
    CHECK_FALSE (light.swings);
    CHECK ((light.row.verdict == check::Verdict::passive_here || light.row.verdict == check::Verdict::unknown));

    // The loop of this wall comes to rest up to 1.02 times its response: its swing dies by 2 % per second.
    auto wall = made (plane ("floor", R"("stiffness": 2000, "damping": 0.51)"), felt_floor, 1e-3);
    wall.device = { .mass = 0.2, .damping = 0.5 };
    const auto heavy = bothOf (wall);
    INFO (heavy.row.text);
    CHECK (heavy.row.verdict == check::Verdict::unknown);

    // This one is passive by 0.14 % of the damping: its swing dies by 0.3 % per second, so it is not said to come to rest.
    auto edge = made (plane ("floor", R"("stiffness": 53.44, "damping": 0.023)"), felt_floor, 1e-3);
    edge.device = { .mass = 0.0345, .damping = 0.164273, .delay = 3 };
    const auto slow = bothOf (edge);
    INFO (slow.row.text);
    CHECK (slow.row.verdict == check::Verdict::passive);
    CHECK (slow.row.text.find ("the tool comes to rest, or its swing dies slowly: let go ") != std::string::npos);
}
