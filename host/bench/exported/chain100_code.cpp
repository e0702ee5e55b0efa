// SPDX-License-Identifier: GPL-3.0-or-later
#include "exported_code.hpp"

#include <chain100.hpp>   // written by `tactus export` during the build

namespace exported_code
{

struct Chain::Parts
{
    Chain100 graph {};
    Chain100::Outputs out {};
};

Chain::Chain() : parts (std::make_unique<Parts>()) { parts->graph.prepare(); }
Chain::~Chain() = default;

void Chain::tick (double in) noexcept { parts->graph.tick ({ .p0_in = in }, parts->out); }
double Chain::out() const noexcept { return parts->out.p99_out; }

}   // namespace exported_code
