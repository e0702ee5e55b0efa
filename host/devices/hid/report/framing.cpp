// SPDX-License-Identifier: MIT
#include "framing.hpp"
#include "crc32.hpp"

#include <host/devices/hid/bits.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tactus::host::hid
{
namespace
{
constexpr std::size_t crc_size = 4, length_size = 2, longest_run = 254;
constexpr std::uint8_t panto_mark[] { 0x44, 0x50 };
constexpr std::size_t panto_head = std::size (panto_mark) + 1 + length_size;   // with the first byte of the report
constexpr Bits panto_length { .at = 8 * (panto_head - length_size), .size = 16, .big_endian = true };
constexpr std::size_t most_waiting = 4096;   // what Linux keeps of a serial line

std::size_t longestOf (const std::vector<FrameReader::Shape>& shapes) noexcept
{
    std::size_t longest = 1;
    for (const auto& s : shapes)
        longest = std::max (longest, s.longest);
    return longest;
}

void putCrc (std::uint32_t crc, std::span<std::uint8_t> at) noexcept { putBits ({ .at = 0, .size = 32 }, crc, at); }
std::uint32_t crcAt (std::span<const std::uint8_t> at) noexcept { return bitsAt ({ .at = 0, .size = 32 }, at); }

/// Writes the COBS of the bytes of `report` and of its CRC.
std::size_t writeCobs (std::span<const std::uint8_t> report, std::span<std::uint8_t> into) noexcept
{
    std::uint8_t sum[crc_size];
    putCrc (crc32 (report), sum);
    std::size_t code_at = 0, at = 1;
    std::uint8_t code = 1;
    const auto endRun = [&] {
        into[code_at] = code;
        code_at = at++;
        code = 1;
    };
    for (std::size_t i = 0; i < report.size() + crc_size; ++i)
    {
        if (code == longest_run + 1) endRun();
        const auto byte = i < report.size() ? report[i] : sum[i - report.size()];
        if (byte == 0)
        {
            endRun();
            continue;
        }
        into[at++] = byte;
        ++code;
    }
    into[code_at] = code;
    return at;
}

/// The bytes of a COBS frame without its zeros; returns how many, or 0 if it is none or does not fit.
std::size_t readCobs (std::span<const std::uint8_t> frame, std::span<std::uint8_t> into) noexcept
{
    std::size_t n = 0;
    for (std::size_t at = 0; at < frame.size();)
    {
        const std::size_t run = frame[at++];
        if (run == 0 || run - 1 > frame.size() - at || n + run > into.size()) return 0;
        for (std::size_t i = 1; i < run; ++i)
            into[n++] = frame[at++];
        if (run <= longest_run && at < frame.size()) into[n++] = 0;
    }
    return n;
}
/// True if the byte is the same in every report of this kind.
bool isConstant (const OutputReport& report, std::size_t byte)
{
    if (report.body[byte] != report.neutral[byte]) return false;
    const auto within = [byte] (std::size_t first, std::size_t size) { return byte >= first && byte < first + size; };
    const auto touches = [&] (const Bits& b) { return within (b.at / 8, (b.end() + 7) / 8 - b.at / 8); };
    if (report.given && touches (*report.given)) return false;
    if (report.checksum && within (report.checksum->at, crc_size)) return false;
    if (const auto& s = report.stream; s && within (s->at, s->frames * s->channels.size() * static_cast<std::size_t> (s->bits) / 8)) return false;
    return std::ranges::none_of (report.fields, [&] (const auto& f) { return touches (f.bits); })
           && std::ranges::none_of (report.sequences, [&] (const auto& s) { return s.byte == byte; });
}
}   // namespace

std::size_t longestFrame (Framing framing, std::size_t report) noexcept
{
    if (framing == Framing::none || framing == Framing::answer) return report;
    if (framing == Framing::dualpanto) return panto_head - 1 + report;
    const auto summed = report + crc_size;
    return framing == Framing::length ? length_size + summed : 2 + summed + 1 + summed / longest_run;
}

std::size_t writeFrame (Framing framing, std::span<const std::uint8_t> report, std::span<std::uint8_t> into) noexcept
{
    if (into.size() < longestFrame (framing, report.size()) || report.size() > longest_report) return 0;
    if (framing == Framing::cobs)
    {
        into[0] = 0;
        const auto size = 1 + writeCobs (report, into.subspan (1));
        into[size] = 0;
        return size + 1;
    }
    if (framing == Framing::dualpanto)
    {
        if (report.empty()) return 0;
        std::ranges::copy (panto_mark, into.begin());
        into[std::size (panto_mark)] = report.front();
        putBits (panto_length, static_cast<std::uint32_t> (report.size() - 1), into);
        std::ranges::copy (report.subspan (1), into.begin() + panto_head);
        return panto_head - 1 + report.size();
    }
    const std::size_t before = framing == Framing::length ? length_size : 0;
    std::ranges::copy (report, into.begin() + static_cast<std::ptrdiff_t> (before));
    if (before == 0) return report.size();
    putBits ({ .at = 0, .size = 16 }, static_cast<std::uint32_t> (report.size()), into);
    const auto summed = before + report.size();
    putCrc (crc32 (into.first (summed)), into.subspan (summed));
    return summed + crc_size;
}

//==============================================================================
FrameReader::FrameReader (Framing f, std::vector<Shape> s)
    : framing (f), shapes (std::move (s)), longest (longestFrame (f, longestOf (shapes))), buffer (std::max (most_waiting, 4 * longest)),
      decoded (longestOf (shapes) + crc_size + 1)
{
}

std::span<std::uint8_t> FrameReader::room() noexcept
{
    if (buffer.size() - end < buffer.size() / 2)
    {
        std::shift_left (buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t> (end), static_cast<std::ptrdiff_t> (begin));
        end -= begin;
        begin = 0;
    }
    if (end == buffer.size()) drop (end - begin);   // only if next() was not called until it was empty
    return std::span (buffer).subspan (end);
}

void FrameReader::arrived (std::size_t bytes) noexcept { end = std::min (end + bytes, buffer.size()); }

std::optional<std::span<const std::uint8_t>> FrameReader::next() noexcept
{
    switch (framing)
    {
    case Framing::cobs:
        return nextCobs();
    case Framing::length:
        return nextWithLength();
    case Framing::dualpanto:
        return nextOfPanto();
    case Framing::none:
    case Framing::answer:
        break;
    }
    return nextPlain();
}

void FrameReader::pause() noexcept
{
    // Without framing, a whole report may have waited for a second one to confirm where it begins; the pause confirms it.
    const auto* shape = framing == Framing::none ? shapeAt (0) : nullptr;
    const bool is_whole = shape != nullptr && waiting().size() >= shape->length;
    if (! is_whole) drop (end - begin);
    in_step = true;
    is_overlong = false;
}

void FrameReader::reset() noexcept
{
    begin = end = 0;
    in_step = is_overlong = false;
}

void FrameReader::drop (std::size_t bytes) noexcept
{
    begin += bytes;
    tally.bytes += bytes;
    if (begin == end) begin = end = 0;
}

FrameReader::Report FrameReader::take (std::size_t offset, std::size_t size, std::size_t whole) noexcept
{
    const auto report = waiting().subspan (offset, size);
    begin += whole;
    ++tally.frames;
    return report;
}

bool FrameReader::fits (const Shape& shape, std::span<const std::uint8_t> report) const noexcept
{
    if (shape.id && report.front() != *shape.id) return false;
    return std::ranges::all_of (shape.marks, [&] (const auto& mark) { return bitsAt (mark.first, report) == mark.second; });
}

/// The shape of the report that may begin so far behind `begin`: the one whose marks are there, as far as it has come.
const FrameReader::Shape* FrameReader::shapeAt (std::size_t offset) const noexcept
{
    const auto bytes = waiting().subspan (std::min (offset, end - begin));
    for (const auto& shape : shapes)
        if (bytes.size() >= shape.length ? fits (shape, bytes) : ! shape.id || bytes.empty() || bytes.front() == *shape.id) return &shape;
    return nullptr;
}

/// Without framing, the marks tell where a report begins. They may also occur within one, so after any doubt two reports in a row must have
/// them. There are no two in a row if the next one comes only when it is asked for.
FrameReader::Report FrameReader::nextPlain() noexcept
{
    while (begin < end)
    {
        const auto* shape = shapeAt (0);
        if (shape == nullptr)
        {
            in_step = false;
            drop (1);
            continue;
        }
        const auto size = shape->length;
        if (waiting().size() < size) return {};
        if (! in_step && framing == Framing::none)
        {
            const auto* second = shapeAt (size);
            if (second == nullptr)
            {
                drop (1);
                continue;
            }
            if (waiting().size() < size + second->length) return {};
            in_step = true;
        }
        return take (0, size, size);
    }
    return {};
}

FrameReader::Report FrameReader::nextCobs() noexcept
{
    while (begin < end)
    {
        const auto all = waiting();
        const auto zero = static_cast<std::size_t> (std::ranges::find (all, std::uint8_t { 0 }) - all.begin());
        if (zero == all.size())
        {
            if (all.size() <= longest) return {};
            drop (all.size());   // no frame is that long
            is_overlong = true;
            return {};
        }
        const bool is_end = std::exchange (is_overlong, false);
        const auto size = zero > 0 && zero <= longest && ! is_end ? readCobs (all.first (zero), decoded) : 0;
        const auto summed = size > crc_size ? size - crc_size : 0;
        if (summed == 0 || crc32 (std::span (decoded).first (summed)) != crcAt (std::span (decoded).subspan (summed)))
        {
            begin += zero + 1;
            tally.bytes += zero;   // the zero itself belongs between frames
            continue;
        }
        begin += zero + 1;
        ++tally.frames;
        return std::span<const std::uint8_t> (decoded).first (summed);
    }
    return {};
}

FrameReader::Report FrameReader::nextWithLength() noexcept
{
    while (end - begin >= length_size)
    {
        const auto all = waiting();
        const std::size_t size = bitsAt ({ .at = 0, .size = 16 }, all);
        const bool can_be = std::ranges::any_of (shapes, [&] (const Shape& s) { return size >= s.length && size <= s.longest; });
        const auto summed = length_size + size;
        if (can_be && all.size() < summed + crc_size) return {};
        if (! can_be || crc32 (all.first (summed)) != crcAt (all.subspan (summed)))
        {
            drop (1);
            continue;
        }
        return take (length_size, size, summed + crc_size);
    }
    return {};
}

FrameReader::Report FrameReader::nextOfPanto() noexcept
{
    while (begin < end)
    {
        const auto all = waiting();
        const auto marked = std::min (all.size(), std::size (panto_mark));
        if (! std::equal (panto_mark, panto_mark + marked, all.begin()))
        {
            drop (1);
            continue;
        }
        if (all.size() < panto_head) return {};
        const auto id = all[std::size (panto_mark)];
        const std::size_t size = 1 + bitsAt (panto_length, all);
        const bool can_be = std::ranges::any_of (shapes, [&] (const Shape& s) { return (! s.id || *s.id == id) && size >= s.length && size <= s.longest; });
        if (can_be && all.size() < panto_head - 1 + size) return {};
        if (! can_be)
        {
            drop (1);
            continue;
        }
        decoded.front() = id;
        std::ranges::copy (all.subspan (panto_head, size - 1), decoded.begin() + 1);
        begin += panto_head - 1 + size;
        ++tally.frames;
        return std::span<const std::uint8_t> (decoded).first (size);
    }
    return {};
}

//==============================================================================
std::vector<FrameReader::Shape> inputShapes (const Profile& p)
{
    std::vector<FrameReader::Shape> shapes;
    for (const auto& report : p.inputs)
    {
        auto& shape = shapes.emplace_back (FrameReader::Shape { report.id, report.length, report.longest, {} });
        for (const auto& field : report.fields)
            if (field.expect) shape.marks.emplace_back (field.bits, static_cast<std::uint32_t> (*field.expect));
    }
    return shapes;
}

std::vector<FrameReader::Shape> outputShapes (const Profile& p)
{
    std::vector<FrameReader::Shape> shapes;
    for (const auto& report : p.outputs)
    {
        auto& shape = shapes.emplace_back (FrameReader::Shape { report.id, report.neutral.size(), report.neutral.size(), {} });
        for (std::size_t i = 0; i < std::min (report.neutral.size(), report.body.size()); ++i)
            if (isConstant (report, i)) shape.marks.emplace_back (Bits { .at = 8 * i }, report.neutral[i]);
    }
    return shapes;
}

}   // namespace tactus::host::hid
