// SPDX-License-Identifier: MIT
#include "code_writer.hpp"
#include "wiring_writer.hpp"

namespace tactus::host
{

namespace
{
std::size_t countOf (std::span<const Record> records)
{
    auto all = records.size();
    for (const auto& r : records)
        visitRecord (r, Cases { [] (const auto&) {}, [&all] (const SectionStep& s) { all += countOf (s.running.records); } });
    return all;
}
}   // namespace

FusedCode FusedCode::of (const Plan& plan, const Classes& more)
{
    if (countOf (plan.records()) > most_records) return {};
    return CodeWriter { plan, more }.fused();
}

FusedCode FusedCode::wiringOf (const Plan& plan)
{
    if (countOf (plan.records()) > most_records) return {};
    auto wiring = WiringWriter { plan }.fused();
    wiring.language = Language::llvm;
    return wiring;
}

}   // namespace tactus::host
