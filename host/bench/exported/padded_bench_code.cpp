// SPDX-License-Identifier: GPL-3.0-or-later
#include "exported_code.hpp"

#include <padded_bench.hpp>   // written by `tactus export` during the build

namespace exported_code
{

struct Reference::Parts
{
    PaddedBench graph {};
    PaddedBench::Inputs in {};
    PaddedBench::Outputs out {};
};

Reference::Reference() : parts (std::make_unique<Parts>()) { parts->graph.prepare(); }
Reference::~Reference() = default;

void Reference::tick (const double* position) noexcept
{
    parts->in.stylus.position = { position[0], position[1], position[2] };
    parts->graph.tick (parts->in, parts->out);
}

void Reference::forceOf (double* force) const noexcept
{
    for (int i = 0; i < 3; ++i)
        force[i] = parts->out.stylus.force[i];
}

}   // namespace exported_code
