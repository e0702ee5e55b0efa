// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/profile.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tactus::host::hid
{

/// The most bytes that a report becomes on a line.
std::size_t longestFrame (Framing, std::size_t report) noexcept;

/// Writes a report as it goes on a line, and returns its size there; 0 if it does not fit.
///  - none, answer: the bytes of the report.
///  - cobs: 0, the report and its CRC-32 (little-endian) in COBS (Cheshire and Baker, 1999), 0. The first 0 ends what an earlier
///    frame may have left unfinished.
///  - length: the size of the report (u16, little-endian), the report, and the CRC-32 (little-endian) of both.
///  - dualpanto: 44 50, the first byte of the report, the number of its other bytes (u16, big-endian), and these. No CRC.
std::size_t writeFrame (Framing, std::span<const std::uint8_t> report, std::span<std::uint8_t> into) noexcept;

/// Finds the reports in a stream of bytes. Whatever comes, a report is passed on only if its frame is whole: with the right CRC, without framing,
/// where every field with a required value has it, or from a DualPanto, where its first byte and its length are those of a report.
/// Allocates nothing after construction and never throws. [one thread]
class FrameReader
{
public:
    /// The shape of a report that can come.
    struct Shape
    {
        std::optional<std::uint8_t> id;
        std::size_t length = 0, longest = 0;                 ///< in bytes
        std::vector<std::pair<Bits, std::uint32_t>> marks;   ///< fields with a required value
    };

    struct Counts
    {
        std::uint64_t frames = 0;   ///< reports passed on
        std::uint64_t bytes = 0;    ///< bytes that belong to none
    };

    FrameReader (Framing, std::vector<Shape>);

    /// The room for the next bytes; never empty.
    std::span<std::uint8_t> room() noexcept;

    /// So many bytes have been put there.
    void arrived (std::size_t bytes) noexcept;

    /// The next whole report; empty until more bytes have come. Valid until the next call.
    std::optional<std::span<const std::uint8_t>> next() noexcept;

    /// True if a part of a report is there.
    bool isWithin() const noexcept { return begin < end; }

    /// The line was silent for longer than within a report, so what has come of one is dropped, and the next byte begins another one.
    /// Without framing, and from a device that only answers, nothing else is certain to find the beginning again after a lost byte.
    void pause() noexcept;

    /// Forgets everything, for a line that has been opened again.
    void reset() noexcept;

    const Counts& counts() const noexcept { return tally; }

private:
    using Report = std::optional<std::span<const std::uint8_t>>;

    std::span<const std::uint8_t> waiting() const noexcept { return std::span (buffer).subspan (begin, end - begin); }
    void drop (std::size_t bytes) noexcept;
    Report take (std::size_t offset, std::size_t size, std::size_t whole) noexcept;
    bool fits (const Shape&, std::span<const std::uint8_t> report) const noexcept;
    const Shape* shapeAt (std::size_t offset) const noexcept;
    Report nextPlain() noexcept;
    Report nextCobs() noexcept;
    Report nextWithLength() noexcept;
    Report nextOfPanto() noexcept;

    const Framing framing;
    const std::vector<Shape> shapes;
    const std::size_t longest;          // of a frame, in bytes
    std::vector<std::uint8_t> buffer;   // what is waiting lies from `begin` to `end`
    std::vector<std::uint8_t> decoded;
    std::size_t begin = 0, end = 0;
    bool is_overlong = false;   // COBS: the beginning of a frame that is too long has been dropped
    bool in_step = false;       // without framing: `begin` is known to be the beginning of a report
    Counts tally;
};

/// The shapes of the input reports of a profile.
std::vector<FrameReader::Shape> inputShapes (const Profile&);

/// The shapes of its output reports, for the other end.
std::vector<FrameReader::Shape> outputShapes (const Profile&);

}   // namespace tactus::host::hid
