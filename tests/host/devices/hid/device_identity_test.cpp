// SPDX-License-Identifier: MIT
#include "hid.hpp"

#include <host/devices/hid/device_identity.hpp>
#include <host/devices/hid/device_side.hpp>
#include <host/devices/hid/report_descriptor.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host::hid;
using test::profiles;

namespace
{
constexpr unsigned vendor_page = 0xff00;

/// A profile with this "match", an input report without an id, and perhaps an output report.
std::shared_ptr<const Profile> changed (const std::string& match, const std::string& output = "")
{
    const auto text = R"({"format": "tactus-profile", "version": 1, "id": "x", "name": "X", "sources": ["a test"], "match": [)" + match + R"(],
        "inputs": [{"length": 3, "verified": true, "fields": [{"name": "x", "at": 1, "type": "s16le"}]}], "outputs": [)"
                      + output + "]}";
    auto read = readProfileText (text);
    for (const auto& m : read.messages)
        UNSCOPED_INFO (describe (m));
    REQUIRE (read.profile);
    return read.profile;
}
}   // namespace

TEST_CASE ("a virtual device is found by the profile that it is made from, and has its reports", "[hid][wires]")
{
    int made = 0;
    for (const auto& profile : profiles())
    {
        if (profile->match.empty() || profile->inputs.empty()) continue;
        INFO (profile->id);
        const auto device = identityOf (*profile);
        REQUIRE (device);
        const auto found = matching (profiles(), device->info);
        REQUIRE_FALSE (found.empty());
        CHECK (fit (*profile, device->info) == fit (*found.front(), device->info));

        const auto [described, messages] = readDescriptor (device->descriptor);
        CHECK (messages.empty());
        REQUIRE_FALSE (described.collections.empty());
        CHECK (described.collections.front().usage == usageOf (device->info.usage_page, device->info.usage));
        for (const auto& in : profile->inputs)
            CHECK (described.length (DescribedField::Kind::input, in.id.value_or (0)) + (in.id ? 1 : 0) >= in.length);
        for (const auto& out : profile->outputs)
            CHECK (described.length (out.is_feature ? DescribedField::Kind::feature : DescribedField::Kind::output, out.id.value_or (0)) + (out.id ? 1 : 0)
                   >= out.body.size());
        for (const auto& step : profile->init)
            if (step.kind == Step::Kind::get_feature) CHECK (featureOf (*profile, step.bytes.front()).front() == step.bytes.front());
        CHECK (featureOf (*profile, 0xee).empty());
        ++made;
    }
    CHECK (made >= 8);
}

TEST_CASE ("no profile makes a keyboard or a pointer of a virtual device", "[hid][wires][safety]")
{
    constexpr auto keyboard = R"({"vid": "0x1209", "pid": "0x0001", "usage_page": "0x0001", "usage": "0x0006"})";
    const auto device = identityOf (*changed (keyboard));
    REQUIRE (device);
    const auto [described, messages] = readDescriptor (device->descriptor);
    CHECK (messages.empty());
    CHECK (described.collections.front().usage == usageOf (1, 6));
    REQUIRE_FALSE (described.fields.empty());
    for (const auto& field : described.fields)
        for (const auto& range : field.usages)
        {
            CHECK (range.first >> 16 == vendor_page);
            CHECK (range.last >> 16 == vendor_page);
        }
}

TEST_CASE ("a profile that cannot be a virtual device is refused with the reason", "[hid][wires]")
{
    const auto said = [] (const Profile& profile) {
        const auto device = identityOf (profile);
        return device ? std::string() : describe (device.error());
    };
    CHECK (said (*test::profileOf ("haply_2diy")).find ("describes no HID device") != std::string::npos);
    CHECK (said (*test::profileOf ("pantograph_mk2")).find ("describes no HID device") != std::string::npos);
    constexpr auto match = R"({"vid": "0x1209", "pid": "0x0001"})", with_id = R"({"name": "lamp", "id": 3, "neutral": "03 00", "verified": true})";
    CHECK (said (*changed (match)).empty());
    CHECK (said (*changed (match, with_id)).find ("with and without ids") != std::string::npos);
}
