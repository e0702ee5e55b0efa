// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/edit.hpp>

#include <cstdint>
#include <random>

namespace tactus::test
{

/// Generates edits that a person or a program might try. A third of them are invalid. The same seed gives the same edits.
class Meddler
{
public:
    explicit Meddler (std::uint64_t seed) : engine (seed) {}

    graph::Command any (const graph::Graph&);

private:
    std::mt19937_64 engine;
};

}   // namespace tactus::test
