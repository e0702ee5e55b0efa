// SPDX-License-Identifier: MIT
#include "hid.hpp"
#include "support/no_allocation.hpp"

#include <support/property.hpp>

#include <fuzz/report_target.hpp>
#include <host/devices/hid/bits.hpp>
#include <host/devices/hid/report/crc32.hpp>

#include <cmath>
#include <cstring>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
/// A device whose only report has these fields.
std::shared_ptr<Profile> deviceWith (std::vector<InputField> fields, std::size_t length)
{
    auto profile = std::make_shared<Profile>();
    profile->inputs.push_back ({ .id = {}, .length = length, .longest = length, .fields = std::move (fields), .timestamp = {}, .sequence = {}, .why_not = {} });
    return profile;
}

InputField fieldOf (std::string name, Bits bits)
{
    InputField field;
    field.name = std::move (name);
    field.bits = bits;
    return field;
}

std::shared_ptr<Profile> deviceThatTakes (OutputField field, std::size_t length)
{
    auto profile = std::make_shared<Profile>();
    OutputReport report;
    report.name = "out";
    report.body = report.neutral = Bytes (length, 0x55);
    report.fields = { std::move (field) };
    profile->outputs.push_back (std::move (report));
    return profile;
}

rc::Gen<Bits> anyBits()
{
    return rc::gen::apply ([] (std::size_t at, std::size_t size, bool is_signed) { return Bits { .at = at, .size = size, .is_signed = is_signed }; },
                           rc::gen::inRange<std::size_t> (0, 64), rc::gen::inRange<std::size_t> (1, 33), rc::gen::arbitrary<bool>());
}
}   // namespace

TEST_CASE ("bits read back as written, and their neighbours do not change")
{
    test::property ("any bits of any report", [] {
        const auto b = *anyBits();
        const auto before = *rc::gen::container<Bytes> (12, rc::gen::arbitrary<std::uint8_t>());
        const auto raw = *rc::gen::arbitrary<std::uint32_t>();
        auto report = before;
        putBits (b, raw, report);
        const auto mask = b.size == 32 ? ~0u : (1u << b.size) - 1u;
        RC_ASSERT (bitsAt (b, report) == (raw & mask));
        RC_ASSERT ((rawOf (b, numberOf (b, bitsAt (b, report))) & mask) == (raw & mask));
        putBits (b, bitsAt (b, before), report);
        RC_ASSERT (report == before);
    });

    const Bytes report { 0x12, 0x34, 0x80, 0xff };
    CHECK (numberOf ({ .size = 16 }, bitsAt ({ .size = 16 }, report)) == 0x3412);
    CHECK (numberOf ({ .size = 16, .big_endian = true }, bitsAt ({ .size = 16, .big_endian = true }, report)) == 0x1234);
    CHECK (numberOf ({ .at = 16, .size = 16, .is_signed = true }, bitsAt ({ .at = 16, .size = 16 }, report)) == -128);
    CHECK (numberOf ({ .at = 16, .size = 16, .is_signed = true, .big_endian = true }, bitsAt ({ .at = 16, .size = 16, .big_endian = true }, report)) == -32513);
    CHECK (numberOf ({ .at = 4, .size = 12 }, bitsAt ({ .at = 4, .size = 12 }, report)) == 0x341);
}

TEST_CASE ("a counter of any size is unwrapped if each step is less than half its range")
{
    test::property ("any walk", [] {
        const auto size = *rc::gen::inRange<std::size_t> (2, 33);
        auto bits = Bits { .size = size, .is_signed = *rc::gen::arbitrary<bool>() };
        auto field = fieldOf ("count", bits);
        field.unwrap = true;
        HidModel model (deviceWith ({ field }, 4));

        const auto half = std::int64_t { 1 } << (size - 1);
        std::int64_t place = *rc::gen::inRange<std::int64_t> (0, half);
        for (int i = 0; i < 50; ++i)
        {
            if (i > 0) place += *rc::gen::inRange<std::int64_t> (-half + 1, half);
            Bytes report (4);
            putBits (bits, static_cast<std::uint32_t> (place), report);
            RC_ASSERT (model.decode (report).axes[0] == static_cast<double> (place));
        }
    });
}

TEST_CASE ("lost reports are counted, but repeated reports and restarts are not")
{
    auto profile = deviceWith ({ fieldOf ("n", { .size = 8 }) }, 1);
    profile->inputs[0].sequence = "n";
    HidModel model (profile);
    const auto lost = [&] (std::uint8_t n) { return model.decode (Bytes { n }).lost; };
    CHECK (lost (250) == 0);
    CHECK (lost (251) == 0);
    CHECK (lost (251) == 0);
    CHECK (lost (254) == 2);
    CHECK (lost (1) == 2);   // 255 and 0 are missing
    CHECK (lost (0) == 0);   // backwards: a restart
    CHECK (lost (200) == 0);
    CHECK (model.counts().lost == 4);
    CHECK (model.counts().restarts == 2);

    test::property ("any losses", [&] {
        HidModel any (profile);
        std::uint8_t n = *rc::gen::arbitrary<std::uint8_t>();
        any.decode (Bytes { n });
        for (int i = 0; i < 30; ++i)
        {
            const auto gone = *rc::gen::inRange<std::uint8_t> (0, 127);
            n = static_cast<std::uint8_t> (n + gone + 1);
            RC_ASSERT (any.decode (Bytes { n }).lost == gone);
        }
    });
}

