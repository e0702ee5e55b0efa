// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/run/clock/tick_account.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <thread>
#include <vector>

using namespace tactus;

TEST_CASE ("a quantile is accurate to within one bin and never exceeds the longest duration", "[runtime]")
{
    test::property ("any durations", [] (std::vector<std::uint32_t> microseconds, std::uint32_t permille) {
        RC_PRE (! microseconds.empty());
        Durations durations;
        for (auto& us : microseconds)
            durations.note (1e-6 * (us %= 10'000'000));
        std::ranges::sort (microseconds);
        const double part = permille % 1001 / 1000.0;
        const auto n = static_cast<double> (microseconds.size());
        const auto at = static_cast<std::size_t> (std::max (0.0, std::ceil (part * n) - 1.0));
        const double exact = std::max (1e-7, 1e-6 * microseconds[at]), longest = 1e-6 * microseconds.back();
        const double quantile = durations.quantile (part);
        RC_ASSERT (durations.longest() == longest);
        RC_ASSERT (quantile <= longest);
        RC_ASSERT (quantile >= std::min (longest, exact * (1.0 - 1e-9)));
        RC_ASSERT (quantile <= exact * 1.0906);
    });
    CHECK (Durations {}.quantile (0.5) == 0.0);
}

TEST_CASE ("a tick that begins one period late is a miss, and a graph is overrun when every tick takes too long for half a second", "[runtime]")
{
    TickAccount account { 1e-3 };
    for (int k = 0; k < 1000; ++k)
        account.note (k % 10 == 0 ? 2e-3 : 1e-5, k % 100 == 99 ? 0.5e-3 : 4e-3);   // occasionally, a tick is short enough
    CHECK (account.ticks() == 1000);
    CHECK (account.misses() == 100);
    CHECK_FALSE (account.isOverrun());
    for (int k = 0; k < 400; ++k)
        account.note (0.0, 1.5e-3);
    CHECK (account.isOverrun());
    account.note (0.0, 0.5e-3);
    CHECK_FALSE (account.isOverrun());
}

TEST_CASE ("reading an account while it is being written is not a race", "[runtime]")
{
    TickAccount account { 1e-3 };
    std::atomic<bool> done { false };
    std::thread keeper ([&] {
        for (int k = 0; k < 20000; ++k)
            account.note (1e-6 * k, 1e-6);
        done = true;
    });
    std::uint64_t last = 0;
    bool forward = true;
    while (! done)
    {
        forward = forward && account.ticks() >= last && account.lateness().quantile (0.99) <= 0.02;
        last = account.ticks();
    }
    keeper.join();
    CHECK (forward);
    CHECK (account.ticks() == 20000);
}
