// SPDX-License-Identifier: MIT
#include "number_reader.hpp"

#include <tactus/text/quote.hpp>

#include <charconv>
#include <cmath>

namespace tactus::host::hid
{
namespace
{
constexpr double largest_scale = 1e15;   // in SI units; small enough that no count overflows

/// Parses "u8", "s16le", "u32be", "f32le", and "u3" … "s31" for bit fields that start at the lowest bit.
bool readType (std::string_view type, Bits& bits)
{
    if (type.empty()) return false;
    bits.is_float = type.front() == 'f';
    bits.is_signed = type.front() == 's';
    if (! bits.is_float && ! bits.is_signed && type.front() != 'u') return false;

    const char* const end = type.data() + type.size();
    const auto [stop, failed] = std::from_chars (type.data() + 1, end, bits.size);
    const std::string_view order (stop, static_cast<std::size_t> (end - stop));
    bits.big_endian = order == "be";
    const bool whole = bits.size == 8 || bits.size == 16 || bits.size == 24 || bits.size == 32;
    return failed == std::errc() && bits.size >= 1 && bits.size <= 32
           && (order.empty() || ((order == "le" || bits.big_endian) && whole))
           && (! bits.is_float || (bits.size == 32 && ! order.empty()));
}

/// The unit of a scale, or the key "unit" if the scale is a bare number.
std::string readUnit (ProfileFields& in, const std::string& of_scale)
{
    const auto written = in.text ("unit");
    if (! of_scale.empty() && ! written.empty())
        in.error ("unit", "profile/unit", "the unit is given twice", "leave \"unit\" out: it is " + of_scale);
    if (! of_scale.empty()) return of_scale;
    return written.empty() ? "1" : written;
}
}   // namespace

Bits readBits (ProfileFields& in)
{
    Bits bits;
    in.require ("at", "write \"at\": the index of the number's first byte");
    in.require ("type", "write the number's \"type\", such as \"s16le\"");
    const auto byte = in.whole ("at", 0, most_bytes - 1, 0);
    const auto bit = in.whole ("bit", 0, 7, 0);
    const auto type = in.text ("type");
    if (! type.empty() && ! readType (type, bits))
    {
        in.error ("type", "profile/type", quote (type) + " is not a type",
                  "write u8, s8, u16le, s16be, u32le, f32le …, or u1 … u32 and s1 … s32 for bits");
        bits = {};
    }
    bits.at = static_cast<std::size_t> (8 * byte + bit);
    if (bits.big_endian && bit != 0) in.error ("bit", "profile/type", "a big-endian number must start at a byte", "leave \"bit\" out");
    return bits;
}

double readOffset (ProfileFields& in, const std::string& unit)
{
    const auto offset = in.scale ("offset", 0.0);
    if (! (std::abs (offset.value) <= largest_scale))
        in.error ("offset", "profile/out_of_range", "the offset is too large", "write the value of count 0, in SI units");
    if (! offset.unit.empty() && offset.unit != unit)
        in.error ("offset", "profile/unit", "the offset is in " + offset.unit + ", but the scale is in " + unit, "write both in the same unit");
    return offset.value;
}

double readScale (ProfileFields& in, std::string& unit)
{
    const auto scale = in.scale ("scale", 1.0);
    if (! (std::abs (scale.value) >= 1.0 / largest_scale && std::abs (scale.value) <= largest_scale))
        in.error ("scale", "profile/out_of_range", "the scale is out of range", "write the value of one count, in SI units");
    unit = readUnit (in, scale.unit);
    return scale.value;
}

void readVerified (ProfileFields& in, bool& verified, std::string& why_not)
{
    in.require ("verified", "write \"verified\": true if this layout has decoded a report of a real device, else false");
    verified = in.flag ("verified");
    why_not = in.text ("why_not");
    if (! verified && why_not.empty())
        in.error ("why_not", "profile/missing", "a report that is not verified must say why", "write \"why_not\": \"…\"");
}

}   // namespace tactus::host::hid
