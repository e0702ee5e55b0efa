// SPDX-License-Identifier: MIT
// What the hand feels while a graph is edited.

#include "support/chance_hand.hpp"
#include "support/interpreter.hpp"
#include "support/no_allocation.hpp"
#include "support/random_edit.hpp"
#include "support/random_graph.hpp"
#include "support/rounds.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <numbers>

using namespace tactus;

namespace
{
constexpr double rate_hz = 4000.0;
constexpr std::size_t ten_seconds = 40000;

/// A hand on two walls (the branches). On each wall, three leaves rub and ring; two of the three are instances of one node. All six
/// leaves have memory and contribute to the force. In addition there is a random graph.
graph::Graph touchable (unsigned seed, int size)
{
    test::Sketch s;
    s.graph = test::randomGraph (seed, size);
    auto& leaf = s.subgraph ("leaf");
    s.add (leaf, "drag", "friction.elasto_plastic")
        .add (leaf, "bar", "vibration.modal", Json::object(), { { "modes", { { { "frequency", 180.0 }, { "decay", 20.0 }, { "amplitude", 0.5 } } } } })
        .add (leaf, "sum", "vector.add")
        .add (leaf, "shake", "vector.join");
    s.add (leaf, "bar.value -> [5] -> shake.z").add (leaf, "shake.out -> sum.in[0]").add (leaf, "drag.force -> [2] -> sum.in[1]");
    leaf.expose = { { { "position", { "drag", "position" } }, { "push", { "drag", "normal_force" } }, { "hit", { "bar", "hit" } } },
                    { { "force", { "sum", "out" } } },
                    { { "mu", { "drag", "mu" } } } };

    auto& branch = s.subgraph ("branch");
    s.add (branch, "wall", "deform.plane")
        .add (branch, "a", "graph:leaf", { { "mu", 0.3 } })
        .add (branch, "b", "graph:leaf")
        .add (branch, "all", "vector.add", Json::object(), { { "inputs", 3 } });
    branch.nodes[2].extra["count"] = 2;
    branch.nodes[2].overrides["[1]/drag.mu"] = 0.9;
    for (const std::string which : { "a", "b" })
        s.add (branch, "wall.resistance -> " + which + ".push").add (branch, "wall.hit -> " + which + ".hit");
    s.add (branch, "a.force -> all.in[0]").add (branch, "b.force -> [1] -> all.in[1]").add (branch, "wall.force -> all.in[2]");
    branch.expose = { { { "position", { "wall", "position" } }, { "at_a", { "a", "position" } }, { "at_b", { "b", "position" } } },
                      { { "force", { "all", "out" } } },
                      { { "offset", { "wall", "offset" } }, { "mu", { "b/drag", "mu" } } } };

    branch.nodes[2].extra["every"] = 3;
    branch.nodes[2].extra["hold"] = "linear";
    s.node ("hand", "device.position")
        .node ("left", "graph:branch")
        .node ("right", "graph:branch", { { "offset", "1 mm" }, { "mu", 0.5 } })
        .node ("motor", "device.force");
    for (const std::string which : { "left", "right" })
    {
        for (const std::string port : { "position", "at_a", "at_b" })
            s.wire ("hand.position -> " + which + "." + port);
        s.wire (which + ".force -> motor.force");
    }
    s.graph.root.nodes[s.graph.root.nodes.size() - 2].overrides["a/drag.mu"] = 0.7;
    return s.graph;
}

/// The efforts of both hands, and the bit patterns of everything recorded.
struct Felt
{
    std::vector<Effort> left, right;
    std::vector<std::uint64_t> recorded;
    int taken = 0, refused = 0;
};

/// The largest step beyond what the bumpless rule allows, relative to the size of the signal.
class BumplessRule
{
public:
    void poll (const Plan& plan, bool taken_over, const Effort& applied, bool stopped)
    {
        const auto role = std::ranges::find (plan.roles(), "right", &Plan::RoleUse::name);
        Effort wanted;
        for (const auto& sink : role->sinks)
        {
            const auto e = sink.effort (sink.node);
            wanted.force += e.force;
            wanted.torque += e.torque;
        }
        const auto tick = plan.nextTick() - 1;
        const bool is_touched = taken_over && ! role->untouched;
        if (is_touched) touched_at = tick;
        if (is_touched && role->has_new_nodes) waits = static_cast<int> (Bumpless::settle_s * rate_hz);
        const bool comes_late = std::ranges::any_of (plan.rests(),
                                                     [&] (std::uint64_t rests) { return tick % rests == 0 && tick > touched_at && tick < touched_at + rests; });
        if (is_touched || comes_late) since = 0;
        if (stopped) waits = 0;
        const bool is_waiting = waits > 0;
        if (is_waiting) --waits;
        if (since == 0)
        {
            difference = is_waiting ? Vec3 (Vec3::Zero()) : Vec3 ((last.force - wanted.force).cwiseAbs() + (last.torque - wanted.torque).cwiseAbs());
            fade_s = falls (last.force, wanted.force) && falls (last.torque, wanted.torque) ? Bumpless::fall_s : Bumpless::rise_s;
            own = { Vec3::Zero(), Vec3::Zero() };
        }
        else
            own = { wanted.force - last_wanted.force, wanted.torque - last_wanted.torque };
        const double per_tick = std::numbers::pi / (2.0 * fade_s * rate_hz);
        const bool fading = since > 0 && since <= static_cast<int> (fade_s * rate_hz);
        const Vec3 allowed = own.force.cwiseAbs() + own.torque.cwiseAbs() + (fading ? per_tick : 0.0) * difference;
        const Vec3 step = (applied.force - last.force).cwiseAbs() + (applied.torque - last.torque).cwiseAbs();
        const double size = std::max (
            { 1e-3, difference.maxCoeff(), applied.force.cwiseAbs().maxCoeff(), last_wanted.force.cwiseAbs().maxCoeff(), wanted.force.cwiseAbs().maxCoeff() });
        if (! stopped && ! was_stopped && isFinite (step, allowed)) worst = std::max (worst, (step - allowed).maxCoeff() / size);
        was_stopped = stopped;
        last = applied;
        last_wanted = wanted;
        if (! is_waiting) ++since;
    }

