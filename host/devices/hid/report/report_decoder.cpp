// SPDX-License-Identifier: MIT
#include "report_decoder.hpp"
#include <host/devices/hid/bits.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{
namespace
{
std::uint32_t rangeOf (std::size_t bits) noexcept { return bits >= 32 ? ~0u : (1u << bits) - 1u; }

/// The index of a name in a list; a new name is appended.
int indexIn (std::vector<std::string>& list, const std::string& name)
{
    const auto it = std::ranges::find (list, name);
    const auto index = it - list.begin();
    if (it == list.end()) list.push_back (name);
    return static_cast<int> (index);
}
}   // namespace

std::string_view describe (Refusal refusal) noexcept
{
    constexpr std::array<std::string_view, refusals> words { "none", "too short", "too long", "unknown report id", "wrong mark", "not finite" };
    return words[static_cast<std::size_t> (refusal)];
}

ReportDecoder::ReportDecoder (std::shared_ptr<const Profile> p) : profile (std::move (p))
{
    for (const auto& report : profile->inputs)
    {
        Report r { .report = &report, .fields = {} };
        for (std::size_t i = 0; i < report.fields.size(); ++i)
        {
            const auto& field = report.fields[i];
            Field f { .field = &field, .masks = {}, .counter = {} };
            if (field.isAxis())
            {
                f.axis = indexIn (names, field.name);
                units.resize (names.size(), field.unit);
            }
            for (const auto& button : field.buttons)
            {
                const auto mask = button.empty() ? 0u : 1u << static_cast<unsigned> (indexIn (button_names, button));
                f.masks.push_back (mask);
                f.all |= mask;
            }
            if (f.axis >= 0 && field.name == report.timestamp) r.timestamp = static_cast<int> (i);
            if (f.axis >= 0 && field.name == report.sequence) r.sequence = static_cast<int> (i);
            r.fields.push_back (std::move (f));
        }
        has_time = has_time || r.timestamp >= 0;
        reports.push_back (std::move (r));
    }
}

int ReportDecoder::axis (std::string_view name) const noexcept
{
    const auto it = std::ranges::find (names, name);
    return it == names.end() ? -1 : static_cast<int> (it - names.begin());
}

ReportDecoder::Report* ReportDecoder::find (std::span<const std::uint8_t> bytes) noexcept
{
    Report* last = nullptr;
    for (auto& r : reports)
    {
        if (r.report->id && (bytes.empty() || bytes.front() != *r.report->id)) continue;
        last = &r;
        if (hasMarks (r, bytes)) break;
    }
    return last;
}

bool ReportDecoder::hasMarks (const Report& r, std::span<const std::uint8_t> bytes) noexcept
{
    return bytes.size() >= r.report->length && std::ranges::all_of (r.fields, [&] (const Field& f) {
               return ! f.field->expect || numberOf (f.field->bits, bitsAt (f.field->bits, bytes)) == *f.field->expect;
           });
}

Refusal ReportDecoder::check (const Report& r, std::span<const std::uint8_t> bytes) const noexcept
{
    if (bytes.size() < r.report->length) return Refusal::too_short;
    if (bytes.size() > r.report->longest) return Refusal::too_long;

    for (const auto& f : r.fields)
    {
        const double number = numberOf (f.field->bits, bitsAt (f.field->bits, bytes));
        if (! isFinite (number * f.field->scale + f.field->offset)) return Refusal::not_finite;
        if (f.field->expect && number != *f.field->expect) return Refusal::wrong_mark;
    }
    return Refusal::none;
}

Refusal ReportDecoder::decode (std::span<const std::uint8_t> bytes) noexcept
{
    Report* const r = find (bytes);
    auto refusal = bytes.empty() ? Refusal::too_short : Refusal::unknown_id;
    if (r != nullptr) refusal = check (*r, bytes);
    gap = 0;
    order = ReportOrder::next;
    if (refusal != Refusal::none)
    {
        ++tally.refused[static_cast<std::size_t> (refusal)];
        return refusal;
    }

    ++tally.taken;
    for (std::size_t i = 0; i < r->fields.size(); ++i)
    {
        auto& f = r->fields[i];
        const auto raw = bitsAt (f.field->bits, bytes);
        if (f.axis >= 0) takeAxis (f, raw);
        if (! f.masks.empty()) takeButtons (f, raw);
        if (static_cast<int> (i) == r->sequence) follow (*r, raw, f.field->bits.size);
    }

    if (r->timestamp >= 0) keepTime (*r);
    return Refusal::none;
}

void ReportDecoder::keepTime (Report& r) noexcept
{
    const double now = values[static_cast<std::size_t> (r.fields[static_cast<std::size_t> (r.timestamp)].axis)];
    if (! r.timed)
        r.first_time = now;
    else if (now < r.last_time)
        order = ReportOrder::back;
    else if (now == r.last_time && order == ReportOrder::next)
        order = ReportOrder::clock_stopped;
    r.timed = true;
    r.last_time = now;
    clock = now - r.first_time;
}

void ReportDecoder::takeAxis (Field& f, std::uint32_t raw) noexcept
{
    const auto& field = *f.field;
    double number = numberOf (field.bits, raw);
    if (field.unwrap)
    {
        // Assume that the counter went the shorter way around its range.
        auto& c = f.counter;
        const auto range = rangeOf (field.bits.size);
        const auto on = (raw - c.raw) & range;
        const bool back = on > range / 2;
        if (! c.started)
            c.total = number;
        else
            c.total += static_cast<double> (on) - (back ? static_cast<double> (range) + 1.0 : 0.0);
        c.started = true;
        c.raw = raw;
        number = c.total;
    }
    raws[static_cast<std::size_t> (f.axis)] = raw;
    values[static_cast<std::size_t> (f.axis)] = number * field.scale + field.offset;
}

void ReportDecoder::takeButtons (const Field& f, std::uint32_t raw) noexcept
{
    pressed &= ~f.all;
    if (! f.field->is_hat)
    {
        for (std::size_t i = 0; i < f.masks.size(); ++i)
            if ((raw >> i & 1u) != 0) pressed |= f.masks[i];
        return;
    }

    // 0 is up, 1 up and right, 2 right …; 8 and above are neutral.
    if (raw > 7) return;
    pressed |= f.masks[(raw / 2) % 4];
    if (raw % 2 == 1) pressed |= f.masks[(raw / 2 + 1) % 4];
}

void ReportDecoder::follow (Report& r, std::uint32_t raw, std::size_t bits) noexcept
{
    const auto range = rangeOf (bits);
    const auto on = (raw - r.count) & range;
    if (r.counted && on == 0)
        order = ReportOrder::repeated;
    else if (r.counted && on > range / 2)
    {
        order = ReportOrder::back;
        ++tally.restarts;
    }
    else if (r.counted)
    {
        gap = on - 1;
        tally.lost += gap;
    }
    r.counted = true;
    r.count = raw;
}

void ReportDecoder::reset()
{
    for (auto& r : reports)
    {
        r.counted = r.timed = false;
        for (auto& f : r.fields)
            f.counter = {};
    }
    values.fill (0.0);
    raws.fill (0);
    pressed = gap = 0;
    order = ReportOrder::next;
    clock = 0.0;
    tally = {};
}

}   // namespace tactus::host::hid
