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
        if (r.step == &plan::RunningSection::every || r.step == &plan::RunningSection::times)
            all += countOf (static_cast<plan::RunningSection*> (r.self)->records);
    return all;
}
}   // namespace

FusedCode FusedCode::of (const Plan& plan, const Classes& more)
{
    if (countOf (plan.records()) > most_records) return {};
    return CodeWriter { plan, more }.write();
}

FusedCode FusedCode::wiringOf (const Plan& plan)
{
    if (countOf (plan.records()) > most_records) return {};
    auto wiring = WiringWriter { plan }.write();
    wiring.language = Language::llvm;
    return wiring;
}

}   // namespace tactus::host
