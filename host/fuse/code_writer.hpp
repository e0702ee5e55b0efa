// SPDX-License-Identifier: MIT
#pragma once

#include "plan_writer.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// Writes what the records of a plan do in one tick, as C++. [main thread]
class CodeWriter final : public PlanWriter
{
public:
    CodeWriter (const Plan& plan, const FusedCode::Classes& classes) : PlanWriter (plan, classes) {}

private:
    /// An indented block with its own variables.
    class Block
    {
    public:
        Block (CodeWriter&, const std::string& head);
        ~Block();
        Block (const Block&) = delete;
        Block& operator= (const Block&) = delete;

    private:
        CodeWriter& writer;
    };

    bool has (const std::string&) const override { return true; }
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

    void drive (const std::string& wires, const plan::DrivenNode::Drive&);
    std::string stored (const Known&, const plan::DrivenNode&);
    void takeOutputs (const Known&, const std::string& result, bool is_inner);
    std::vector<std::string> inputs (const Known&, const double* const* sources, const std::string& driven);
    std::string list (const Known&, const PortSheet&, const double* const* sources, int slots, const std::string& driven);

    void latch (const Links&);
    void silence (const Links&);
    void gather (const Links&);
    void deliver (const Links&);
    void head (const Links&);
    void follow (const Links&);

    std::string read (const double*);
    std::string value (const void* at) { return "p.value (" + values.number (at) + ")"; }
    std::string size (const std::size_t* at) { return "p.as<std::size_t> (" + values.number (at) + ")"; }
    std::string ticks (const std::uint64_t* at) { return "p.ticks (" + values.number (at) + ")"; }
    std::string fresh (const char* stem) { return stem + std::to_string (++names); }
    std::string nodeName (const Known& n) const { return "n" + std::to_string (n.instance); }
    void title (const Known&);
    void line (std::string_view text) { code.append (indent, ' ').append (text).append ("\n"); }

    std::string code;
    std::size_t indent = 0, names = 0;
};

}   // namespace tactus::host
