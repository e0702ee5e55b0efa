// SPDX-License-Identifier: MIT
// What a vest shows, and what its messages say: without a Player.

#include "support/corpus.hpp"
#include "support/property.hpp"
#include "support/sketch.hpp"

#include <fuzz/vest_target.hpp>
#include <host/drivers/bhaptics/dots.hpp>
#include <host/drivers/bhaptics/vest_messages.hpp>
#include <vest_map.hpp>

#include <tactus/text/json_text.hpp>

#include <catch2/catch.hpp>

#include <limits>
#include <string>
#include <vector>

using namespace tactus;
using host::Dots;

namespace
{
Dots dotsOf (const Json& description = Json::object())
{
    auto dots = Dots::read (readJson (vest_map).root, description);
    INFO ((dots ? std::string() : dots.error().text));
    REQUIRE (dots);
    return std::move (*dots);
}
}   // namespace

TEST_CASE ("signals drive the motors of their channel, places those around them, and a force those that it presses", "[bhaptics][wires]")
{
    auto dots = dotsOf();
    CHECK (dots.channels() == 8);
    CHECK (dots.message().empty());
    dots.take (std::vector<double> { 0.25 }, Vec3::Zero());
    dots.take (std::vector<double> { -0.5 }, Vec3::Zero());   // the largest since the last message counts
    CHECK (dots.message()
           == R"({"Submit":[{"Type":"frame","Key":"tactus_VestFront","Frame":{"position":"VestFront","dotPoints":[{"index":0,"intensity":50},)"
              R"({"index":1,"intensity":50},{"index":4,"intensity":50},{"index":5,"intensity":50}],"pathPoints":[],"durationMillis":100}}]})");
    CHECK (dots.isShowing());
    CHECK (dots.message() == R"({"Submit":[{"Type":"turnOff","Key":"tactus_VestFront"}]})");
    CHECK (dots.message().empty());

    // 5 N towards the person, so from the front, at the full force of 10 N.
    dots.take ({}, Vec3 (3.0, -5.0, 2.0));
    const auto pressed = dots.message();
    CHECK (pressed.find ("VestBack") == pressed.npos);
    CHECK (pressed.find (R"({"index":19,"intensity":50})") != pressed.npos);
    CHECK (dots.silence() == R"({"Submit":[{"Type":"turnOff","Key":"tactus_VestFront"},{"Type":"turnOff","Key":"tactus_VestBack"}]})");
    CHECK (dots.message().empty());

    auto around = dotsOf ({ { "channels", Json::array ({ { { "at", Json::array ({ 0.12, 0.11, 0.2 }) }, { "radius", 0.1 } } }) }, { "full_force", 1 } });
    around.take (std::vector<double> { 1.0 }, Vec3::Zero());
    const auto text = around.message();
    CHECK (text.find (R"({"index":3,"intensity":100})") != text.npos);
    CHECK (text.find (R"({"index":2,"intensity":25})") != text.npos);
    CHECK (text.find (R"({"index":7,"intensity":30})") != text.npos);
    CHECK (text.find (R"("index":0)") == text.npos);
}

TEST_CASE ("whatever the values, a message has intensities from 0 to 100 and is JSON", "[bhaptics][wires][property]")
{
    test::property ("any signals and any force", [] {
        auto dots = dotsOf();
        for (int k = 0; k < 3; ++k)
        {
            std::vector<double> signals (*rc::gen::inRange<std::size_t> (0, 40));
            for (auto& s : signals)
                s = *rc::gen::arbitrary<double>();
            dots.take (signals, Vec3 (*rc::gen::arbitrary<double>(), *rc::gen::arbitrary<double>(), *rc::gen::arbitrary<double>()));
            const auto text = dots.message();
            if (text.empty()) continue;
            const auto read = readJson (text);
            RC_ASSERT (read.messages.empty());
            for (std::size_t i = 0; i < read.root["Submit"].size(); ++i)
            {
                const auto& one = read.root["Submit"][i];
                if (one["Type"] == Json ("turnOff")) continue;
                for (const auto& point : one["Frame"]["dotPoints"])
                    RC_ASSERT (point["intensity"].get<double>() >= 1.0 && point["intensity"].get<double>() <= 100.0);
            }
        }
    });
}

