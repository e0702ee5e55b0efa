// SPDX-License-Identifier: MIT
// What every node promises. These tests cover a new node too, even if it does not have its own test. The promises are a list in
// framework/examine, which `tactus check-plugin` shares.

#include "support/tested_types.hpp"

#include <catch2/catch.hpp>
#include <support/property.hpp>
#include <tactus/examine/examination.hpp>

#include <string>

using namespace tactus;

namespace
{
/// Checks that all nodes keep one promise.
void hold (std::string_view id)
{
    const auto& promise = examine::examination (id);
    for (const auto& type : test::testedTypes())
    {
        if (! promise.skipped (type).empty()) continue;
        DYNAMIC_SECTION (type.info.id)
        {
            if (promise.random)
                test::property (std::string (promise.promise), [&] (unsigned seed) {
                    if (const auto fault = promise.fault (type, seed); ! fault.empty()) RC_FAIL (fault);
                });
            else
                CHECK (promise.fault (type, 1) == "");
        }
    }
}
}   // namespace

TEST_CASE ("every node gives finite outputs for finite inputs", "[nodes][contract]") { hold ("finite"); }

TEST_CASE ("every node outputs 0 on a non-finite input, and then continues", "[nodes][contract]") { hold ("nan"); }

TEST_CASE ("every node works again after a fault", "[nodes][contract]") { hold ("revival"); }

TEST_CASE ("a node without a memory does not remember a fault", "[nodes][contract]") { hold ("memory"); }

TEST_CASE ("every node repeats itself bit for bit", "[nodes][contract]") { hold ("bits"); }

TEST_CASE ("every node that can adopt continues exactly where the old instance stopped", "[nodes][contract]") { hold ("adopt"); }

TEST_CASE ("every node goes on from its saved state with the same bits", "[nodes][contract]") { hold ("state"); }

TEST_CASE ("every node returns from all hooks, and accepts its own defaults", "[nodes][contract]") { hold ("hooks"); }

TEST_CASE ("every node has its defaults in their ranges, and no name twice", "[nodes][contract]") { hold ("datasheet"); }

TEST_CASE ("every node stays within its outputs", "[nodes][contract]") { hold ("sizes"); }

TEST_CASE ("no instance of a node affects another", "[nodes][contract]") { hold ("instances"); }

TEST_CASE ("no instance of a node affects another in a second thread", "[nodes][contract]") { hold ("threads"); }

TEST_CASE ("no node allocates within a tick", "[nodes][contract]") { hold ("allocations"); }

TEST_CASE ("no node locks within a tick", "[nodes][contract]") { hold ("locks"); }

TEST_CASE ("no node calls the operating system within a tick", "[nodes][contract]") { hold ("system_calls"); }

TEST_CASE ("a node that claims an amplitude never exceeds it", "[nodes][contract]") { hold ("amplitude"); }

TEST_CASE ("a node that claims to be passive generates no energy on a closed path", "[nodes][contract]") { hold ("passive"); }
