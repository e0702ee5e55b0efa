// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <memory>

class FaustChain;

namespace tactus::bench
{

/// The chain of a hundred one-poles, in C++ that Faust generated from chain.dsp.
class FaustVariant : public Variant
{
public:
    FaustVariant();
    ~FaustVariant() override;

    void tick (const double* in) noexcept override;
    std::vector<double> outputs() const override { return { out }; }

private:
    std::unique_ptr<FaustChain> chain;
    double out = 0.0;
};

}   // namespace tactus::bench
