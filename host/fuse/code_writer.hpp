// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fused_code.hpp"
#include "fused_values.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tactus::host
{

/// Writes what the records of a plan do in one tick. [main thread]
class CodeWriter
{
public:
    CodeWriter (const Plan&, const FusedCode::Classes& more);

    FusedCode write();

private:
    /// A node whose code is known.
    struct Known
    {
        std::size_t instance = 0;
        std::string type, header;
    };

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

    void writeOnce();
    void beginPart();
    void records (std::span<const Record>, bool is_inner);
    bool fuse (const Record&, bool is_inner);
    void call (const Record&);
    void sum (const plan::Sum&, bool is_inner);
    void strike (const plan::Strike&, bool is_inner);
    void delay (const Record&);
    void node (const Known&, const Record&, bool is_inner);
    void driven (const Known&, const Record&, bool is_inner);
    void takeOutputs (const Known&, const std::string& result, bool is_inner);
    std::vector<std::string> inputs (const Known&, const double* const* sources, const std::string& driven);
    std::string list (const Known&, const PortSheet&, const double* const* sources, int slots, const std::string& driven);

    void every (const plan::RunningSection&);
    void times (const plan::RunningSection&);
    void latch (const std::vector<plan::ConversionLink>&);
    void silence (const std::vector<plan::ConversionLink>&);
    void gather (const std::vector<plan::ConversionLink>&);
    void deliver (const std::vector<plan::ConversionLink>&);
    void head (const std::vector<plan::ConversionLink>&);
    void follow (const std::vector<plan::ConversionLink>&);

    const Known* knownOf (const void* node) const;
    std::string value (const void* at) { return "p.value (" + values.number (at) + ")"; }
    std::string ticks (const std::uint64_t* at) { return "p.ticks (" + values.number (at) + ")"; }
    std::string fresh (const char* stem) { return stem + std::to_string (++names); }
    std::string nodeName (const Known& n) const { return "n" + std::to_string (n.instance); }
    std::string reference (const Known&);
    void line (std::string_view text) { code.append (indent, ' ').append (text).append ("\n"); }

    FusedValues values;
    std::unordered_map<const void*, Known> known;   // by address of the node
    std::string code;
    std::size_t indent = 0, names = 0, in_part = 0, parts = 0;
    FusedCode made;
};

}   // namespace tactus::host
