// SPDX-License-Identifier: MIT
#pragma once

#include "plan_names.hpp"

#include <host/code/generate/walk/cpp_walk.hpp>

#include <string>

namespace tactus::host
{

/// Writes what the records of a plan do in one tick, as the body of a member function.
class TickCode final : public CppWalk
{
public:
    explicit TickCode (PlanNames& w) : CppWalk (w.plan, "tactus::exported::"), wiring (w) {}

    /// The statements of a tick, in running order.
    std::string statements();

private:
    static const ExportedNode& exported (const PlanNode& n) { return static_cast<const ExportedNode&> (n); }
    static std::string result (const ExportedNode& n, const char* kind = "const auto ")
    {
        return (n.is_inner ? "" : kind) + PlanNames::outputsOf (n) + " = ";
    }

    void begin() override;
    void walk() override;
    bool isFinal() override { return ! wiring.noteReads(); }   // what a value was computed from may be unread if the value is
    const PlanNode* find (const void* node) const override { return wiring.nodeOf (node); }
    void call (const Record&) override {}   // there are none: every node has code

    void sum (const plan::Sum&) override;
    void strike (const plan::Strike&) override;
    void readDelay (const plan::Line&) override;
    void writeDelay (const plan::Line&, const double* from) override;
    void bypass (const plan::Bypass&, const Record&) override;
    void title (const PlanNode&) override;
    void peek (const PlanNode&) override;
    void tick (const PlanNode&, const Texts& inputs, const Text& stored, const Text& reset) override;
    void convert (Action, const plan::ConversionLink&, const Text& part) override;
    void section (const SectionStep&, const Body&) override;

    Text read (const double* value) override { return wiring.valueAt (value); }
    Text vector (const double* const* three, const Text& type) override { return wiring.valueAt (three, type); }
    Text ticks (const std::uint64_t* of) override { return wiring.ticksOf (of); }
    Text self (const PlanNode& n) const override { return n.name; }
    Text indexOf (const plan::RunningSection& s) override { return wiring.sections.at (&s) + "_ticks_now"; }
    Text samples (const double*) override;
    std::pair<Text, Text> placeOf (const PlanNode&, const plan::DrivenNode::Drive&) override;
    Text store (const PlanNode&, const plan::DrivenNode&, const plan::DrivenNode::Drive&) override;

    PlanNames& wiring;
};

}   // namespace tactus::host