TEST_CASE ("a device's clock is converted to seconds since its first report")
{
    auto time = fieldOf ("time", { .size = 16 });
    time.scale = 1e-6;
    time.unwrap = true;
    auto profile = deviceWith ({ time }, 2);
    profile->inputs[0].timestamp = "time";
    HidModel model (profile);
    double expected = 0.0;
    std::uint32_t ticks = 65'000;
    for (int i = 0; i < 1000; ++i)
    {
        CHECK (model.decode (Bytes { static_cast<std::uint8_t> (ticks), static_cast<std::uint8_t> (ticks >> 8) }).time == Approx (expected).margin (1e-12));
        ticks += 1000;
        expected += 1e-3;
    }
    CHECK (model.hasTime());
    model.reset();
    CHECK (model.decode (Bytes { 9, 9 }).time == 0.0);
}

TEST_CASE ("a report that is too short, too long, unknown, unmarked or not finite changes nothing and is counted by reason")
{
    HidModel board (test::profileOf ("tactus_board"));
    const auto good = test::profileOf ("tactus_board")->samples[0].input[0];
    REQUIRE (board.decode (good).refusal == Refusal::none);
    const auto place = board.sample().position;

    const auto refused = [&] (HidModel& model, const Bytes& report, Refusal why) {
        const auto before = model.counts().refused[static_cast<std::size_t> (why)];
        CHECK (model.decode (report).refusal == why);
        CHECK (model.counts().refused[static_cast<std::size_t> (why)] == before + 1);
    };
    auto bad = good;
    bad.pop_back();
    refused (board, bad, Refusal::too_short);
    refused (board, {}, Refusal::too_short);
    bad = good;
    bad.push_back (0);
    refused (board, bad, Refusal::too_long);
    bad = good;
    bad[0] ^= 1;
    refused (board, bad, Refusal::wrong_mark);
    bad = good;
    bad[1] = 2;   // a different version
    refused (board, bad, Refusal::wrong_mark);
    CHECK (board.sample().position == place);
    CHECK (board.sample().valid);

    HidModel mouse (test::profileOf ("spacemouse"));
    refused (mouse, test::bytes ("07 00 00"), Refusal::unknown_id);
    refused (mouse, {}, Refusal::too_short);

    HidModel floating (deviceWith ({ fieldOf ("x", { .size = 32, .is_signed = true, .is_float = true }), fieldOf ("y", { .at = 32 }) }, 5));
    const auto with = [] (float x, std::uint8_t y) {
        Bytes report (5, y);
        std::memcpy (report.data(), &x, sizeof x);
        return report;
    };
    CHECK (floating.decode (with (1.5f, 3)).axes[0] == 1.5);
    refused (floating, with (NAN, 4), Refusal::not_finite);
    refused (floating, with (-INFINITY, 4), Refusal::not_finite);
    CHECK (floating.sample().axes[0] == 1.5);
    CHECK (floating.sample().axes[1] == 3.0);
    CHECK (floating.counts().taken == 1);
}

TEST_CASE ("the reading of a board that is not homed is not valid")
{
    HidModel board (test::profileOf ("tactus_board"));
    auto report = test::profileOf ("tactus_board")->samples[0].input[0];
    CHECK_FALSE (board.sample().valid);   // no report yet
    CHECK (board.decode (report).valid);
    CHECK (board.reading().valid);
    report[2] = 0;
    CHECK_FALSE (board.decode (report).valid);
    CHECK_FALSE (board.reading().valid);
}

TEST_CASE ("a report with only buttons does not change the time")
{
    HidModel mouse (test::profileOf ("spacemouse"));
    CHECK_FALSE (mouse.hasTime());
    mouse.decode (test::bytes ("01 05 00*5"));
    mouse.decode (test::bytes ("03 01 00"));
    CHECK (mouse.sample().time == 0.0);
    CHECK (mouse.sample().lost == 0);
}

TEST_CASE ("a hat presses one button or two")
{
    InputField hat;
    hat.bits = { .size = 4 };
    hat.buttons = { "up", "right", "down", "left" };
    hat.is_hat = true;
    HidModel model (deviceWith ({ hat }, 1));
    const std::uint32_t expected[] = { 1, 3, 2, 6, 4, 12, 8, 9, 0, 0, 0, 0, 0, 0, 0, 0 };
    for (std::uint8_t value = 0; value < 16; ++value)
        CHECK (model.decode (Bytes { value }).buttons == expected[value]);
}

