// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/build/instance.hpp>
#include <tactus/plan/journal.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace tactus::plan
{

/// Finds the nodes of a plan by their knobs: a list of the boards that hold the knobs, sorted by address. Made on the main thread, and
/// shared by plans that contain the same nodes.
class KnobIndex
{
public:
    static constexpr std::uint32_t none = ~std::uint32_t {};

    explicit KnobIndex (const std::vector<Instance>&);   // [main thread]

    /// A board, and the number of the node at each of its places; `none` if the node is not in the plan.
    struct Entry
    {
        std::shared_ptr<KnobBoard> board;
        std::vector<std::uint32_t> nodes;
    };

    const std::vector<Entry>& boards() const noexcept { return all; }
    std::uint32_t operator[] (const Knobs&) const noexcept;   ///< number of the node, or `none`

private:
    std::vector<Entry> all;
};

/// Moves the knobs of a plan's nodes to their targets, in a straight line that takes ramp_s. A new target during a ramp starts
/// a new ramp from the current value. Choices, limits that are set or taken away, and nodes that have not ticked yet, change immediately.
///
/// No function visits all nodes. The cost depends only on the number of knobs that were turned or are moving.
class Ramps
{
public:
    static constexpr double ramp_s = 0.020;

    /// `index` is that of the instances. [main thread]
    void prepare (const std::vector<Instance>& instances, std::shared_ptr<const KnobIndex> index, double rate_hz);

    void poll (Journal* = nullptr) noexcept;    ///< starts ramps to all targets set since the last call, and passes hits on   [tick thread]
    void goOn (const Ramps& before) noexcept;   ///< continues the ramps of the previous plan                                     [tick thread]
    void serialize (StateArchive&);             ///< what the knobs do not say; those must have been restored                    [tick thread]
    void startAll() noexcept;                   ///< from now on, new targets of all nodes start ramps                          [tick thread]

    /// Advances all ramps by one tick. [tick thread]
    void step() noexcept
    {
        if (! moving.empty()) move();
    }

    /// True if a parameter was written after the last call of forgetWritten(), or if there was none. [tick thread]
    bool hasWritten() const noexcept { return has_written; }
    void forgetWritten() noexcept { has_written = false; }   // [tick thread]

    void head (std::size_t instance, std::size_t knob, double to, bool at_once = false) noexcept;   // [tick thread]

    /// A node continues another build of itself, including its ramps. [tick thread]
    void inherit (std::size_t instance, const Knobs& old) noexcept;

    const std::shared_ptr<const KnobIndex>& sharedIndex() const noexcept { return index; }

private:
    void move() noexcept;
    void turn (std::size_t instance, Journal*) noexcept;
    static void strike (std::size_t instance, const Instance&, Journal*) noexcept;

    const std::vector<Instance>* instances = nullptr;
    std::shared_ptr<const KnobIndex> index;
    std::vector<std::uint32_t> moving;   // numbers of the instances with a ramp; has room for all instances
    int ticks = 1;                       // length of a ramp, in ticks
    bool has_written = true;
};

}   // namespace tactus::plan
