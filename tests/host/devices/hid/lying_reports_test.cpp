// SPDX-License-Identifier: MIT
// Reports that are well-formed but cannot be trusted: what their alarms, numbers, clock, losses and pose say.
#include "hid.hpp"

#include <support/property.hpp>

#include <host/devices/hid/report_record.hpp>

#include <cstring>
#include <string>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
/// A report of the Tactus board with these flags: 1 homed, 2 driven, 4 timed out, 8 too hot.
Bytes report (std::uint8_t flags, std::uint32_t sequence, std::uint32_t time_us)
{
    Bytes b (64);
    b[0] = 0x54;
    b[1] = 1;
    b[2] = flags;
    std::memcpy (b.data() + 4, &sequence, 4);
    std::memcpy (b.data() + 8, &time_us, 4);
    return b;
}

ReadingFault faultWith (std::uint8_t flags, double driven_s)
{
    HidModel board (test::profileOf ("tactus_board"));
    board.decode (report (flags, 1, 1000));
    const auto reading = board.reading (driven_s);
    CHECK (reading.valid == (reading.fault == ReadingFault::none));
    return reading.fault;
}
}   // namespace

TEST_CASE ("the alarm bits of a board make its reading invalid and name the reason", "[hid][safety]")
{
    constexpr double longer = 0.06, shorter = 0.04;   // than the 50 ms in the profile
    CHECK (faultWith (1 + 2, longer) == ReadingFault::none);
    CHECK (faultWith (1 + 2 + 8, 0.0) == ReadingFault::too_hot);
    CHECK (faultWith (1 + 8, longer) == ReadingFault::too_hot);   // the first alarm is the cause of the second
    CHECK (faultWith (1 + 2 + 4, longer) == ReadingFault::timed_out);
    CHECK (faultWith (1 + 4, shorter) == ReadingFault::none);   // as before the first effort
    CHECK (faultWith (1, shorter) == ReadingFault::none);
    CHECK (faultWith (1, longer) == ReadingFault::not_driven);
    CHECK (faultWith (0, 0.0) == ReadingFault::not_homed);
}

TEST_CASE ("a profile can use every alarm of a device, and none that only the host can find", "[hid][safety]")
{
    for (std::size_t i = 0; i < reading_faults.size(); ++i)
    {
        const auto fault = static_cast<ReadingFault> (i);
        if (! isAlarm (fault)) continue;
        Json json = Json::parse (R"({"format": "tactus-profile", "version": 1, "id": "a", "name": "A", "sources": ["a test"], "match": [{"vid": 1}],
            "inputs": [{"length": 1, "verified": true, "fields": [{"name": "state", "at": 0, "type": "u8"}]}],
            "alarms": [{"field": "state", "is": 7, "means": ""}]})");
        json["alarms"][0]["means"] = std::string (reading_faults[i].id);
        const auto loaded = readProfile (json);
        REQUIRE (loaded.profile);
        HidModel model (loaded.profile);
        model.decode (Bytes { 6 });
        CHECK (model.reading().fault == ReadingFault::none);
        model.decode (Bytes { 7 });
        CHECK (model.reading().fault == fault);
        CHECK_FALSE (model.reading().valid);
    }
}