TEST_CASE ("an effort is encoded as the nearest number of its field, and if it is not finite, the field stays neutral")
{
    test::property ("any effort", [] {
        OutputField field;
        field.name = "push";
        field.bits = *anyBits();
        field.encoding.scale = *rc::gen::element (1.0, 0.25, -0.001, 1e-9);
        field.encoding.offset = *rc::gen::element (0.0, 5.0, -1e-3);
        HidModel model (deviceThatTakes (field, 12));
        const double value = *rc::gen::element (0.0, 1.0, -1.0, 5.0, 1e12, -1e12, 1e-4, 123.456);
        HidEffort effort;
        effort.efforts[0] = value;
        const auto sent = model.encode (0, effort);
        const double number = (value - field.encoding.offset) / field.encoding.scale;
        const double told = numberOf (field.bits, bitsAt (field.bits, sent.subspan (1)));
        const double held = std::clamp (number, smallest (field.bits), largest (field.bits));
        RC_ASSERT (std::abs (told - held) <= 0.5 + 1e-9 * std::abs (held));

        for (const double none : { std::nan (""), HUGE_VAL, -HUGE_VAL })
        {
            effort.efforts[0] = none;
            const auto neutral = model.encode (0, effort);
            RC_ASSERT (Bytes (neutral.begin() + 1, neutral.end()) == Bytes (12, 0x55));
        }
    });
}

TEST_CASE ("a sample that is not a number is encoded as silence")
{
    HidModel pad (test::profileOf ("dualsense_bluetooth_samples"));
    const float samples[] = { std::nanf (""), HUGE_VALF, 0.5f };
    const auto sent = pad.encode (1, {}, samples);
    CHECK (sent[13] == 0);
    CHECK (sent[14] == 0);
    CHECK (sent[15] == 64);
}

TEST_CASE ("a force that is not a number is encoded as zero")
{
    HidModel board (test::profileOf ("tactus_board"));
    board.decode (test::profileOf ("tactus_board")->samples[0].input[0]);
    HidEffort effort;
    effort.force = { std::nan (""), 1.0, 0.0 };
    effort.torque = { 0.0, INFINITY, 0.0 };
    const auto sent = board.encode (0, effort);
    for (std::size_t i = 1 + 8; i < 1 + 32; ++i)
        CHECK (sent[i] == 0);
}

TEST_CASE ("counters in output reports wrap around")
{
    HidModel pad (test::profileOf ("dualsense_bluetooth_samples"));
    for (unsigned i = 0; i < 600; ++i)
    {
        CHECK (pad.encode (0, {})[1] == (i % 16) << 4);
        const auto samples = pad.neutral (1);
        CHECK (samples[1] == (i % 16) << 4);
        CHECK (samples[10] == i % 256);
    }
}

TEST_CASE ("the checksum is a CRC-32 over a prefix and the bytes before it")
{
    const std::string_view digits = "123456789";
    const Bytes bytes (digits.begin(), digits.end());
    CHECK (crc32 (bytes) == 0xcbf43926u);
    CHECK (crc32 (std::span (bytes).subspan (4), crc32 (std::span (bytes).first (4))) == 0xcbf43926u);

    // The remainder over a message and its checksum is the same for all messages.
    test::property ("any efforts", [] {
        HidModel pad (test::profileOf ("dualsense_bluetooth"));
        HidEffort effort;
        for (auto& e : effort.efforts)
            e = *rc::gen::element (0.0, 0.3, 1.0, -1.0);
        const auto sent = pad.encode (0, effort);
        RC_ASSERT (crc32 (sent, crc32 (Bytes { 0xa2 })) == 0x2144df1cu);
    });
}

TEST_CASE ("decoding and encoding neither allocate nor lock")
{
    if (! NoAllocation::watches)
    {
        WARN ("skipped: sanitizers have their own allocators");
        return;
    }
    for (const auto& profile : test::profiles())
    {
        HidModel model (profile);
        HidEffort effort;
        effort.force = { 0.1, 0.2, 0.3 };
        std::array<float, 64> samples {};
        int allocations = 0, locks = 0;
        {
            const NoAllocation watch;
            for (const auto& sample : profile->samples)
                for (const auto& report : sample.input)
                    model.decode (report);
            model.decode ({});
            for (std::size_t i = 0; i < model.outputs(); ++i)
            {
                model.encode (i, effort, samples);
                model.neutral (i);
            }
            allocations = watch.allocations();
            locks = watch.locks();
        }
        INFO (profile->id);
        CHECK (allocations == 0);
        CHECK (locks == 0);
    }
}

TEST_CASE ("every profile decodes or refuses any bytes")
{
    test::property ("any bytes, for any profile", [] {
        const auto data = *rc::gen::container<std::string> (rc::gen::arbitrary<char>());
        const auto blown_up = data + data + data + data;
        for (const auto& profile : test::profiles())
        {
            fuzz::tryReport (profile, data);
            fuzz::tryReport (profile, blown_up);
        }
    });
}
