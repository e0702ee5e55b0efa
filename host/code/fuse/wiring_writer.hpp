// SPDX-License-Identifier: MIT
#pragma once

#include "fused_nodes.hpp"
#include "fused_values.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// Writes what the records of a plan do in one tick, in LLVM's assembly language: calls of the functions that the bitcode of nodes has
/// (bitcode.hpp). Each node gets its inputs and outputs as in the plan, by pointers; but where only fused code uses a value, the pointer
/// leads to a local variable, which LLVM removes once it has inlined the calls. [main thread]
class WiringWriter final : public PlanWalk
{
public:
    explicit WiringWriter (const Plan&);

    FusedCode fused();

private:
    using Kind = FusedValues::Place::Kind;

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
    void title (const PlanNode&) override { self.clear(); }
    void peek (const PlanNode&) override;
    Texts inputs (const PlanNode&, const double* const* sources, const Text& fault) override;
    void tick (const PlanNode&, const Texts& inputs, const Text& stored, const Text& reset) override;
    Text drives (const PlanNode&) override;
    void drive (const PlanNode&, const Text& drives, const plan::DrivenNode::Drive&) override;
    void updateIfMoved (const PlanNode&, const Text& drives) override;
    Text faultOf (const Text& drives) override { return isSet (offset (drives, 1, "i8")); }
    Text stored (const PlanNode&, const plan::DrivenNode&) override;
    void convert (Action, const plan::ConversionLink&, const Text& part) override;
    void section (const SectionStep&, const Body& body) override { body(); }
    Text onPhase (const plan::RunningSection&, const Body& first, const Body& others) override;
    void repeat (const plan::RunningSection&, const std::function<void (const Turn&)>&) override;
    void onSecond (const Turn& turn, const Body& body) override { when (result ("icmp eq i64 " + turn.index + ", 1"), body); }
    Text partOf (const Text& steps, std::uint64_t factor) override;
    void sample (const Turn&, const plan::RunningSection::Samples&) override;

    std::string whole() const;
    void copy (const std::string& from, const std::string& to, std::size_t size);
    void takeOutputs (const PlanNode&, const std::string& outputs);
    void keep (const double* at, const std::string& value);
    const std::string& selfOf (const PlanNode&);

    static std::string exactly (double);     ///< a number with the same bits
    std::string read (const double*);        ///< the value
    std::string pointerTo (const double*);   ///< the value's address, or that of a copy
    std::string addressOf (const double*, const FusedValues::Place&);

    std::string room (const std::string& type);                                                   ///< a local variable: its address
    std::string array (const std::string& element, std::size_t size, const Texts& values = {});   ///< the same for an array that begins with these
    std::string bytes (std::size_t size) { return array ("i8", size); }
    std::string outputsOf (const PlanNode& n) { return bytes (std::max<std::size_t> (type (n).outputs_size, 1)); }
    std::string object (const void*, const std::string& type = "i8");   ///< an object of the plan: its address
    std::string load (const std::string& type, const std::string& from);
    void store (const std::string& type, const std::string& value, const std::string& to);
    std::string offset (const std::string& bytes, std::size_t, const std::string& type);

    /// The result of an instruction, or of a call. Arguments have their types.
    std::string result (const std::string& instruction);
    std::string valueOf (const std::string& type, const std::string& function, const std::vector<std::string>& arguments);
    void run (const std::string& function, const std::vector<std::string>& arguments, const std::string& how = {});
    void runNode (const PlanNode&, const std::string& function, const std::vector<std::string>& arguments);
    void declare (const std::string& type, const std::string& function, const std::vector<std::string>& arguments);

    /// A block of instructions that can be jumped to.
    std::string label() { return "b" + std::to_string (++names); }
    void startBlock (const std::string& name) { code += name + ":\n"; }
    void jump (const std::string& to) { line ("br label %" + to); }
    void when (const std::string& condition, const Body& yes, const Body& no = {});
    std::string isSet (const std::string& flag) { return result ("icmp ne i8 " + load ("i8", flag) + ", 0"); }

    void line (std::string_view text) { code.append ("  ").append (text).append ("\n"); }

    std::string functions, rooms, code;   // whole functions; of the function that is being written
    std::string self;                     // the node that ticks; empty until something needs it
    std::map<std::string, std::string> declarations;
    std::set<std::string> constants;
    FusedValues values;
    FusedNodes nodes;
    int names = 0;
};

}   // namespace tactus::host
