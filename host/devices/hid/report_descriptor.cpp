// SPDX-License-Identifier: MIT
#include "report_descriptor.hpp"

#include <tactus/text/message.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace tactus::host::hid
{
namespace
{
constexpr std::size_t longest = 65535;   // in bytes: the largest length that a HID class descriptor can give
constexpr std::size_t most_fields = 4096;
constexpr std::size_t most_collections = 1024;
constexpr std::size_t most_usages = 256;                           // the most usage ranges that one field may have
constexpr std::size_t deepest = 32;                                // the most levels of nested collections, and of pushed states
constexpr std::size_t largest_field = 256;                         // in bits; vendors declare opaque data as one large field
constexpr std::size_t largest_report = std::size_t { 8 } * 8192;   // in bits

struct Globals
{
    unsigned page = 0;
    std::int64_t logical_min = 0, logical_max = 0, physical_min = 0, physical_max = 0;
    std::uint32_t unit = 0;
    int unit_exponent = 0;
    std::size_t size = 0, count = 0;
    std::uint8_t report = 0;
};

/// A usage as written, with or without its page.
struct WrittenUsage
{
    std::uint32_t value = 0;
    bool has_page = false;
};

struct Locals
{
    std::vector<std::pair<WrittenUsage, WrittenUsage>> usages;
    std::optional<WrittenUsage> first;   // start of a range whose end has not been read yet
    bool delimited = false, chosen = false;
};

struct Item
{
    unsigned type = 0, tag = 0;
    std::size_t size = 0;   // size of the value in bytes
    std::uint32_t value = 0;

    std::int64_t asSigned() const noexcept
    {
        const auto v = static_cast<std::int64_t> (value);
        const auto range = std::int64_t { 1 } << (8 * size);
        return size > 0 && v >= range / 2 ? v - range : v;
    }
};

class Reader
{
public:
    explicit Reader (std::span<const std::uint8_t> b) : bytes (b) {}

    ReadDescriptor read()
    {
        if (bytes.size() > longest)
            fail ("descriptor/too_long", "the descriptor has " + std::to_string (bytes.size()) + " bytes",
                  "at most " + std::to_string (longest) + " are allowed");
        while (good && at < bytes.size())
        {
            start = at;
            if (const auto item = next()) take (*item);
        }
        if (good && ! open.empty()) fail ("descriptor/unbalanced", "a collection is not closed", "End Collection (0xC0) is missing");
        return std::move (result);
    }

private:
    void fail (std::string id, std::string text, std::string remedy)
    {
        good = false;
        result.messages.push_back (Message::error (std::move (id), "byte " + std::to_string (start), std::move (text), std::move (remedy)));
    }

    std::optional<Item> next()
    {
        const auto prefix = bytes[at++];
        if (prefix == 0xfe)   // a long item; the standard defines none
        {
            const std::size_t size = at < bytes.size() ? bytes[at] + 2u : 0u;
            if (size == 0 || bytes.size() - at < size)
                fail ("descriptor/truncated", "a long item extends beyond the end of the descriptor", "the descriptor was cut off");
            else
                at += size;
            return {};
        }

        Item item { .type = unsigned { prefix } >> 2 & 3u, .tag = unsigned { prefix } >> 4, .size = prefix & 3u };
        if (item.size == 3) item.size = 4;
        if (bytes.size() - at < item.size)
        {
            fail ("descriptor/truncated", "an item extends beyond the end of the descriptor", "the descriptor was cut off");
            return {};
        }
        for (std::size_t i = 0; i < item.size; ++i)
            item.value |= static_cast<std::uint32_t> (bytes[at++]) << 8 * i;
        return item;
    }

    void take (const Item& item)
    {
        if (item.type == 0) main (item);
        if (item.type == 1) global (item);
        if (item.type == 2) local (item);
    }

    void global (const Item& item)
    {
        switch (item.tag)
        {
        case 0x0:
            globals.page = item.value & 0xffffu;
            break;
        case 0x1:
            globals.logical_min = item.asSigned();
            break;
        case 0x2:   // a maximum below a non-negative minimum is meant as unsigned
            globals.logical_max = item.asSigned();
            if (globals.logical_min >= 0 && globals.logical_max < 0) globals.logical_max = item.value;
            break;
        case 0x3:
            globals.physical_min = item.asSigned();
            break;
        case 0x4:
            globals.physical_max = item.asSigned();
            if (globals.physical_min >= 0 && globals.physical_max < 0) globals.physical_max = item.value;
            break;
        case 0x5:
            globals.unit_exponent = static_cast<int> ((item.value & 15u) ^ 8u) - 8;   // the value is a signed 4-bit number
            break;
        case 0x6:
            globals.unit = item.value;
            break;
        case 0x7:
            if (item.value > largest_field)
                return fail ("descriptor/too_large", "a field has " + std::to_string (item.value) + " bits",
                             "at most " + std::to_string (largest_field) + " are allowed");
            globals.size = item.value;
            break;
        case 0x8:
            if (item.value == 0 || item.value > 255) return fail ("descriptor/report_id", "a report has the id " + std::to_string (item.value),
                                                                  "ids are 1 to 255");
            globals.report = static_cast<std::uint8_t> (item.value);
            result.descriptor.has_ids = true;
            break;
        case 0x9:
            if (item.value > largest_report)
                return fail ("descriptor/too_large", "an item declares " + std::to_string (item.value) + " adjacent fields",
                             "at most " + std::to_string (largest_report) + " are allowed");
            globals.count = item.value;
            break;
        case 0xa:
            if (pushed.size() >= deepest)
                return fail ("descriptor/too_deep", "too many states are pushed", "at most " + std::to_string (deepest) + " are allowed");
            pushed.push_back (globals);
            break;
        case 0xb:
            if (pushed.empty()) return fail ("descriptor/unbalanced", "a state is popped but none was pushed", "Push (0xA4) is missing");
            globals = pushed.back();
            pushed.pop_back();
            break;
        default:
            break;
        }
    }

    void local (const Item& item)
    {
        if (item.tag == 0xa)   // the first of a set of alternative usages is the preferred one
        {
            locals.delimited = item.value == 1;
            locals.chosen = false;
            return;
        }
        if (item.tag > 0x2 || (locals.delimited && locals.chosen)) return;

        const WrittenUsage usage { item.value, item.size == 4 };
        if (item.tag == 0x1)
            locals.first = usage;
        else if (locals.usages.size() >= most_usages)
            return fail ("descriptor/too_many", "a field has too many usages", "at most " + std::to_string (most_usages) + " are allowed");
        else
        {
            locals.usages.emplace_back (item.tag == 0x2 ? locals.first.value_or (usage) : usage, usage);
            locals.chosen = true;
        }
    }

    Usage whole (const WrittenUsage& usage) const noexcept { return usage.has_page ? usage.value : usageOf (globals.page, usage.value & 0xffffu); }

    void main (const Item& item)
    {
        if (item.tag == 0x8) field (DescribedField::Kind::input, item);
        if (item.tag == 0x9) field (DescribedField::Kind::output, item);
        if (item.tag == 0xb) field (DescribedField::Kind::feature, item);
        if (item.tag == 0xa) collection (item);
        if (item.tag == 0xc)
        {
            if (open.empty()) return fail ("descriptor/unbalanced", "a collection ends but none is open", "Collection (0xA1) is missing");
            open.pop_back();
        }
        locals = {};
    }

    void collection (const Item& item)
    {
        auto& all = result.descriptor.collections;
        if (open.size() >= deepest)
            return fail ("descriptor/too_deep", "collections are nested too deeply", "at most " + std::to_string (deepest) + " are allowed");
        if (all.size() >= most_collections)
            return fail ("descriptor/too_many", "there are too many collections", "at most " + std::to_string (most_collections) + " are allowed");
        all.push_back ({ .usage = locals.usages.empty() ? 0 : whole (locals.usages.front().first),
                         .kind = static_cast<int> (item.value & 0xffu),
                         .parent = open.empty() ? -1 : open.back() });
        open.push_back (static_cast<int> (all.size()) - 1);
    }

    void field (DescribedField::Kind kind, const Item& item)
    {
        auto& all = result.descriptor.fields;
        if (globals.size == 0 || globals.count == 0) return;
        if (all.size() >= most_fields)
            return fail ("descriptor/too_many", "there are too many fields", "at most " + std::to_string (most_fields) + " are allowed");

        auto& end = ends[{ kind, globals.report }];
        const auto bits = globals.size * globals.count;
        if (end + bits > largest_report)
            return fail ("descriptor/too_large", "a report is longer than " + std::to_string (largest_report / 8) + " bytes", "shorten it");

        DescribedField f;
        f.kind = kind;
        f.report = globals.report;
        f.bit = end;
        f.size = globals.size;
        f.count = globals.count;
        f.constant = (item.value & 1u) != 0;
        f.variable = (item.value & 2u) != 0;
        f.relative = (item.value & 4u) != 0;
        f.logical_min = globals.logical_min;
        f.logical_max = globals.logical_max;
        f.physical_min = globals.physical_min;
        f.physical_max = globals.physical_max;
        f.unit = globals.unit;
        f.unit_exponent = globals.unit_exponent;
        f.collection = open.empty() ? -1 : open.back();
        for (const auto& [first, last] : locals.usages)
            if (whole (first) <= whole (last)) f.usages.push_back ({ whole (first), whole (last) });
        all.push_back (std::move (f));
        end += bits;
    }

    std::span<const std::uint8_t> bytes;
    std::size_t at = 0, start = 0;
    bool good = true;
    ReadDescriptor result;
    Globals globals;
    Locals locals;
    std::vector<Globals> pushed;
    std::vector<int> open;
    std::map<std::pair<DescribedField::Kind, std::uint8_t>, std::size_t> ends;   // the bits used so far, per report
};
}   // namespace

std::optional<Usage> DescribedField::usage (std::size_t n) const noexcept
{
    for (const auto& range : usages)
    {
        const std::size_t many = std::size_t { range.last - range.first } + 1;
        if (n < many) return range.first + static_cast<Usage> (n);
        n -= many;
    }
    if (usages.empty()) return {};
    return usages.back().last;
}

std::optional<std::size_t> DescribedField::placeOf (Usage wanted) const noexcept
{
    std::size_t before = 0;
    for (const auto& range : usages)
    {
        if (wanted >= range.first && wanted <= range.last) return before + (wanted - range.first);
        before += std::size_t { range.last - range.first } + 1;
    }
    return {};
}

std::size_t ReportDescriptor::length (DescribedField::Kind kind, std::uint8_t report) const noexcept
{
    std::size_t bits = 0;
    for (const auto& f : fields)
        if (f.kind == kind && f.report == report) bits = std::max (bits, f.bit + f.size * f.count);
    return (bits + 7) / 8;
}

bool ReportDescriptor::lies (int collection, Usage within) const noexcept
{
    for (int c = collection; c >= 0; c = collections[static_cast<std::size_t> (c)].parent)
        if (collections[static_cast<std::size_t> (c)].usage == within) return true;
    return false;
}

ReadDescriptor readDescriptor (std::span<const std::uint8_t> bytes) { return Reader (bytes).read(); }

}   // namespace tactus::host::hid
