// SPDX-License-Identifier: MIT
#pragma once

#include "fused_nodes.hpp"
#include "fused_values.hpp"

#include <host/code/generate/walk/cpp_walk.hpp>

#include <cstdint>
#include <string>
#include <utility>

namespace tactus::host
{

/// Writes what the records of a plan do in one tick, as a C++ function. [main thread]
class CodeWriter final : public CppWalk
{
public:
    CodeWriter (const Plan&, const FusedCode::Classes&);

    FusedCode fused();

private:
    void begin() override;
    void beginPart() override;
    void endPart() override;
    bool isFinal() override { return values.settled(); }
    const PlanNode* find (const void* node) const override { return nodes.find (node); }
    void call (const Record&) override;

    void sum (const plan::Sum&) override;
    void strike (const plan::Strike&) override;
    void readDelay (const plan::Line&) override;
    void writeDelay (const plan::Line&, const double* from) override;
    void title (const PlanNode&) override;
    void peek (const PlanNode&) override;
    void tick (const PlanNode&, const Texts& inputs, const Text& stored, const Text& reset) override;
    void convert (Action, const plan::ConversionLink&, const Text& part) override;
    void section (const SectionStep&, const Body&) override;

    Text read (const double*) override;
    Text vector (const double* const* three, const Text&) override;
    Text ticks (const std::uint64_t* of) override { return "p.ticks (" + values.number (of) + ")"; }
    Text self (const PlanNode& n) const override { return n.name + "_now"; }   // the peek of a node may be in another part of the code
    Text indexOf (const plan::RunningSection&) override { return fresh ("i"); }
    Text samples (const double* first) override { return "(&" + value (first) + ")"; }
    Text list (const PlanNode&, const PortSheet&, const double* const* sources, int slots, const Text& fault) override;
    std::pair<Text, Text> placeOf (const PlanNode&, const plan::DrivenNode::Drive&) override;
    Text store (const PlanNode&, const plan::DrivenNode&, const plan::DrivenNode::Drive&) override;
    void block (const Text& head, const Body&) override;

    std::string whole() const;
    std::pair<Text, Text> outputs (const PlanNode&);
    void keep (const double* out, const char* stem, const Text& is);
    Text value (const void* at) { return "p.value (" + values.number (at) + ")"; }
    Text size (const std::size_t* at) { return "p.as<std::size_t> (" + values.number (at) + ")"; }
    Text flag (const bool* at) { return "p.as<bool> (" + values.number (at) + ")"; }
    Text fresh (const char* stem) { return stem + std::to_string (++names); }

    FusedValues values;
    FusedNodes nodes;
    std::size_t names = 0;
};

}   // namespace tactus::host
