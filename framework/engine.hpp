// SPDX-License-Identifier: MIT
#pragma once

#include "bumpless.hpp"
#include "guard.hpp"
#include "guard_log.hpp"
#include "handover.hpp"
#include "journal.hpp"
#include "message.hpp"
#include "plan/plan.hpp"

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

/// Runs a plan against devices: read, tick, sum, guard, write. The same engine runs live and offline. Another plan may
/// take over between two ticks; nodes that are in both go on, and no role's effort steps.
class Engine
{
public:
    /// [main thread] The plan must not be null. A role without a device reads rest at the origin and acts on nothing.
    explicit Engine (std::shared_ptr<Plan>);

    /// Gives a role its device, which must outlive the engine, and the limits of its guard. [main thread, before ticking]
    void attach (std::string_view role, Device&, const GuardLimits& = {});

    /// Tells a journal, which must outlive the engine, all that comes in. [main thread, before ticking]
    void report (Journal&) noexcept;

    /// A device for a role that has none.
    struct Joining
    {
        std::string role;
        Device& device;
        GuardLimits limits {};
    };

    //==========================================================================
    // Another plan. It is compiled with newest() as CompileOptions::before, so that it is built on the one it replaces:
    //
    //     auto waiting = engine.withdraw();
    //     auto compiled = compile (graph, catalogue(), { .before = &engine.newest(), .withdrawn = waiting.get() });
    //     engine.submit (compiled.plan ? compiled.plan : waiting);

    /// Takes back the plan that was submitted last, if no tick has taken it yet; else null. [main thread]
    std::shared_ptr<Plan> withdraw();

    /// The plan that ticks, or is about to. [main thread]
    const Plan& newest() noexcept { return *handover.newest().plan; }

    /// The next tick takes it, and from that tick on, devices that join are read and written; their efforts rise from
    /// zero as after any takeover. They must outlive the engine. Null changes nothing. The plan's rate must be that of the
    /// first, it must have the roles that are joined, and none of them may have a device already. [main thread]
    void submit (std::shared_ptr<Plan>, std::span<const Joining> = {});

    /// Frees plans that are used no more, as submit does too. Returns how many there still are. [main thread]
    std::size_t clear();

    //==========================================================================
    /// A parameter of the newest plan by its name: one component of a vector, one entry of a list. Of several instances
    /// the first. [main thread]
    std::variant<plan::ParamRef, Message> param (std::string_view name);

    /// The same, of all instances that the name stands for. [main thread]
    std::variant<std::vector<plan::ParamRef>, Message> params (std::string_view name);

    /// Turns a parameter; a ramp leads there (plan/ramps.hpp). [any thread]
    void set (const plan::ParamRef&, double) noexcept;

    /// Inputs for hits of the newest plan by their name, in all instances that it stands for. [main thread]
    std::variant<std::vector<plan::HitRef>, Message> hits (std::string_view name);

    /// Has a hit of this speed (m/s) come to what stands there, on one tick: the next one on which the node runs. Those that
    /// come between two ticks add up. [any thread]
    void strike (const plan::HitRef&, double speed) noexcept;

    //==========================================================================
    /// One sample. Allocates nothing, takes no lock, asks no clock. [tick thread]
    void tick() noexcept;

    /// The same to the bit, where `step` has the plan tick: by Plan::tick, or by all of its records in their order, for those
    /// who want to do something in between. [tick thread]
    template <typename Step>
    void tick (Step&& step) noexcept
    {
        beforePlan();
        step (*running->plan);
        afterPlan();
    }

    /// Takes the plan that was submitted, if there is one, as the next tick would do first: what is set afterwards is set
    /// for that plan. [tick thread]
    void takeSubmitted() noexcept;

    /// Brings the efforts of all roles to zero, smoothly, and keeps them there. [tick thread]
    void halt() noexcept;

    /// After a halt: the efforts rise again, as the guards' ramps allow. [tick thread]
    void resume() noexcept;

