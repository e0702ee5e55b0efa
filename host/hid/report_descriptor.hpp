// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/message.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// What a HID device says about its own reports (Device Class Definition for HID 1.11, section 6.2.2).
namespace tactus::host::hid
{

/// A usage with its page in the upper 16 bits: 0x00010030 is X.
using Usage = std::uint32_t;

constexpr Usage usageOf (unsigned page, unsigned id) noexcept { return page << 16 | id; }

struct DescribedCollection
{
    Usage usage = 0;
    int kind = 0;      ///< 0 physical, 1 application, 2 logical …
    int parent = -1;   ///< index, -1 for the outermost
};

/// One or several numbers of the same size, side by side in a report.
struct DescribedField
{
    enum class Kind
    {
        input,
        output,
        feature
    };

    Kind kind = Kind::input;
    std::uint8_t report = 0;   ///< id; 0 where the device has none
    std::size_t bit = 0;       ///< within the data of the report, the id not counted
    std::size_t size = 0;      ///< bits of each
    std::size_t count = 0;
    bool constant = false;   ///< padding
    bool variable = false;   ///< each number has a usage of its own; else each number is the index of a usage
    bool relative = false;
    std::int64_t logical_min = 0, logical_max = 0;
    std::int64_t physical_min = 0, physical_max = 0;   ///< both 0: as the logical ones
    std::uint32_t unit = 0;
    int unit_exponent = 0;   ///< of 10
    int collection = -1;     ///< index

    struct Range
    {
        Usage first = 0, last = 0;
    };
    std::vector<Range> usages;

    /// The n-th usage; the last one holds for all that follow. Nothing if there is none.
    std::optional<Usage> usage (std::size_t n) const noexcept;

    /// At which place a usage stands.
    std::optional<std::size_t> placeOf (Usage) const noexcept;
};

struct ReportDescriptor
{
    std::vector<DescribedCollection> collections;
    std::vector<DescribedField> fields;
    bool has_ids = false;

    /// Bytes of the data of a report, the id not counted; 0 if there is no such report.
    std::size_t length (DescribedField::Kind, std::uint8_t report) const noexcept;

    /// True if a collection has this usage or lies within one that has.
    bool lies (int collection, Usage within) const noexcept;
};

struct ReadDescriptor
{
    ReportDescriptor descriptor;   ///< what was understood; only to be trusted without errors
    Messages messages;             ///< `where` is the byte, as "byte 17"
};

/// Reads a descriptor, whatever the bytes are: nothing in them makes it use more memory than some kilobytes for each
/// item. [main thread]
///
/// Ids: descriptor/truncated, descriptor/too_long, descriptor/unbalanced, descriptor/too_deep, descriptor/too_many,
/// descriptor/too_large, descriptor/report_id.
ReadDescriptor readDescriptor (std::span<const std::uint8_t>);

}   // namespace tactus::host::hid
