// SPDX-License-Identifier: MIT
#pragma once

#include "plan_writer.hpp"

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
class WiringWriter final : public PlanWriter
{
public:
    explicit WiringWriter (const Plan& plan) : PlanWriter (plan, {}) {}

private:
    /// A local array.
    class Array
    {
    public:
        Array (WiringWriter& w, const std::string& element, std::size_t size)
            : writer (w), type ("[" + std::to_string (size) + " x " + element + "]"), all (w.room (type))
        {
        }

        std::string entry (std::size_t) const;   ///< its address

    private:
        WiringWriter& writer;
        const std::string type, all;
    };

    bool has (const std::string& header) const override;
    void begin() override;
    void beginPart() override;
    void endPart() override;
    std::string end (const std::vector<const Known*>&) override;

    void sum (const plan::Sum&, bool is_inner) override;
    void strike (const plan::Strike&, bool is_inner) override;
    void readDelay (const plan::Line&) override;
    void writeDelay (const double* from, const plan::Line&) override;
    void peek (const Known&, bool is_inner) override;
    void node (const Known&, const Record&, bool is_inner) override;
    void driven (const Known&, const Record&, bool is_inner) override;
    void every (const plan::RunningSection&) override;
    void times (const plan::RunningSection&) override;
    void call (const Record&) override;

    std::string drive (const plan::DrivenNode&);
    std::string stored (const plan::DrivenNode&);
    std::string sources (const Known&, const double* const* all, const std::string& fault);
    void tick (const Known&, const std::string& function, const std::vector<std::string>& arguments, bool is_inner);
    void copy (const std::string& from, const std::string& to, std::size_t size);
    void takeOutputs (const Known&, const std::string& outputs, bool is_inner);
    void keep (const double* at, const std::string& value, bool is_inner);

    void latch (const Links&);
    void silence (const Links&);
    void gather (const Links&);
    void deliver (const Links&);
    void head (const Links&);
    void follow (const Links&, const std::string& part);

    static std::string exactly (double);     ///< a number with the same bits
    std::string read (const double*);        ///< the value
    std::string pointerTo (const double*);   ///< the value's address, or that of a copy

    std::string room (const std::string& type);                         ///< a local variable: its address
    std::string bytes (std::size_t size);                               ///< the same for some bytes
    std::string object (const void*, const std::string& type = "i8");   ///< an object of the plan: its address
    std::string load (const std::string& type, const std::string& from);
    void store (const std::string& type, const std::string& value, const std::string& to);
    std::string offset (const std::string& bytes, std::size_t, const std::string& type);

    /// The result of an instruction, or of a call. Arguments have their types.
    std::string result (const std::string& instruction);
    std::string called (const std::string& type, const std::string& function, const std::vector<std::string>& arguments);
    void run (const std::string& function, const std::vector<std::string>& arguments, const std::string& how = {});
    void runNode (const Known&, const std::string& function, const std::vector<std::string>& arguments);
    void declare (const std::string& type, const std::string& function, const std::vector<std::string>& arguments);

    /// A block of instructions that can be jumped to.
    std::string label() { return "b" + std::to_string (++names); }
    void startBlock (const std::string& name) { code += name + ":\n"; }
    void jump (const std::string& to) { line ("br label %" + to); }
    void branch (const std::string& condition, const std::string& yes, const std::string& no);

    void line (std::string_view text) { code.append ("  ").append (text).append ("\n"); }

    std::string functions, rooms, code;   // whole functions; of the function that is being written
    std::map<std::string, std::string> declarations;
    std::set<std::string> constants;
    int names = 0;
};

}   // namespace tactus::host