    double worst = 0.0;

private:
    static bool falls (const Vec3& from, const Vec3& to)
    {
        const auto towards = from.array() * to.array();
        return (to.array().abs() <= from.array().abs()).all() && (towards >= 0.0).all();
    }

    Effort last, last_wanted, own;
    double fade_s = Bumpless::rise_s;
    Vec3 difference = Vec3::Zero();
    int since = 1 << 20, waits = 0;   // ticks
    std::uint64_t touched_at = 0;
    bool was_stopped = false;
};

/// Runs for `ticks` ticks. Calls `edit` before each one.
template <typename Edit>
Felt play (const graph::Graph& g, const std::vector<std::string>& records, unsigned seed, std::size_t ticks, BumplessRule* rule, Edit edit)
{
    const CompileOptions options { .rate_hz = rate_hz, .records = records };
    auto [plan, messages] = compile (g, catalogue(), options);
    INFO (test::text (messages));
    REQUIRE (plan);
    test::Live live { g, catalogue(), options, plan };
    test::ChanceHand left { seed, ticks }, right { seed + 1, ticks };
    live.engine().attach ("left", left);
    live.engine().attach ("right", right);

    Felt felt;
    felt.recorded.reserve (ticks * plan->taps().size());
    int unclean = 0;
    for (std::size_t k = 0; k < ticks; ++k)
    {
        edit (live, felt);
        const auto* before = &live.engine().plan();
        {
            const NoAllocation watch;
            live.engine().tick();
            unclean += watch.allocations() + watch.locks();
        }
        const bool taken = before != &live.engine().plan();
        felt.taken += taken;
        if (rule) rule->poll (live.engine().plan(), taken, right.last, live.engine().guardOf ("right").stop() != Guard::Stop::none);
        for (const auto& tap : live.engine().plan().taps())
            felt.recorded.push_back (*tap.value == *tap.value ? std::bit_cast<std::uint64_t> (*tap.value) : ~0ull);
    }
    CHECK (unclean == 0);
    felt.left = std::move (left.efforts);
    felt.right = std::move (right.efforts);
    return felt;
}

std::vector<std::string> everyOutput (const graph::Graph& g)
{
    std::vector<std::string> names;
    for (const auto& [name, value] : test::Interpreter { g, rate_hz }.outputs())
        names.push_back (name);
    return names;
}

std::size_t differing (const std::vector<Effort>& a, const std::vector<Effort>& b)
{
    std::size_t n = a.size() == b.size() ? 0 : 1000000;
    for (std::size_t k = 0; k < std::min (a.size(), b.size()); ++k)
        n += ! test::operator== (a[k], b[k]);
    return n;
}
}   // namespace

