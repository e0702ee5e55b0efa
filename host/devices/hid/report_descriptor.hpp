// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/message.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The report descriptor of a HID device (Device Class Definition for HID 1.11, section 6.2.2).
namespace tactus::host::hid
{

/// A usage with its page in the upper 16 bits: 0x00010030 is X.
using Usage = std::uint32_t;

constexpr Usage usageOf (unsigned page, unsigned id) noexcept { return page << 16 | id; }

struct DescribedCollection
{
    Usage usage = 0;
    int kind = 0;      ///< 0 physical, 1 application, 2 logical …
    int parent = -1;   ///< index of the enclosing collection; -1 for the outermost
};

/// One or more numbers of the same size, adjacent in a report.
struct DescribedField
{
    enum class Kind
    {
        input,
        output,
        feature
    };

    Kind kind = Kind::input;
    std::uint8_t report = 0;   ///< id of the report; 0 if the device uses no ids
    std::size_t bit = 0;       ///< offset within the data of the report, without the id
    std::size_t size = 0;      ///< size of each number in bits
    std::size_t count = 0;
    bool constant = false;   ///< true for padding
    bool variable = false;   ///< each number has its own usage; else each number is the index of a usage
    bool relative = false;
    std::int64_t logical_min = 0, logical_max = 0;
    std::int64_t physical_min = 0, physical_max = 0;   ///< both 0: the same as the logical limits
    std::uint32_t unit = 0;
    int unit_exponent = 0;   ///< power of 10
    int collection = -1;     ///< index of the collection

    struct Range
    {
        Usage first = 0, last = 0;
    };
    std::vector<Range> usages;

    /// The usage of the n-th number; the last usage applies to all further numbers. Empty if there is none.
    std::optional<Usage> usage (std::size_t n) const noexcept;

    /// The index of a usage among the usages of this field; empty if the field does not have it.
    std::optional<std::size_t> placeOf (Usage) const noexcept;
};

struct ReportDescriptor
{
    std::vector<DescribedCollection> collections;
    std::vector<DescribedField> fields;
    bool has_ids = false;

    /// The size of a report in bytes, without the id; 0 if there is no such report.
    std::size_t length (DescribedField::Kind, std::uint8_t report) const noexcept;

    /// True if a collection has this usage or is inside one that has it.
    bool lies (int collection, Usage within) const noexcept;
};

struct ReadDescriptor
{
    ReportDescriptor descriptor;   ///< what could be read; reliable only if there are no errors
    Messages messages;             ///< `where` is the byte, as "byte 17"
};

/// Reads a descriptor. Accepts any bytes: each item needs at most a few kilobytes of memory. [main thread]
///
/// Ids: descriptor/truncated, descriptor/too_long, descriptor/unbalanced, descriptor/too_deep, descriptor/too_many,
/// descriptor/too_large, descriptor/report_id.
ReadDescriptor readDescriptor (std::span<const std::uint8_t>);

}   // namespace tactus::host::hid