    /// While so, no reading is valid, whatever its device says, and all guards hold the efforts at zero: for ticks that do not
    /// come from the clock that was chosen. A log has it as readings that are not valid. [tick thread]
    void mistrustReadings (bool so) noexcept { mistrusting = so; }

    /// As halt, from anywhere: also from a signal handler, and also for roles that come up later. The next tick heeds it, and
    /// no resume ends it. [any thread]
    void emergencyStop() noexcept;

    /// Ends an emergency stop, and whatever else has stopped a guard for good (Guard::latches): the efforts rise again, as the
    /// guards' ramps allow. [any thread]
    void rearm() noexcept;

    bool isEmergency() const noexcept { return emergency.load (std::memory_order_relaxed); }   ///< [any thread]

    /// The latest stops of all guards. [any thread]
    const GuardLog& guardLog() const noexcept { return stops; }

    /// True once nothing is on any device, so that it can be let go without a step. [tick thread]
    bool isAtRest() const noexcept;

    Plan& plan() noexcept { return *running->plan; }   ///< the one that ticks   [tick thread]

    /// A role of the plan that ticks. What is referred to lives as long as the engine, and the name never changes.
    struct RoleView
    {
        std::string_view name;
        const Effort& applied;   ///< on the last tick
        const Guard& guard;
    };

    /// Roles are numbered as plan().roles. [tick thread]
    std::size_t roleCount() const noexcept { return running->channels.size(); }
    RoleView role (std::size_t i) const noexcept { return { running->channels[i]->role, running->plan->roles[i].state->applied, running->channels[i]->guard }; }

    const Guard& guardOf (std::string_view role) const;
    double time_s() const noexcept { return static_cast<double> (ticks) / rate_hz; }

private:
    struct Channel
    {
        std::string role;
        Device* device = nullptr;
        Guard guard {};
        Bumpless bumpless {};
        std::uint64_t touched_at = 0;   // the tick that took the last plan to change what leads here
        bool is_news = false;           // nodes do not know yet what its device has
    };

    /// A node of a role.
    struct BoundNode
    {
        void (*bind) (void* node, const DeviceState&);
        void* node;
        const DeviceState* state;
        Channel* channel;
    };

    /// To sum the sinks of a role in.
    struct Scratch
    {
        std::vector<Effort> efforts;
        std::vector<double> numbers;
    };

    /// A plan with what the engine keeps beside it.
    struct Running
    {
        std::shared_ptr<Plan> plan;
        std::vector<Channel*> channels;   // as plan->roles
        std::vector<BoundNode> bound;
        Scratch scratch;
    };

    static Effort total (const Plan::RoleUse&, Scratch&) noexcept;

    void beforePlan() noexcept;
    void afterPlan() noexcept;

    Channel* find (std::string_view role) const noexcept;
    Channel& channelOf (const std::string& role);
    Channel& makeChannel (const std::string& role);
    void join (const Joining&, const Plan&);
    static void equip (Channel&, Device&, const GuardLimits&, const Plan&, double dt_s);
    static void introduce (Running&) noexcept;
    void heedStops() noexcept;
    std::unique_ptr<Running> makeRunning (std::shared_ptr<Plan>);
    void takeOver (Running&) noexcept;
    void fadeAgain() noexcept;
    void turnKnobs() noexcept;

    double rate_hz;
    std::vector<std::unique_ptr<Channel>> channels;   // of all roles there ever were; the last of a role is the one in force   [main thread]
    Handover<Running> handover;
    std::atomic<bool> touched = true;   // some knob is, or a plan is new, or one of these
    std::atomic<bool> emergency = false, rearming = false;
    GuardLog stops;

    // Of the tick thread.
    Running* running;
    Journal* journal = nullptr;
    bool fresh = true;         // the plan has not ticked yet
    bool is_stopped = false;   // the guards know of the emergency
    bool mistrusting = false;
    std::uint64_t ticks = 0;
    std::uint64_t settled_at = 0;   // the tick by which all has run that was changed
};

}   // namespace tactus