TEST_CASE ("a report says whether it repeats the last one, has the same time, or goes back", "[hid][safety]")
{
    HidModel board (test::profileOf ("tactus_board"));
    const auto follows = [&] (std::uint32_t sequence, std::uint32_t time_us) { return board.decode (report (3, sequence, time_us)).report_order; };
    CHECK (follows (10, 10'000) == ReportOrder::next);
    CHECK (follows (11, 11'000) == ReportOrder::next);
    CHECK (follows (11, 11'000) == ReportOrder::repeated);
    CHECK (follows (12, 11'000) == ReportOrder::clock_stopped);
    CHECK (follows (13, 12'000) == ReportOrder::next);
    CHECK (follows (16, 15'000) == ReportOrder::next);
    CHECK (follows (15, 14'000) == ReportOrder::back);
    CHECK (follows (17, 16'000) == ReportOrder::next);
    CHECK (follows (0, 100) == ReportOrder::back);   // a restart
    CHECK (follows (1, 50) == ReportOrder::back);    // only the clock
    CHECK (follows (0, 60) == ReportOrder::back);    // only the number
    CHECK (follows (~0u, 1000) == ReportOrder::back);
    CHECK (follows (0, 2000) == ReportOrder::next);                       // the number wraps around
    CHECK (board.decode (Bytes (3)).report_order == ReportOrder::next);   // refused
    board.reset();
    CHECK (follows (0, 0) == ReportOrder::next);
    CHECK (board.counts().restarts == 0);
}

TEST_CASE ("a record is trusted while at most half of the last 32 reports are missing", "[hid][safety]")
{
    const auto oneIn = [] (std::uint64_t n) {
        ReportRecord record;
        int reports = 0;
        while (record.isTrusted() && reports < 1000)
        {
            record.arrived (n - 1);
            ++reports;
        }
        return reports;
    };
    CHECK (oneIn (1) == 1000);
    CHECK (oneIn (2) == 1000);
    CHECK (oneIn (3) <= 32 / 3 + 1);
    CHECK (oneIn (15) == 2);   // 30 ms at 1 kHz
    CHECK (oneIn (1'000'000) == 1);
    CHECK (oneIn (~std::uint64_t { 0 }) == 1);

    ReportRecord record;
    record.restart();
    for (int i = 1; i <= 40; ++i)
    {
        record.arrived (0);
        CHECK (record.isTrusted() == (i >= 16));
    }
}

TEST_CASE ("without numbers, losses are counted by the time of arrival, and bursts do not count as losses", "[hid][safety]")
{
    CHECK (ReportRecord::missingAfter (0.0, 1000.0) == 0);
    CHECK (ReportRecord::missingAfter (1.4e-3, 1000.0) == 0);
    CHECK (ReportRecord::missingAfter (15e-3, 1000.0) == 14);
    CHECK (ReportRecord::missingAfter (1e30, 1000.0) > 1000);

    test::property ("any bursts shorter than the record", [] {
        ReportRecord record;
        for (int i = 0; i < 20; ++i)
        {
            const auto burst = *rc::gen::inRange (1, 16);
            for (int k = 0; k < burst; ++k)
                record.arrived (ReportRecord::missingAfter (k == 0 ? 1e-3 * burst : 0.0, 1000.0));
            RC_ASSERT (record.isTrusted());
        }
    });
}

TEST_CASE ("a pose that no arm can have makes the reading invalid and names the reason, but a singular one does not", "[hid][safety]")
{
    auto profile = std::make_shared<Profile>();
    InputReport input { .id = {}, .length = 4, .longest = 4, .fields = {}, .timestamp = {}, .sequence = {}, .why_not = {} };
    for (std::size_t i = 0; i < 2; ++i)
    {
        InputField field;
        field.name = i == 0 ? "right" : "left";
        field.bits = { .at = 16 * i, .size = 16, .is_signed = true };
        input.fields.push_back (field);
    }
    profile->inputs.push_back (input);
    profile->position = { "right", "left", "" };
    FiveBar bar;
    bar.base = 0.05;
    bar.links = { 0.1, 0.12, 0.12, 0.1 };
    for (auto& drive : bar.drives)
        drive.counts_per_turn = 360.0;   // a count is a degree
    profile->kinematics = bar;
    HidModel arm (profile);
    const auto at = [&] (std::int16_t right, std::int16_t left) {
        Bytes bytes (4);
        std::memcpy (bytes.data(), &right, 2);
        std::memcpy (bytes.data() + 2, &left, 2);
        arm.decode (bytes);
        return arm.reading();
    };
    const auto good = at (60, 120);
    CHECK (good.valid);
    CHECK (good.fault == ReadingFault::none);
    const auto apart = at (0, 180);   // the elbows are 25 cm apart, and the passive links reach 24 cm
    CHECK_FALSE (apart.valid);
    CHECK (apart.fault == ReadingFault::impossible_pose);
    CHECK (apart.position == good.position);
    CHECK (at (60, 120).valid);
}

TEST_CASE ("an encoder that stops while the tool moves on makes the reading invalid, until it moves again", "[hid][safety]")
{
    HidModel arm (test::profileOf ("woodenhaptics_usb"));
    std::uint16_t count = 0;
    const auto at = [&] (int a, int b, int c) {
        const std::uint16_t words[] { static_cast<std::uint16_t> (a), static_cast<std::uint16_t> (b), static_cast<std::uint16_t> (c), ++count };
        Bytes bytes (8);
        std::memcpy (bytes.data(), words, 8);
        arm.decode (bytes);
        return arm.reading();
    };
    at (0, 0, 0);
    const auto last_turned = at (1, 0, 0).position;

    int k = 0;
    Reading reading = at (1, ++k, 0);
    for (; k < 10'000 && reading.valid; reading = at (1, ++k, 0))
        REQUIRE ((reading.position - last_turned).norm() <= 0.1);
    CHECK (reading.fault == ReadingFault::frozen);
    CHECK ((reading.position - last_turned).norm() == Approx (0.1).margin (1e-4));
    CHECK_FALSE (at (1, ++k, 0).valid);

    CHECK (at (2, k, 0).valid);   // the third one has never turned, so there may be no encoder
    arm.reset();
    CHECK (at (1, 0, 0).valid);
    CHECK (at (1, k, 0).valid);   // after a new start nothing is known about the first one
}

TEST_CASE ("encoders that count now and then are not taken for stopped, and neither are those of a profile without still_travel", "[hid][safety]")
{
    HidModel arm (test::profileOf ("woodenhaptics_usb"));
    auto profile = *test::profileOf ("woodenhaptics_usb");
    profile.limits.still_travel = GuardLimits::none;
    HidModel unlimited (std::make_shared<Profile> (profile));
    for (int k = 0; k < 3000; ++k)
    {
        const auto of = [&] (int a) {
            const std::uint16_t words[] { static_cast<std::uint16_t> (a), static_cast<std::uint16_t> (k), 0, static_cast<std::uint16_t> (k) };
            Bytes bytes (8);
            std::memcpy (bytes.data(), words, 8);
            return bytes;
        };
        arm.decode (of (k / 1000));   // 5 cm
        unlimited.decode (of (k > 0));
        REQUIRE (arm.reading().valid);
        REQUIRE (unlimited.reading().valid);
    }
}
