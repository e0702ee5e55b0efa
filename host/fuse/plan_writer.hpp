// SPDX-License-Identifier: MIT
#pragma once

#include "fused_code.hpp"
#include "fused_values.hpp"

#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace tactus::host
{

/// Goes through the records of a plan and writes what they do in one tick. The language is up to the derived class. [main thread]
class PlanWriter
{
public:
    virtual ~PlanWriter() = default;
    PlanWriter (const PlanWriter&) = delete;
    PlanWriter& operator= (const PlanWriter&) = delete;

    FusedCode write();

protected:
    /// A node whose code is known.
    struct Known
    {
        std::size_t instance = 0;
        std::string type, header;
    };
    using Links = std::vector<plan::ConversionLink>;

    PlanWriter (const Plan&, const FusedCode::Classes& more);

    /// True if the code of this header can be part of the code that is written.
    virtual bool has (const std::string& header) const = 0;

    /// The code is in parts: functions that run one after another.
    virtual void begin() = 0;
    virtual void beginPart() = 0;
    virtual void endPart() = 0;
    virtual std::string end (const std::vector<const Known*>&) = 0;   ///< the whole text

    virtual void sum (const plan::Sum&, bool is_inner) = 0;
    virtual void strike (const plan::Strike&, bool is_inner) = 0;
    virtual void readDelay (const plan::Line&) = 0;
    virtual void writeDelay (const double* from, const plan::Line&) = 0;
    virtual void peek (const Known&, bool is_inner) = 0;
    virtual void node (const Known&, const Record&, bool is_inner) = 0;
    virtual void driven (const Known&, const Record&, bool is_inner) = 0;
    virtual void every (const plan::RunningSection&) = 0;
    virtual void times (const plan::RunningSection&) = 0;
    virtual void call (const Record&) = 0;   ///< lets a record run as the plan runs it

    void records (std::span<const Record>, bool is_inner);

    /// True if few nodes of the plan have the type of this one.
    bool isRare (const Known& n) const { return uses.at (n.header) <= most_copies; }

    bool isLarge() const { return values.plan.records().size() > records_in_part; }
    const auto& flatOf (const Known& n) const { return values.plan.flat().nodes[n.instance]; }

    FusedValues values;
    int parts = 0;   ///< so far

private:
    /// A compiler takes much longer for one function of thousands of nodes than for several smaller ones.
    static constexpr std::size_t records_in_part = 150;

    /// A compiler takes much longer if the code of a large node is repeated many times.
    static constexpr std::size_t most_copies = 4;

    void findKnown();
    void writeOnce();
    void startPart();
    bool fuse (const Record&, bool is_inner);
    bool fuseNode (const Record&, bool is_inner);
    void needSources (const Record&);
    const Known* knownOf (const void* node) const;

    const FusedCode::Classes more;
    std::unordered_map<const void*, Known> known;   // by address of the node
    std::map<std::string, std::size_t> uses;        // nodes by header
    std::size_t in_part = 0;
    FusedCode made;
};

}   // namespace tactus::host
