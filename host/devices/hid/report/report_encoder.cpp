// SPDX-License-Identifier: MIT
#include "report_encoder.hpp"
#include "crc32.hpp"
#include "report_decoder.hpp"
#include <host/devices/hid/bits.hpp>

#include <tactus/kit/math/math.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host::hid
{
namespace
{
double interpolated (const std::vector<double>& x, const std::vector<double>& y, double at) noexcept
{
    const auto above = std::ranges::upper_bound (x, at);
    if (above == x.begin()) return y.front();
    if (above == x.end()) return y.back();
    const auto i = static_cast<std::size_t> (above - x.begin());
    return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

/// The encoded number of a value; -inf if the logarithm does not exist.
double lawOf (const Encoding& e, double value) noexcept
{
    switch (e.law)
    {
    case Encoding::Law::log2:
        if (value <= 0.0) return -std::numeric_limits<double>::infinity();
        return std::floor (e.steps * math::log2 (value / e.reference) + 0.5);
    case Encoding::Law::table:
        return interpolated (e.x, e.y, value);
    default:
        return value;
    }
}
}   // namespace

double decoded (const Encoding& e, double number) noexcept
{
    const double law = number * e.scale + e.offset;
    switch (e.law)
    {
    case Encoding::Law::log2:
        return e.reference * math::exp2 (law / e.steps);
    case Encoding::Law::table:
        return e.y.front() <= e.y.back() ? interpolated (e.y, e.x, law) : e.x.front();
    default:
        return law;
    }
}

double encoded (const Encoding& e, double value) noexcept { return (lawOf (e, value) - e.offset) / e.scale; }

ReportEncoder::ReportEncoder (std::shared_ptr<const Profile> p, const ReportDecoder& decoder) : profile (std::move (p))
{
    for (const auto& report : profile->outputs)
    {
        Report r { .report = &report, .fields = {}, .wire = Bytes (report.body.size() + (report.id ? 0 : 1)) };
        for (const auto& field : report.fields)
        {
            Field f { .field = &field, .neutral = bitsAt (field.bits, report.neutral) };
            if (field.source == OutputField::Source::echo) f.index = decoder.axis (field.name);
            if (field.source == OutputField::Source::effort)
            {
                f.index = effort (field.name);
                if (f.index < 0)
                {
                    f.index = static_cast<int> (names.size());
                    names.push_back (field.name);
                    units.push_back (field.unit);
                    rest[static_cast<std::size_t> (f.index)] = std::clamp (decoded (field.encoding, numberOf (field.bits, f.neutral)), field.min, field.max);
                }
            }
            r.fields.push_back (f);
        }
        reports.push_back (std::move (r));
    }
}

int ReportEncoder::effort (std::string_view name) const noexcept
{
    const auto it = std::ranges::find (names, name);
    return it == names.end() ? -1 : static_cast<int> (it - names.begin());
}

std::span<std::uint8_t> ReportEncoder::begin (Report& r, const Bytes& from) noexcept
{
    const auto body = std::span (r.wire).last (from.size());
    std::ranges::copy (from, body.begin());
    return body;
}

void ReportEncoder::finish (Report& r, std::span<std::uint8_t> body) noexcept
{
    for (const auto& s : r.report->sequences)
    {
        auto& byte = body[s.byte];
        const auto mask = static_cast<unsigned> (s.modulo - 1) << s.shift;
        byte = static_cast<std::uint8_t> ((byte & ~mask) | (r.count << s.shift & mask));
    }
    ++r.count;
    if (const auto& c = r.report->checksum)
    {
        const auto sum = crc32 (body.first (c->at), crc32 (c->prefix));
        putBits ({ .at = 8 * c->at, .size = 32 }, sum, body);
    }
}

std::span<const std::uint8_t> ReportEncoder::encode (std::size_t report, const std::array<double, most_efforts>& values, std::span<const float> samples,
                                                     const ReportDecoder& decoder) noexcept
{
    if (report >= reports.size()) return {};
    auto& r = reports[report];
    const auto body = begin (r, r.report->body);

    for (const auto& f : r.fields)
    {
        const auto& field = *f.field;
        std::uint32_t raw = f.neutral;
        if (field.source == OutputField::Source::enable)
            raw = 1;
        else if (field.source == OutputField::Source::echo)
            raw = decoder.raw (static_cast<std::size_t> (f.index));
        else if (const double value = values[static_cast<std::size_t> (f.index)]; isFinite (value))
        {
            const double number = encoded (field.encoding, std::clamp (value, field.min, field.max));
            if (number == number) raw = rawOf (field.bits, number);
        }
        putBits (field.bits, raw, body);
    }

    if (const auto& s = r.report->stream)
    {
        const auto size = static_cast<std::size_t> (s->bits);
        const double full = static_cast<double> (1 << (s->bits - 1)) - 1.0;
        const double middle = s->is_signed ? 0.0 : full + 1.0;
        for (std::size_t i = 0; i < s->frames * s->channels.size(); ++i)
        {
            const double sample = i < samples.size() && isFinite (samples[i]) ? static_cast<double> (samples[i]) : 0.0;
            const Bits bits { .at = 8 * s->at + i * size, .size = size, .is_signed = s->is_signed };
            putBits (bits, rawOf (bits, middle + full * std::clamp (sample, -1.0, 1.0)), body);
        }
    }

    finish (r, body);
    return r.wire;
}

std::span<const std::uint8_t> ReportEncoder::neutral (std::size_t report) noexcept
{
    if (report >= reports.size()) return {};
    auto& r = reports[report];
    finish (r, begin (r, r.report->neutral));
    return r.wire;
}

void ReportEncoder::reset()
{
    for (auto& r : reports)
        r.count = 0;
}

}   // namespace tactus::host::hid