TEST_CASE ("no motor of a vest exceeds the limit, whatever adds up in it, and what is forgotten is not shown", "[bhaptics][wires][safety]")
{
    const auto front = Json { { "dots", { { "VestFront", Json::array ({ 0 }) } } } };
    const auto shown = [&] (double most, double signal, double newtons) {
        auto dots = dotsOf ({ { "channels", Json::array ({ front, front }) } });
        dots.limit (most);
        dots.take (std::vector<double> { signal, signal }, Vec3 (0.0, -newtons, 0.0));
        const auto read = readJson (dots.message());
        return read.root["Submit"][0]["Frame"]["dotPoints"][0]["intensity"].get<double>();
    };
    CHECK (shown (1.0, 0.2, 0.0) == 40.0);
    CHECK (shown (0.29, 0.2, 0.0) == 29.0);
    CHECK (shown (0.119, 0.0, 10.0) == 11.0);
    CHECK (shown (7.0, 1.0, 10.0) == 100.0);
    CHECK (shown (std::numeric_limits<double>::infinity(), 1.0, 10.0) == 100.0);
    auto dots = dotsOf();
    dots.limit (0.0);
    dots.take (std::vector<double> { 1.0 }, Vec3 (0.0, -10.0, 0.0));
    CHECK (dots.message().empty());
    dots.limit (1.0);
    dots.take (std::vector<double> { 1.0 }, Vec3 (0.0, -10.0, 0.0));
    dots.forget();
    CHECK (dots.message().empty());
}

TEST_CASE ("what is wrong with the channels of a vest is said", "[bhaptics][wires]")
{
    const auto problem = [] (const char* channels) {
        const auto read = Dots::read (readJson (vest_map).root, { { "channels", readJson (channels).root } });
        return read ? std::string() : read.error().text;
    };
    CHECK (problem (R"([{"dots": {"VestFront": [19], "VestBack": [0]}}])").empty());
    CHECK (problem ("[]").find ("1 to 32") != std::string::npos);
    CHECK (problem ("7").find ("1 to 32") != std::string::npos);
    CHECK (problem (R"([{"dots": {"Head": [0]}}])").find ("channel 1 names a place") != std::string::npos);
    CHECK (problem (R"([{"dots": {"VestFront": [0]}}, {"dots": {"VestFront": [20]}}])").find ("channel 2 names a motor") != std::string::npos);
    CHECK (problem (R"([{"at": [0, 0], "radius": 1}])").find ("radius") != std::string::npos);
    CHECK (problem (R"([{"at": [0, 0, 9], "radius": 0.1}])").find ("no motor") != std::string::npos);
    CHECK (problem (R"([{"loud": true}])").find ("neither") != std::string::npos);
    CHECK_FALSE (Dots::read (readJson (vest_map).root, { { "full_force", -1 } }));
    CHECK (host::VestSettings::read ({ { "rate", 0 } }).error().text.find ("messages per second") != std::string::npos);
}

TEST_CASE ("what the Player says about its devices tells whether there is a vest", "[bhaptics][wires]")
{
    CHECK (host::hasVest (R"({"ConnectedPositions":["VestFront","VestBack"]})") == true);
    CHECK (host::hasVest (R"({"ConnectedPositions":["Head"]})") == false);
    CHECK (host::hasVest (R"({"ConnectedPositions":[7]})") == false);
    CHECK (host::hasVest (R"({"ConnectedDeviceCount":1})") == true);   // it does not say
    CHECK (host::hasVest ("[]") == true);
    CHECK_FALSE (host::hasVest (R"({"ConnectedPositions":)"));
}

TEST_CASE ("every text of the vest corpus is read or refused", "[bhaptics][wires]") { CHECK (test::replay ("vest", fuzz::tryVest) > 10); }
