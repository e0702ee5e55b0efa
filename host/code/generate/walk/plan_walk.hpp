// SPDX-License-Identifier: MIT
#pragma once

#include "visit_record.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// A node of a plan whose code is known.
struct PlanNode
{
    std::size_t instance = 0;   ///< number in Plan::instances
    std::string name;           ///< in the code: "grain_wave"
    std::string type, header;   ///< "tactus::nodes::Grating", "tactus/nodes/texture/grating.hpp"
};

/// Goes through the records of a plan and decides what a tick does, and in which order. The derived class writes each piece in its language.
/// Values, conditions and variables are texts in that language. [main thread]
class PlanWalk
{
public:
    virtual ~PlanWalk() = default;
    PlanWalk (const PlanWalk&) = delete;
    PlanWalk& operator= (const PlanWalk&) = delete;

protected:
    using Text = std::string;
    using Texts = std::vector<std::string>;
    using Body = std::function<void()>;

    explicit PlanWalk (const Plan& p) : plan (p) {}

    /// Writes the tick. What must be in memory or is read at all may be known only after that, so it is written until nothing new is found.
    void write();
    void records (std::span<const Record>);
    void callOnly (const Record&);

    const plan::FlatNode& flat (const PlanNode& n) const { return plan.flat().nodes[n.instance]; }
    const NodeType& type (const PlanNode& n) const { return *flat (n).type; }
    void* object (const PlanNode& n) const { return plan.instances()[n.instance].node.get(); }
    bool isLarge() const { return plan.records().size() > records_in_part; }

    const Plan& plan;
    bool is_inner = false;               ///< in a section
    int parts = 0;                       ///< so far
    std::size_t count = 0, called = 0;   ///< records so far, and those among them that are called

    /// The code is in parts: functions that run one after another.
    virtual void begin() = 0;
    virtual void beginPart() {}
    virtual void endPart() {}
    virtual void walk() { records (plan.records()); }
    virtual bool isFinal() = 0;   ///< false: write it once more

    virtual const PlanNode* find (const void* node) const = 0;   ///< null if its code is not known
    virtual void call (const Record&) = 0;                       ///< lets a record run as the plan runs it

    virtual void sum (const plan::Sum&) = 0;
    virtual void strike (const plan::Strike&) = 0;
    virtual void readDelay (const plan::Line&) = 0;
    virtual void writeDelay (const plan::Line&, const double* from) = 0;
    virtual void bypass (const plan::Bypass&, const Record& r) { callOnly (r); }

    virtual void title (const PlanNode&) = 0;   ///< before the node ticks
    virtual void peek (const PlanNode&) = 0;
    virtual Texts inputs (const PlanNode&, const double* const* sources, const Text& fault) = 0;   ///< `fault` is empty if no wire drives the node

    /// `stored` has the stored parameters, if the node asks for them. Where `reset` is true, the outputs become those of a new node.
    virtual void tick (const PlanNode&, const Texts& inputs, const Text& stored, const Text& reset) = 0;

    virtual Text drives (const PlanNode&) = 0;   ///< begins to drive parameters; what it returns is passed to the following
    virtual void drive (const PlanNode&, const Text& drives, const plan::DrivenNode::Drive&) = 0;
    virtual void updateIfMoved (const PlanNode&, const Text& drives) = 0;
    virtual Text faultOf (const Text& drives) { return drives; }   ///< whether a wire is at fault
    virtual Text stored (const PlanNode&, const plan::DrivenNode&) = 0;

    enum class Action
    {
        latch,
        silence,
        gather,
        deliver,
        head,
        follow
    };

    /// A tick of a section that runs several times.
    struct Turn
    {
        Text index, next, number;   ///< from 0; from 1; of all ticks of the section
    };

    virtual void convert (Action, const plan::ConversionLink&, const Text& part) = 0;   ///< what ConversionLink does
    virtual void section (const SectionStep&, const Body&) = 0;
    virtual Text onPhase (const plan::RunningSection&, const Body& first, const Body& others) = 0;   ///< returns the phase; `others` may be empty
    virtual void repeat (const plan::RunningSection&, const std::function<void (const Turn&)>&) = 0;
    virtual void onSecond (const Turn&, const Body&) = 0;
    virtual Text partOf (const Text& count, std::uint64_t factor) = 0;   ///< count / factor
    virtual void sample (const Turn&, const plan::RunningSection::Samples&) = 0;

private:
    /// A compiler takes much longer for one function of thousands of nodes than for several smaller ones.
    static constexpr std::size_t records_in_part = 150;

    void record (const Record&);
    void startPart();
    void every (const plan::RunningSection&);
    void times (const plan::RunningSection&);
    void inside (const plan::RunningSection&);
    void follow (const plan::RunningSection&, const Text& count);
    void each (Action, const std::vector<plan::ConversionLink>&, const Text& part = {});
    void driven (const PlanNode&, const plan::DrivenNode&, const double* const* sources);

    std::size_t in_part = 0;
};

}   // namespace tactus::host
