// SPDX-License-Identifier: MIT
#include "ring_sums.hpp"

#include <tactus/kit/math/math.hpp>

#include <cmath>
#include <cstdint>

namespace tactus::detail
{

namespace
{
/// The same sums if each row is later by `by`, in units of all rows, without the factor e^(rate by).
void shift (Sums& s, double by, std::size_t most)
{
    for (std::size_t k = 1; k <= most; ++k)
        for (std::size_t c = most; c >= k; --c)
            s[c] += by * s[c - 1];
}
}   // namespace

Complex powerOf (Complex rate, double n)
{
    const auto [sine, cosine] = math::sinCos (std::fmod (rate.imag() * n, full_turn));
    return math::exp (rate.real() * n) * Complex { cosine, sine };
}

Sums sumsOf (Complex rate, Index begin, Index end, Index rows, std::size_t most)
{
    const double unit = 1.0 / static_cast<double> (rows);
    const Complex factor = powerOf (rate, 1.0);
    Sums sums {};
    Complex power = 1.0;
    Index done = 0;
    const auto count = static_cast<std::uint64_t> (end - begin);
    for (int bit = 63; bit-- > 0;)
    {
        if (done > 0)
        {
            auto later = sums;
            shift (later, unit * static_cast<double> (done), most);
            for (std::size_t c = 0; c <= most; ++c)
                sums[c] += times (power, later[c]);
            power = times (power, power);
            done *= 2;
        }
        if ((count >> bit & 1) == 0) continue;
        double u = 1.0;
        for (std::size_t c = 0; c <= most; ++c, u *= unit * static_cast<double> (done))
            sums[c] += u * power;
        power = times (power, factor);
        ++done;
    }
    if (begin == 0) return sums;
    shift (sums, unit * static_cast<double> (begin), most);
    const Complex first = powerOf (rate, static_cast<double> (begin));
    for (std::size_t c = 0; c <= most; ++c)
        sums[c] = times (first, sums[c]);
    return sums;
}

std::pair<Complex, Complex> correlate (const Eigen::VectorXd& signal, Complex rate, Index begin, Index end)
{
    const auto powers = powersOf (rate);
    Complex plain, by_row;
    visitBlocks (rate, begin, end, [&] (Index first, Index count, Complex z) {
        double re = 0.0, im = 0.0, re_by_row = 0.0, im_by_row = 0.0;
        for (Index i = 0; i < count; ++i)
        {
            const auto& p = powers[at (i)];
            const double v = signal[first + i], by = static_cast<double> (i) * v;
            re += v * p.real();
            im += v * p.imag();
            re_by_row += by * p.real();
            im_by_row += by * p.imag();
        }
        const Complex here { re, im };
        plain += times (z, here);
        by_row += times (z, static_cast<double> (first) * here + Complex { re_by_row, im_by_row });
    });
    return { plain, by_row / static_cast<double> (signal.size()) };
}

}   // namespace tactus::detail
