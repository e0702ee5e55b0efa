// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/course.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/run/run.hpp>

#include <array>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The values of the ports of a canvas while a graph runs: the latest values of many ports, and the course of one of them, in which no tick is left
/// out. Costs the run one test per tick while no port is wanted. [main thread]
class PortFeed final : public RunListener
{
public:
    static constexpr std::size_t most = 512;             ///< components of all ports, at most
    static constexpr double frames_per_second = 120.0;   ///< how often values are taken, at most
    static constexpr std::size_t columns = 240;          ///< length of a course, in frames

    /// A port, or one component of a vector. A port of several instances is shown by the first of them.
    struct Reading
    {
        std::vector<double> values;   ///< one per component; the latest
        Quantity quantity = Quantity::any;
        std::string unit;   ///< SI symbol
    };

    /// The ports to watch, such as "drag.force", the most important ones first. Asked whenever a graph is compiled, so that an edit and its
    /// new wires need one plan and not two. Unset: none.
    std::function<std::vector<std::string>()> portsNow;
    std::function<void()> onWanted;   ///< called when portsNow() has changed without an edit

    /// Follows this port tick by tick; "" for none. It must be one of portsNow().
    void follow (const std::string& port);

    void refresh();   ///< call many times a second
    void clear();     ///< nothing runs any more: forgets all values

    /// Empty until a value has arrived.
    std::optional<Reading> of (const std::string& port) const;

    /// The level of a port now, compared with the most that it carried in the last seconds, from 0 to 1. Lengths and angles count while they change,
    /// everything else while it is not 0.
    double level (const std::string& port) const;

    /// The recent course of the port that is followed, the oldest column first, and how many of them make a second.
    const Course& course() const noexcept { return columns_now; }
    double columnsPerSecond() const noexcept { return per_second; }

    std::vector<std::string> ports() const override { return portsNow ? portsNow() : std::vector<std::string> {}; }
    void planComes (const Plan&) override;
    void after (const Plan&, std::uint64_t tick, bool halts) noexcept override;

private:
    struct Frame
    {
        std::uint64_t plan = 0, followed = 0;
        std::size_t size = 0;
        std::array<double, most> values {};
        CourseColumn column {};
    };

    /// One component of a wanted port.
    struct Component
    {
        static constexpr std::size_t window = 24;   ///< frames over which activity is judged

        std::string name;
        Quantity quantity = Quantity::any;
        std::string unit;
        std::size_t tap = 0;
        std::array<double, window> recent {};
        std::size_t seen = 0;
        double loudest = 0.0;

        void add (double value) noexcept;
        double activity() const noexcept;
    };

    /// Up to three taps that are followed, and a number that tells one request from the next, in one word for the tick thread.
    static std::uint64_t packed (const std::array<std::uint16_t, 3>& taps, std::uint16_t number) noexcept;
    static constexpr std::uint16_t no_tap = 0xffff;

    std::vector<const Component*> partsOf (const std::string& port) const;
    void followNow();
    void accumulate (const Plan&) noexcept;
    void collect();

    std::vector<std::string> planned;   // the ports of the latest plan
    std::vector<Component> components;
    std::vector<std::uint64_t> serials;   // of plans that all have these taps
    std::string followed_port;
    std::uint16_t requests = 0;
    double per_second = frames_per_second;
    Course columns_now;

    SpscRing<Frame> frames { 64 };
    std::array<std::atomic<std::size_t>, most> taps {};
    std::atomic<std::size_t> count = 0;
    std::atomic<std::uint32_t> every = 0;   // ticks between two frames; 0: none
    std::atomic<std::uint64_t> followed = 0;

    // [tick thread]
    std::uint64_t following = 0, plan_before = 0;
    CourseColumn extremes {};
    bool is_begun = false;   // the column has values
    bool is_whole = false;   // the column has been followed since its first tick
};

}   // namespace tactus::host