TEST_CASE ("ten seconds of edits on one side do not affect the other side, and cause no steps on their own side", "[live]")
{
    for (const unsigned seed : { 1u, 2u, 3u, 4u })
    {
        const auto steady = test::prefixed (touchable (seed, 20), "s_", "left"), wild = test::prefixed (touchable (seed + 100, 30), "e_", "right");
        const auto both = test::sideBySide (steady, wild);
        const auto records = everyOutput (steady);
        const bool is_long = seed == 1;
        const auto ticks = is_long ? test::rounds (ten_seconds) : ten_seconds / 32;

        std::mt19937 random { seed };
        BumplessRule rule;
        int failing = 0;
        const auto edited = play (both, records, seed, ticks, &rule, [&] (test::Live& live, Felt& felt) {
            for (auto edits = random() % (is_long ? 48 : 8) == 0 ? 1 + random() % 3 : 0; edits > 0; --edits)
            {
                const auto messages =
                    random() % 8 == 0 ? (random() % 2 ? live.undo() : live.redo()) : live.perform (test::randomEdit (random, live.graph(), "e_", "right"));
                felt.refused += hasErrors (messages);
                failing = hasErrors (messages) ? failing + 1 : 0;
                while (failing > 1)
                    failing = hasErrors (live.undo()) ? failing : 0;
            }
        });
        const auto quiet = play (both, records, seed, ticks, nullptr, [] (test::Live&, Felt&) {});

        INFO ("seed " << seed << ", " << edited.taken << " plans taken, " << edited.refused << " refused");
        CHECK (edited.taken > (is_long ? test::rounds (300) : 50));
        CHECK (differing (edited.left, quiet.left) == 0);
        CHECK (edited.recorded == quiet.recorded);
        CHECK (differing (edited.right, quiet.right) > ticks / 10);
        CHECK (rule.worst < 1e-9);
    }
}

TEST_CASE ("renaming, collapsing and expanding while a graph runs leaves all sinks and all nodes bit-identical", "[live]")
{
    for (unsigned seed = 1; seed <= test::rounds (10u); ++seed)
    {
        const auto g = test::sideBySide (test::prefixed (touchable (seed, 30), "s_", "left"), test::prefixed (touchable (seed + 100, 30), "e_", "right"));
        constexpr std::size_t ticks = 1000;
        std::mt19937 random { seed };
        int done = 0, broken = 0, collapsed = 0, expanded = 0;
        const auto regroup = [&] (test::Live& live, Felt&) {
            if (random() % 8 != 0) return;
            const bool back = random() % 8 == 0;
            const auto command = test::randomRegrouping (random, live.graph());
            const auto messages = back ? live.undo() : live.perform (command);
            if (test::has (messages, "wire/two_into_one"))   // the instances became separate nodes, whose sum went into a port that accepts only one wire
            {
                live.undo();
                return;
            }
            const bool refused = ! messages.empty() && messages[0].id.starts_with ("edit/");
            broken += ! refused && hasErrors (messages);
            done += ! refused;
            collapsed += ! back && ! refused && std::holds_alternative<graph::CollapseNodes> (command.edit);
            expanded += ! back && ! refused && std::holds_alternative<graph::ExpandNode> (command.edit);
            if (hasErrors (messages) && ! refused) UNSCOPED_INFO (graph::nameOf (command) << ": " << test::text (messages));
            if (live.graph().root.nodes.size() + live.graph().graphs.size() > 150)
                while (live.history().position() > 0)
                    live.undo();
        };
        const auto regrouped = play (g, {}, seed, ticks, nullptr, regroup), quiet = play (g, {}, seed, ticks, nullptr, [] (test::Live&, Felt&) {});
        INFO ("seed " << seed << ", " << done << " edits, " << collapsed << " collapsed, " << expanded << " expanded");
        CHECK (broken == 0);
        CHECK (regrouped.taken > 60);
        CHECK (collapsed > 10);
        CHECK (expanded > 5);
        CHECK (differing (regrouped.left, quiet.left) == 0);
        CHECK (differing (regrouped.right, quiet.right) == 0);
    }
}
