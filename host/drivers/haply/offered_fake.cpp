// SPDX-License-Identifier: MIT
#include "fake_inverse3.hpp"

#include <host/drivers/offered_fake.hpp>
#include <tactus/text/number_text.hpp>

#include <utility>

namespace tactus::host
{

namespace
{
class OfferedInverse3 final : public OfferedFake
{
public:
    explicit OfferedInverse3 (std::unique_ptr<FakeInverse3> s) : service (std::move (s)) {}

    std::string where() const override
    {
        const auto at = "localhost:" + std::to_string (service->port());
        return "a fake Inverse3 is at " + at + "; play on it: --device ROLE=haply:" + at;
    }

    std::string heard() const override
    {
        const auto n = service->counts();
        return std::to_string (n.clients) + " clients; " + std::to_string (n.heard) + " messages heard, " + std::to_string (n.forces)
               + " with a force of at most " + numberText (n.largest) + " N, " + std::to_string (n.answered) + " answered, "
               + std::to_string (n.together) + " sent before the answer, "
               + std::to_string (n.refused) + " refused";
    }

    void fail (std::string_view fault) override
    {
        using Fault = FakeInverse3::Fault;
        static constexpr std::pair<std::string_view, Fault> all[] {
            { "stall", Fault::silent },
            { "garbage", Fault::garbage },
            { "away", Fault::restart },
            { "push", Fault::push },
            { "rename", Fault::rename },
        };
        service->fail (faultNamed (fault, all));
    }

private:
    std::unique_ptr<FakeInverse3> service;
};
}   // namespace

extern const OfferedFakeKind haply_fake { "haply_inverse3", "the service of Haply's Inverse3", "stall, garbage, away, push, rename", true,
                                          [] (OfferedFakeParts parts) -> Result<std::unique_ptr<OfferedFake>> {
                                              auto service = FakeInverse3::make (parts.port, std::move (parts.hand));
                                              if (! service) return std::move (service).error();
                                              return std::unique_ptr<OfferedFake> (std::make_unique<OfferedInverse3> (*std::move (service)));
                                          } };

}   // namespace tactus::host
