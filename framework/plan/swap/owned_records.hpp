// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/plan.hpp>
#include <tactus/plan/steps/sum_step.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace tactus::plan
{

/// Records in running order, and for each record the number of the node that it belongs to.
struct OwnedRecords
{
    std::vector<Record> records;
    std::vector<std::uint32_t> owners;

    void add (const Record& r, int node)
    {
        records.push_back (r);
        owners.push_back (static_cast<std::uint32_t> (node));
    }

    /// Adds the record of a sum. If it and the last two are sums with the same number of terms for the same node, such as those of a
    /// vector, they become one record.
    void addSum (Sum& sum, int node, std::deque<VectorSum>& vectors)
    {
        add ({ stepOf (sum), &sum, nullptr, nullptr }, node);
        const auto step = stepOfVector (records.back().step);
        if (step == nullptr || records.size() < 3) return;
        const auto last = std::span (records).last (3);
        for (std::size_t i = 0; i < last.size(); ++i)
            if (last[i].step != last.back().step || owners[owners.size() - 1 - i] != owners.back()) return;
        const auto part = [&last] (std::size_t i) { return static_cast<Sum*> (last[i].self); };
        auto& vector = vectors.emplace_back (VectorSum { { part (0), part (1), part (2) } });
        records.resize (records.size() - 3);
        owners.resize (owners.size() - 3);
        add ({ step, &vector, nullptr, nullptr }, node);
    }

    void append (const OwnedRecords& more)
    {
        records.insert (records.end(), more.records.begin(), more.records.end());
        owners.insert (owners.end(), more.owners.begin(), more.owners.end());
    }
};

}   // namespace tactus::plan
