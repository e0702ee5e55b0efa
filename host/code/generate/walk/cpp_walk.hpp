// SPDX-License-Identifier: MIT
#pragma once

#include "plan_walk.hpp"

#include <string_view>
#include <utility>

namespace tactus::host
{

/// Writes the tick of a plan as C++. How values and objects are called is up to the derived class. [main thread]
class CppWalk : public PlanWalk
{
protected:
    /// `space` has the parts that are not nodes: "tactus::exported::".
    CppWalk (const Plan& p, std::string space) : PlanWalk (p), parts_space (std::move (space)) {}

    virtual Text read (const double*) = 0;
    virtual Text vector (const double* const* three, const Text& type) = 0;   ///< `type` comes before a list in braces
    virtual Text ticks (const std::uint64_t*) = 0;
    virtual Text self (const PlanNode&) const = 0;
    virtual Text indexOf (const plan::RunningSection&) = 0;   ///< a new name
    virtual Text samples (const double*) = 0;                 ///< the array that begins with this value
    virtual Text list (const PlanNode&, const PortSheet&, const double* const* sources, int slots, const Text& fault);

    /// The member that is driven, and its stored value.
    virtual std::pair<Text, Text> placeOf (const PlanNode&, const plan::DrivenNode::Drive&) = 0;
    virtual Text store (const PlanNode&, const plan::DrivenNode&, const plan::DrivenNode::Drive&) = 0;   ///< the statement that does this

    void begin() override { code.clear(); }
    Texts inputs (const PlanNode&, const double* const* sources, const Text& fault) override;
    Text drives (const PlanNode&) override;
    void drive (const PlanNode&, const Text& drives, const plan::DrivenNode::Drive&) override;
    void updateIfMoved (const PlanNode&, const Text& drives) override;
    Text stored (const PlanNode&, const plan::DrivenNode&) override;
    Text onPhase (const plan::RunningSection&, const Body& first, const Body& others) override;
    void repeat (const plan::RunningSection&, const std::function<void (const Turn&)>&) override;
    void onSecond (const Turn&, const Body&) override;
    Text partOf (const Text& steps, std::uint64_t factor) override;
    void sample (const Turn&, const plan::RunningSection::Samples&) override;

    /// Calls the tick of a node within a statement that begins with `head` and closes with `end`.
    void callTick (const PlanNode&, const Text& head, const Texts& inputs, const Text& stored, const Text& end = {});

    Text sumOf (const plan::Sum&);
    Text titleOf (const PlanNode&) const;   ///< a comment
    virtual void block (const Text& head, const Body&);
    void line (std::string_view text = {}) { code.append (text.empty() ? 0 : indent, ' ').append (text).append ("\n"); }

    std::string code;
    std::size_t indent = 0;

private:
    void statement (const Text& head, const Texts& pieces, const Text& end);

    const std::string parts_space;
};

}   // namespace tactus::host
