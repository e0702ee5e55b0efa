// SPDX-License-Identifier: MIT
#include "fake_falcon.hpp"

#include <host/drivers/offered_fake.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <chrono>
#include <utility>

namespace tactus::host
{

namespace
{
using Clock = std::chrono::steady_clock;

/// A Falcon whose grip a simulated hand holds.
class OfferedFalcon final : public OfferedFake
{
public:
    explicit OfferedFalcon (std::unique_ptr<Device> h) : hand (std::move (h)) { hand->prepare (1e-3); }

    std::string where() const override
    {
        return "a fake Falcon is at " + falcon.port() + "; play on it: --device ROLE=falcon:" + falcon.port();
    }

    std::string heard() const override
    {
        return std::to_string (falcon.packets) + " packets heard, " + std::to_string (falcon.pushes) + " with a force of at most "
               + numberText (falcon.largest_force) + " N, " + std::to_string (falcon.malformed) + " bytes outside packets";
    }

    void fail (std::string_view fault) override
    {
        using Fault = FakeFalcon::Fault;
        static constexpr std::pair<std::string_view, Fault> all[] {
            { "stall", Fault::silent },
            { "garbage", Fault::noisy },
            { "half", Fault::shorter },
            { "lost_byte", Fault::shifted },
            { "late", Fault::late },
            { "lie", Fault::changed },
            { "reset", Fault::forgetful },
        };
        falcon.fail (faultNamed (fault, all));
    }

private:
    FakeFalcon::Place move (const FakeFalcon::Place& grip, const FakeFalcon::Place& force)
    {
        constexpr auto tick = std::chrono::milliseconds (1), longest = std::chrono::milliseconds (100);
        constexpr double middle = 0.150;   // in front of the base, in m
        auto place = grip;
        const auto now = Clock::now();
        for (moved_to = std::max (moved_to, now - longest); moved_to + tick <= now; moved_to += tick)
        {
            const auto at = hand->read().position;
            place = { at.x(), at.z(), middle - at.y() };   // its own axes: x right, y up, z towards the person
            Effort effort;
            effort.force = { force[0], -force[2], force[1] };
            hand->write (effort);
        }
        return place;
    }

    std::unique_ptr<Device> hand;
    Clock::time_point moved_to = Clock::now();

    // Declared last: its thread uses the other members.
    FakeFalcon falcon { [this] (const FakeFalcon::Place& grip, const FakeFalcon::Place& force) { return move (grip, force); } };
};
}   // namespace

extern const OfferedFakeKind falcon_fake { "falcon", "the Novint Falcon", "stall, garbage, half, lost_byte, late, lie, reset", true,
                                           [] (OfferedFakeParts parts) -> Result<std::unique_ptr<OfferedFake>> {
                                               return std::unique_ptr<OfferedFake> (std::make_unique<OfferedFalcon> (std::move (parts.hand)));
                                           } };

}   // namespace tactus::host
