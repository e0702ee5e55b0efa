// SPDX-License-Identifier: GPL-3.0-or-later
#include "faust_chain.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <chain.cpp>   // made by Faust
#pragma GCC diagnostic pop

namespace tactus::bench
{

FaustVariant::FaustVariant() : chain (std::make_unique<FaustChain>()) { chain->init (4000); }
FaustVariant::~FaustVariant() = default;

void FaustVariant::tick (const double* in) noexcept
{
    double sample = *in;
    double *ins[] { &sample }, *outs[] { &out };
    chain->FaustChain::compute (1, ins, outs);
}

}   // namespace tactus::bench
