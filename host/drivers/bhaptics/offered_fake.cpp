// SPDX-License-Identifier: MIT
#include "fake_player.hpp"

#include <host/drivers/offered_fake.hpp>

#include <utility>

namespace tactus::host
{

namespace
{
class OfferedPlayer final : public OfferedFake
{
public:
    explicit OfferedPlayer (std::unique_ptr<FakePlayer> p) : player (std::move (p)) {}

    std::string where() const override
    {
        const auto at = "localhost:" + std::to_string (player->port());
        return "a fake vest is at " + at + "; play on it: --device ROLE=bhaptics:" + at;
    }

    std::string heard() const override
    {
        const auto n = player->counts();
        return std::to_string (n.clients) + " clients; " + std::to_string (n.heard) + " messages heard, " + std::to_string (n.frames)
               + " frames with intensities of at most " + std::to_string (n.largest) + ", " + std::to_string (n.turned_off) + " times turned off, "
               + std::to_string (n.refused) + " refused";
    }

    void fail (std::string_view fault) override
    {
        using Fault = FakePlayer::Fault;
        static constexpr std::pair<std::string_view, Fault> all[] {
            { "stall", Fault::silent },
            { "garbage", Fault::garbage },
            { "away", Fault::restart },
            { "rename", Fault::unworn },
        };
        player->fail (faultNamed (fault, all));
    }

private:
    std::unique_ptr<FakePlayer> player;
};
}   // namespace

extern const OfferedFakeKind bhaptics_fake { "bhaptics_vest", "the service of vests of bHaptics", "stall, garbage, away, rename", false,
                                             [] (OfferedFakeParts parts) -> Result<std::unique_ptr<OfferedFake>> {
                                                 auto player = FakePlayer::make (parts.port);
                                                 if (! player) return std::move (player).error();
                                                 return std::unique_ptr<OfferedFake> (std::make_unique<OfferedPlayer> (*std::move (player)));
                                             } };

}   // namespace tactus::host
