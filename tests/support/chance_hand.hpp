// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>

#include <bit>
#include <cstdint>
#include <random>
#include <vector>

namespace tactus::test
{

/// A hand that trembles about the origin and records the requested efforts. The same seed gives the same motion.
/// It does not yield to forces, so two runs can be compared.
class ChanceHand final : public Device
{
public:
    /// `room` is the number of efforts to record; later ones are dropped.
    explicit ChanceHand (unsigned seed, std::size_t room = 0) : random (seed) { efforts.reserve (room); }

    void prepare (double) override {}

    Reading read() noexcept override
    {
        const auto next = [this] { return static_cast<double> (random()) / 2147483648.0 - 1.0; };
        for (int c = 0; c < 3; ++c)
            speed[c] = 0.98 * speed[c] + 2e-5 * next();
        position = 0.999 * position + speed;
        Reading r;
        r.position = r.true_position = position;
        r.pressure = 100.0 * std::abs (position.z());
        return r;
    }

    void write (const Effort& e) noexcept override
    {
        if (efforts.size() < efforts.capacity()) efforts.push_back (e);
        last = e;
        for (const auto* v : { &e.force, &e.torque })
            for (const double x : *v)
                digest = (digest ^ std::bit_cast<std::uint64_t> (x)) * 0x100000001b3ull;
    }

    std::vector<Effort> efforts;
    Effort last;
    std::uint64_t digest = 0;   ///< digest of the bits of all efforts

private:
    std::mt19937 random;
    Vec3 position = Vec3::Zero(), speed = Vec3::Zero();
};

inline bool operator== (const Effort& a, const Effort& b) { return a.force == b.force && a.torque == b.torque; }

}   // namespace tactus::test
