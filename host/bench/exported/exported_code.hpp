// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

/// The classes that `tactus export` writes, behind functions. They bring their own node headers, adapted to run without a heap, and
/// these would clash with the project's. So the exported code is compiled with another name for the namespace `tactus`, and this header
/// does not mention that namespace.
namespace exported_code
{

/// graphs/padded_bench.json, with the guard of its device.
class Reference
{
public:
    Reference();
    ~Reference();

    void tick (const double* position) noexcept;
    void forceOf (double* force) const noexcept;   ///< three components, after the guard

private:
    struct Parts;
    std::unique_ptr<Parts> parts;
};

/// The chain of a hundred one-poles.
class Chain
{
public:
    Chain();
    ~Chain();

    void tick (double in) noexcept;
    double out() const noexcept;

private:
    struct Parts;
    std::unique_ptr<Parts> parts;
};

}   // namespace exported_code
