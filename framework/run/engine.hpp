// SPDX-License-Identifier: MIT
#pragma once

#include "guard.hpp"
#include "plan_swap.hpp"
#include <tactus/plan/journal.hpp>
#include <tactus/plan/plan.hpp>
#include <tactus/run/guard/bumpless.hpp>
#include <tactus/run/guard/guard_log.hpp>
#include <tactus/text/result.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tactus
{

/// Runs a plan against devices: read, tick, sum, guard, write. The same engine runs live and offline. Another plan may take over
/// between two ticks; nodes that both plans contain continue, and no role's effort jumps.
class Engine
{
public:
    /// [main thread] The plan must not be null. A role without a device reads a tool at rest at the origin, and its efforts
    /// have no effect.
    explicit Engine (std::shared_ptr<Plan>);

    /// Gives a role its device, which must outlive the engine, and the limits of its guard. [main thread, before ticking]
    void attach (std::string_view role, Device&, const GuardLimits& = {});

    /// Reports all inputs of the run to a journal, which must outlive the engine. [main thread, before ticking]
    void report (Journal&) noexcept;

    /// A device for a role that has none yet.
    struct Joining
    {
        std::string role;
        Device& device;
        GuardLimits limits {};
    };

    //==========================================================================
    // Swapping plans. The new plan is compiled with newest() as CompileOptions::before, so that it builds on the plan
    // that it replaces:
    //
    //     auto waiting = engine.withdraw();
    //     auto compiled = compile (graph, catalogue(), { .before = &engine.newest(), .withdrawn = waiting.get() });
    //     engine.submit (compiled.plan ? compiled.plan : waiting);

    /// Withdraws the plan submitted last, if no tick has picked it up yet. Returns null otherwise. [main thread]
    std::shared_ptr<Plan> withdraw();

    /// The running plan, or the one submitted to replace it. [main thread]
    const Plan& newest() const noexcept { return *newestShared(); }
    const std::shared_ptr<Plan>& newestShared() const noexcept { return plans.newest().plan; }

    /// The next tick switches to this plan. From that tick on, the joining devices are read and written; their efforts rise
    /// from zero, as after any takeover. The devices must outlive the engine. Null changes nothing. The plan must have the same
    /// rate as the first plan and contain the roles that join. None of these roles may have a device already. [main thread]
    void submit (std::shared_ptr<Plan>, std::span<const Joining> = {});

    /// Tightens the limits of a role's guard by these, which never loosens any (Guard::tighten). It takes effect with the next submitted plan that has
    /// the role, and its device learns its limits for signals at once. Does nothing for an unknown role. [main thread]
    void tighten (std::string_view role, const GuardLimits&);

    /// Frees plans that are no longer used; submit does this too. Returns how many are left. [main thread]
    std::size_t clear();

    //==========================================================================
    /// Finds a parameter of the newest plan by name (see plan::findParams). If the name covers several instances, returns the
    /// parameter of the first one. [main thread]
    Result<plan::ParamRef> param (std::string_view name);

    /// Like param, but returns the parameter of every instance that the name covers. [main thread]
    Result<std::vector<plan::ParamRef>> params (std::string_view name);

    /// Sets the target of a parameter; the value ramps to it (plan/ramps.hpp). [any thread]
    void set (const plan::ParamRef&, double) noexcept;

    /// Finds hit inputs of the newest plan by name, in all instances that the name covers. [main thread]
    Result<std::vector<plan::HitRef>> hits (std::string_view name);

    /// Triggers a hit of this speed (m/s) on one tick: the next one on which the node runs. Hits between two ticks are summed.
    /// [any thread]
    void strike (const plan::HitRef&, double speed) noexcept;

    //==========================================================================
    /// Runs one tick. Allocates nothing, takes no lock, reads no clock. [tick thread]
    void tick() noexcept;

    /// Bit-identical to tick(), but `step` ticks the plan, either by Plan::tick or by running all its records in order, so that
    /// `step` can do something between the records. [tick thread]
    template <typename Step>
    void tick (Step&& step) noexcept
    {
        beforePlan();
        step (*running->plan);
        afterPlan();
    }

    /// Switches to the submitted plan, if there is one, without waiting for the next tick. Values set after this call apply to
    /// the new plan. [tick thread]
    void takeSubmitted() noexcept;

    /// Brings the efforts of all roles to zero smoothly, and keeps them there. [tick thread]
    void halt() noexcept;

    /// Ends a halt: the efforts rise again, as the guards' ramps allow. [tick thread]
    void resume() noexcept;

    /// While `so` is true, no reading is valid and all guards hold the efforts at zero. Used for ticks that do not come from the chosen
    /// clock. A log records these readings as invalid. [tick thread]
    void invalidateReadings (bool so) noexcept { readings_invalid = so; }

    /// Tells the guards how much time has passed since the last tick, in s, by the wall clock (PassedTime). Call it before each tick on which
    /// this is not one period, as it always is in simulated time. [tick thread]
    void passTime (double s) noexcept
    {
        passed_s = s;
        if (journal && s != period) journal->passed (s);
    }

    /// Like halt, but callable from anywhere, including a signal handler, and it also applies to roles that join later. It
    /// takes effect on the next tick; resume does not end it. [any thread]
    void emergencyStop() noexcept;

    /// Ends an emergency stop and every other latched stop of the guards (Guard::latches): the efforts rise again, as
    /// the guards' ramps allow. [any thread]
    void rearm() noexcept;

    bool isEmergency() const noexcept { return emergency.load (std::memory_order_relaxed); }   ///< [any thread]

    /// The latest stops of all guards. [any thread]
    const GuardLog& guardLog() const noexcept { return stops; }

    /// True once no device has an effort on it, so that all devices can be released without a jump. [tick thread]
    bool isAtRest() const noexcept;

    /// Saves or restores what the next ticks depend on: the plan, the guards and the simulated devices. Refuses a device that is not simulated. What a
    /// guard is asked to hold back stays, and so does the log of the guards. See Run::save. [tick thread]
    void serialize (StateArchive&);

    Plan& plan() noexcept { return *running->plan; }   ///< the running plan   [tick thread]

    /// A role of the running plan. References in it stay valid as long as the engine lives, and the name never
    /// changes.
    struct RoleView
    {
        std::string_view name;
        const Effort& applied;   ///< the effort that the guard allowed on the last tick
        const Guard& guard;
    };

    /// Roles are numbered as in plan().roles(). [tick thread]
    std::size_t roleCount() const noexcept { return running->channels.size(); }
    RoleView role (std::size_t i) const noexcept
    {
        return { running->channels[i]->role, running->plan->roles()[i].state->applied, running->channels[i]->guard };
    }

    const Guard& guardOf (std::string_view role) const;
    double time_s() const noexcept { return static_cast<double> (ticks) / rate_hz; }

private:
    struct Channel
    {
        std::string role;
        Device* device = nullptr;
        Guard guard {};
        Bumpless bumpless {};
        std::uint64_t touched_at = 0;   // the tick on which a plan last changed anything upstream of this role
        bool is_news = false;           // the nodes are not bound to its device yet   [tick thread, once a plan with it is submitted]
        bool to_announce = false;       // the next plan tells its nodes of the device   [main thread]
        GuardLimits limits {};          // of the guard, once the last submitted plan runs   [main thread]
        bool is_tightened = false;      // since the role got its device   [main thread]
    };

    /// A node that belongs to a role; its type has one of the hooks bind and learn.
    struct BoundNode
    {
        const NodeType* type;
        void* node;
        const DeviceState* state;
        Channel* channel;
    };

    /// Memory for summing the sinks of a role.
    struct Scratch
    {
        std::vector<Effort> efforts;
        std::vector<double> numbers;
    };

    /// The limits that a role's guard is tightened to when the plan takes over.
    struct Tightening
    {
        std::size_t role;
        GuardLimits limits;
    };

    /// A plan and the engine's state for it.
    struct Running
    {
        std::shared_ptr<Plan> plan;
        std::vector<Channel*> channels;   // in the order of plan->roles()
        std::vector<BoundNode> bound;
        Scratch scratch;
        std::vector<Tightening> tightenings;
    };

    static Effort total (const Plan::RoleUse&, Scratch&) noexcept;

    void beforePlan() noexcept;
    void afterPlan() noexcept;

    Channel* find (std::string_view role) const noexcept;
    Channel& channelOf (const std::string& role);
    Channel& makeChannel (const std::string& role);
    void join (const Joining&, const Plan&);
    static void attachDevice (Channel&, Device&, const GuardLimits&, const Plan&, double dt_s);
    static void sizeForLayout (const Running&);
    static void bindDevices (Running&) noexcept;
    void tightenGuards (const Running&) noexcept;
    void applyStops() noexcept;
    std::unique_ptr<Running> makeRunning (std::shared_ptr<Plan>);
    void takeOver (Running&) noexcept;
    void fadeAgain() noexcept;
    void turnKnobs() noexcept;

    double rate_hz;
    std::vector<std::unique_ptr<Channel>> channels;   // of all roles so far; if a role has several, the last one is in use   [main thread]
    PlanSwap<Running> plans;
    bool has_withdrawn = false;         // the last submitted plan was withdrawn   [main thread]
    std::atomic<bool> touched = true;   // a knob was turned, a hit triggered, or one of the next two flags set; the tick thread clears it
    std::atomic<bool> emergency = false, rearming = false;
    GuardLog stops;

    // Used by the tick thread.
    Running* running;
    Journal* journal = nullptr;
    bool fresh = true;         // the running plan has not ticked yet
    bool is_stopped = false;   // the guards have been told of the emergency stop
    bool readings_invalid = false;
    double period, passed_s;   // in s; passed_s: since the last tick
    std::uint64_t ticks = 0;
    std::uint64_t settled_at = 0;   // by this tick, every section has run at least once since the takeover
};

}   // namespace tactus
