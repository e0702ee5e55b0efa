// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

namespace tactus::bench
{

/// One of several ways to compute the same thing.
class Variant
{
public:
    virtual ~Variant() = default;

    virtual void tick (const double* in) noexcept = 0;

    /// The outputs of the last tick.
    virtual std::vector<double> outputs() const = 0;
};

// Variants that have a file of their own.
std::unique_ptr<Variant> handwritten();            ///< the reference graph by hand
std::unique_ptr<Variant> handwrittenWithGuard();   ///< followed by the guard of the preset's device, which exported code contains
std::unique_ptr<Variant> exportedReference();      ///< what `tactus export` writes for graphs/padded_bench.json, with its guard
std::unique_ptr<Variant> exportedChain();          ///< and for a chain of a hundred one-poles

}   // namespace tactus::bench
