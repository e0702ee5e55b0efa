// SPDX-License-Identifier: MIT
// Passes bodies between a library that uses Tactus and one that does not.
#include "body.hpp"

#include <cstdio>

int main()
{
    const auto ours = with::layout(), theirs = without::layout();
    if (ours.empty() || ours != theirs)
    {
        for (std::size_t i = 0; i < theirs.size(); ++i)
            std::printf ("%zu: with Tactus %zu, without %zu\n", i, i < ours.size() ? ours[i] : 0, theirs[i]);
        return 1;
    }
    const auto from_ours = with::made(), from_theirs = without::made();   // destroyed here, by code of the program
    const double expected = 2.5 + 10.0 + 1.0 + (4.0 + 18.0) + 6.25 + 0.125;
    const double sums[] { with::sum (from_ours), with::sum (from_theirs), without::sum (from_ours), without::sum (from_theirs) };
    for (const double sum : sums)
        if (sum != expected)
        {
            std::printf ("a sum is %g instead of %g\n", sum, expected);
            return 1;
        }
    std::printf ("%zu layouts are the same, and 4 bodies arrive; Vector4d is aligned to %zu bytes\n", ours.size(), alignof (Eigen::Vector4d));
}
