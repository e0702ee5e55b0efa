// SPDX-License-Identifier: MIT
#include "device_identity.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host::hid
{
namespace
{
using Kind = DescribedField::Kind;

/// Adds a report, or makes a known one as long as this one.
void add (std::vector<ReportSize>& all, Kind kind, std::optional<std::uint8_t> id, std::size_t length)
{
    const auto size = length - (id ? 1 : 0);
    const auto known = std::ranges::find_if (all, [&] (const auto& r) { return r.kind == kind && r.id == id; });
    if (known == all.end())
        all.push_back ({ kind, id, size });
    else
        known->size = std::max (known->size, size);
}

std::vector<ReportSize> reportsOf (const Profile& profile)
{
    std::vector<ReportSize> all;
    for (const auto& in : profile.inputs)
        add (all, Kind::input, in.id, in.length);
    for (const auto& out : profile.outputs)
        add (all, out.is_feature ? Kind::feature : Kind::output, out.id, out.body.size());
    for (const auto* steps : { &profile.init, &profile.exit })
        for (const auto& step : *steps)
            if (step.kind != Step::Kind::output && step.bytes.size() > 1)
                add (all, Kind::feature, usesIds (profile) ? std::optional (step.bytes.front()) : std::nullopt, step.bytes.size());
    std::ranges::stable_sort (all, {}, &ReportSize::id);
    return all;
}

std::uint8_t tagOf (Kind kind)
{
    if (kind == Kind::input) return 0x81;
    return kind == Kind::output ? 0x91 : 0xb1;
}

template <typename T>
T firstOf (const std::vector<T>& values)
{
    return values.empty() ? T {} : values.front();
}
}   // namespace

Bytes describeReports (std::uint16_t usage_page, std::uint16_t usage, std::span<const ReportSize> reports)
{
    Bytes d;
    const auto item = [&] (std::uint8_t tag, std::size_t value, int bytes) {
        d.push_back (tag);
        for (int i = 0; i < bytes; ++i)
            d.push_back (static_cast<std::uint8_t> (value >> (8 * i)));
    };
    item (0x06, usage_page, 2);
    item (0x0a, usage, 2);
    item (0xa1, 1, 1);        // application
    item (0x06, 0xff00, 2);   // of the vendor
    item (0x15, 0, 1);
    item (0x26, 0xff, 2);   // bytes from 0 to 255
    item (0x75, 8, 1);
    for (const auto& report : reports)
    {
        if (report.id) item (0x85, *report.id, 1);
        item (0x96, report.size, 2);
        item (0x09, 1, 1);
        item (tagOf (report.kind), 2, 1);   // data, variable, absolute
    }
    d.push_back (0xc0);
    return d;
}

Result<DeviceIdentity> identityOf (const Profile& profile)
{
    const auto no = [&] (std::string why, std::string remedy) {
        return Message::error ("fake/wire", profile.id, "the profile " + quote (profile.id) + " " + std::move (why), std::move (remedy));
    };
    if (profile.match.empty() || profile.inputs.empty())
        return no ("describes no HID device", "choose another wire, or a profile with \"match\" and \"inputs\"");
    const auto& rule = profile.match.front();
    DeviceIdentity device;
    device.info.vid = firstOf (rule.vid);
    device.info.pid = firstOf (rule.pid);
    device.info.usage_page = rule.usage_page.value_or (0xff00);
    device.info.usage = rule.usage.value_or (1);
    device.info.bus = rule.bus.value_or (Bus::usb);
    device.info.product = rule.product.empty() ? profile.name : rule.product;

    const auto reports = reportsOf (profile);
    if (reports.front().id.has_value() != reports.back().id.has_value())
        return no ("has reports with and without ids", "give each report an id, or none");
    device.descriptor = describeReports (device.info.usage_page, device.info.usage, reports);
    return device;
}

Bytes featureOf (const Profile& profile, std::uint8_t id)
{
    const bool has_ids = usesIds (profile);
    for (const auto& step : profile.init)
    {
        if (step.kind != Step::Kind::get_feature || step.bytes.empty() || (has_ids && step.bytes.front() != id)) continue;
        Bytes report (step.bytes.size() + (has_ids ? 0 : 1));
        report.front() = id;
        return report;
    }
    return {};
}

}   // namespace tactus::host::hid
