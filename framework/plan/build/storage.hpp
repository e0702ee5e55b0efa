// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/steps/ops.hpp>
#include <tactus/plan/steps/running_section.hpp>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <new>
#include <vector>

namespace tactus::plan
{

/// Everything that the records of a plan point into. Nothing in it moves once the plan runs.
struct Storage
{
    static constexpr double zero = 0.0;   // for wires without a start, muted nodes and placeholders

    struct Arena
    {
        static constexpr std::align_val_t alignment { 64 };

        explicit Arena (std::size_t s) : size (s), bytes (static_cast<std::byte*> (::operator new (std::max (size, std::size_t { 1 }), alignment))) {}
        ~Arena() { ::operator delete (bytes, alignment); }
        Arena (const Arena&) = delete;
        Arena& operator= (const Arena&) = delete;

        const std::size_t size;
        std::byte* const bytes;
    };

    explicit Storage (std::size_t outputs_size) : outputs (outputs_size) {}

    Arena outputs;
    std::vector<double> feeds;      // current values, in the order of CompileOptions::feeds
    std::vector<double> defaults;   // by input component: the value if no wire or feed drives it
    std::vector<const double*> sources;
    std::deque<Sum> sums;
    std::deque<VectorSum> vector_sums;
    std::deque<Strike> strikes;
    std::deque<DelayLine> delays;
    std::deque<DrivenNode> driven;
    std::deque<Bypass> bypasses;
    std::vector<RunningSection> sections;   // by number in Flat::sections; entry 0, the graph itself, stays unused
    std::deque<std::vector<double>> samples;
};

}   // namespace tactus::plan
