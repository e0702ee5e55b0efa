// SPDX-License-Identifier: MIT
#include "log_lines.hpp"
#include "log_number.hpp"

#include <tactus/text/budget.hpp>
#include <tactus/text/json_text.hpp>

#include <bit>
#include <iterator>
#include <span>

namespace tactus
{

namespace
{
constexpr std::size_t channel_count = std::size (channel_fields), field_count = std::size (reading_fields) + channel_count;
constexpr auto most_channels = static_cast<std::size_t> (Channels::most);
constexpr std::size_t numbers_of_role = reading_size + channel_count * most_channels;
constexpr std::size_t most_roles = 20'000;   // far more than the budget of roles

enum Parts : unsigned
{
    has_passed = 1,
    has_rest = 2,
    has_read = 4,
    has_feed = 8
};

std::string listOf (std::span<const double> numbers)
{
    std::string text;
    for (const double v : numbers)
        text += (text.empty() ? "[" : ",") + logNumber (v);
    return text.empty() ? "[]" : text + "]";
}

std::string textOf (const ChangedReading& changed)
{
    std::string text;
    const auto add = [&] (std::string_view key, const std::string& value) { text += (text.empty() ? "\"" : ",\"") + std::string (key) + "\":" + value; };
    for (std::size_t i = 0; i < std::size (reading_fields); ++i)
        if (const auto& [key, first, size] = reading_fields[i]; (changed.fields >> i & 1u) != 0)
            add (key, size == 1 ? logNumber (changed.reading.numbers[first]) : listOf (std::span (changed.reading.numbers).subspan (first, size)));
    for (std::size_t i = 0; i < channel_count; ++i)
        if ((changed.fields >> (std::size (reading_fields) + i) & 1u) != 0)
            add (channel_fields[i].key, listOf (valuesOf (changed.reading.*channel_fields[i].value)));
    return Json (changed.role).dump() + ":{" + text + "}";
}

/// A whole number in bytes of seven bits, the lowest first.
void putWhole (std::string& to, std::uint64_t v)
{
    for (; v >= 0x80; v >>= 7u)
        to += static_cast<char> (0x80 | (v & 0x7f));
    to += static_cast<char> (v);
}

bool takeWhole (std::string_view& from, std::uint64_t& v)
{
    v = 0;
    for (unsigned shift = 0; shift < 64 && ! from.empty(); shift += 7)
    {
        const auto byte = static_cast<unsigned char> (from.front());
        from.remove_prefix (1);
        v |= static_cast<std::uint64_t> (byte & 0x7fu) << shift;
        if (byte < 0x80) return true;
    }
    return false;
}

bool takeText (std::string_view& from, std::string& to)
{
    std::uint64_t size = 0;
    if (! takeWhole (from, size) || size > from.size()) return false;
    to = from.substr (0, size);
    from.remove_prefix (size);
    return true;
}

/// Sets a reading from a packed line. False if it is not packed as it should be.
bool takeReading (std::string_view& from, PackedState& state, ChangedReading& to)
{
    std::uint64_t role = 0, fields = 0;
    if (! takeWhole (from, role) || role > state.roles.size() || role >= most_roles) return false;
    if (role == state.roles.size())
    {
        std::string name;
        if (! takeText (from, name) || state.roleNumber (name) != role) return false;
    }
    if (! takeWhole (from, fields) || fields >> field_count != 0) return false;
    to.role = state.roles[role];
    to.fields = static_cast<std::uint32_t> (fields);
    auto& values = state.values[role];
    for (std::size_t i = 0; i < std::size (reading_fields); ++i)
        for (std::size_t k = 0; (fields >> i & 1u) != 0 && k < reading_fields[i].size; ++k)
            if (! values[reading_fields[i].first + k].take (from, to.reading.numbers[reading_fields[i].first + k])) return false;
    for (std::size_t i = 0; i < channel_count; ++i)
    {
        if ((fields >> (std::size (reading_fields) + i) & 1u) == 0) continue;
        std::uint64_t size = 0;
        if (! takeWhole (from, size) || size > most_channels) return false;
        for (std::size_t k = 0; k < size; ++k)
        {
            double v = 0.0;
            if (! values[reading_size + i * most_channels + k].take (from, v)) return false;
            (to.reading.*channel_fields[i].value).set (static_cast<int> (k), v);
        }
    }
    return true;
}

/// Reads a packed line. False if it is not packed as it should be.
bool unpack (std::string_view from, PackedState& state, LogLine& to)
{
    std::uint64_t parts = 0, count = 0;
    if (! takeWhole (from, to.tick) || ! takeWhole (from, parts)) return false;
    if ((parts & has_passed) != 0 && ! state.passed.take (from, to.passed.emplace())) return false;
    if ((parts & has_rest) != 0 && ! takeText (from, to.rest)) return false;
    if ((parts & has_read) != 0)
    {
        if (! takeWhole (from, count) || count > most_roles) return false;   // a reading takes two bytes at least, and far more memory
        for (std::uint64_t i = 0; i < count; ++i)
            if (! takeReading (from, state, to.read.emplace_back())) return false;
    }
    if ((parts & has_feed) != 0)
    {
        if (! takeWhole (from, count) || count > from.size() || static_cast<double> (count) > budgets().values) return false;
        to.feed.emplace (count);
        if (state.feed.size() < count) state.feed.resize (count);
        for (std::uint64_t i = 0; i < count; ++i)
            if (! state.feed[i].take (from, (*to.feed)[i])) return false;
    }
    return from.empty() && parts < std::size_t { 2 } * has_feed;
}
}   // namespace

std::string textOf (const LogLine& line)
{
    auto text = "{\"tick\":" + std::to_string (line.tick);
    if (line.passed) text += ",\"passed\":" + logNumber (*line.passed);
    text += line.rest;
    std::string read;
    for (const auto& changed : line.read)
        read += (read.empty() ? "" : ",") + textOf (changed);
    if (! read.empty()) text += ",\"read\":{" + read + "}";
    if (line.feed) text += ",\"feed\":" + listOf (*line.feed);
    return text + "}";
}

std::uint64_t Predicted::next (std::uint64_t bits) noexcept
{
    before = last;
    return last = bits;
}

void Predicted::put (std::string& to, double v)
{
    const auto bits = std::bit_cast<std::uint64_t> (v);
    const auto away = bits - expected();
    auto left = (away << 1u) ^ (0 - (away >> 63u));   // a small number, whether it is before or after what was expected
    const auto size = to.size();
    to += '\0';
    for (; left != 0; left >>= 8u)
        to += static_cast<char> (left & 0xffu);
    to[size] = static_cast<char> (to.size() - size - 1);
    next (bits);
}

bool Predicted::take (std::string_view& from, double& to)
{
    if (from.empty()) return false;
    const auto size = static_cast<std::size_t> (static_cast<unsigned char> (from.front()));
    from.remove_prefix (1);
    if (size > 8 || size > from.size()) return false;
    std::uint64_t left = 0;
    for (std::size_t i = size; i > 0; --i)
        left = left << 8u | static_cast<unsigned char> (from[i - 1]);
    from.remove_prefix (size);
    to = std::bit_cast<double> (next (expected() + ((left >> 1u) ^ (0 - (left & 1u)))));
    return true;
}

std::size_t PackedState::roleNumber (std::string_view role)
{
    if (const auto known = numbers.find (role); known != numbers.end()) return known->second;
    numbers.emplace (role, roles.size());
    roles.emplace_back (role);
    values.emplace_back (numbers_of_role);
    return roles.size() - 1;
}

std::string LogPacker::pack (const LogLine& line)
{
    std::string text;
    putWhole (text, line.tick);
    putWhole (text, (line.passed ? has_passed : 0u) | (line.rest.empty() ? 0u : has_rest) | (line.read.empty() ? 0u : has_read) | (line.feed ? has_feed : 0u));
    if (line.passed) state.passed.put (text, *line.passed);
    if (! line.rest.empty())
    {
        putWhole (text, line.rest.size());
        text += line.rest;
    }
    if (! line.read.empty()) putWhole (text, line.read.size());
    for (const auto& changed : line.read)
    {
        const auto known = state.roles.size();
        const auto role = state.roleNumber (changed.role);
        putWhole (text, role);
        if (role == known)
        {
            putWhole (text, changed.role.size());
            text += changed.role;
        }
        putWhole (text, changed.fields);
        auto& values = state.values[role];
        for (std::size_t i = 0; i < std::size (reading_fields); ++i)
            for (std::size_t k = 0; (changed.fields >> i & 1u) != 0 && k < reading_fields[i].size; ++k)
                values[reading_fields[i].first + k].put (text, changed.reading.numbers[reading_fields[i].first + k]);
        for (std::size_t i = 0; i < channel_count; ++i)
        {
            if ((changed.fields >> (std::size (reading_fields) + i) & 1u) == 0) continue;
            const auto channels = valuesOf (changed.reading.*channel_fields[i].value);
            putWhole (text, channels.size());
            for (std::size_t k = 0; k < channels.size(); ++k)
                values[reading_size + i * most_channels + k].put (text, channels[k]);
        }
    }
    if (line.feed)
    {
        putWhole (text, line.feed->size());
        if (state.feed.size() < line.feed->size()) state.feed.resize (line.feed->size());
        for (std::size_t i = 0; i < line.feed->size(); ++i)
            state.feed[i].put (text, (*line.feed)[i]);
    }
    std::string size;
    putWhole (size, text.size());
    return size + text;
}

std::optional<std::string> LogLines::next()
{
    if (has_head) return is_packed ? packedLine() : textLine();
    has_head = true;
    auto head = textLine();
    if (head && head->find ("\"packed\"") != head->npos)
    {
        const auto json = readJson (*head);
        is_packed = json.root.is_object() && json.root.value ("packed", Json()) == Json (true);
    }
    return head;
}

std::optional<std::string> LogLines::textLine()
{
    const double longest = budgets().file;   // readJson refuses more
    std::string text;
    for (int c = in->get(); c != std::istream::traits_type::eof() && static_cast<double> (text.size()) <= longest; c = in->get())
    {
        if (c == '\n') return text;
        text += static_cast<char> (c);
    }
    return std::nullopt;
}

std::optional<std::string> LogLines::packedLine()
{
    std::uint64_t size = 0;
    unsigned shift = 0;
    for (int c = in->get();; c = in->get(), shift += 7)
    {
        if (c == std::istream::traits_type::eof() || shift > 35) return std::nullopt;
        size |= (static_cast<std::uint64_t> (c) & 0x7fu) << shift;
        if ((c & 0x80) == 0) break;
    }
    if (static_cast<double> (size) > budgets().file) return std::nullopt;
    std::string bytes;
    for (std::uint64_t i = 0; i < size; ++i)   // grows with what is really there
    {
        const int c = in->get();
        if (c == std::istream::traits_type::eof()) return std::nullopt;
        bytes += static_cast<char> (c);
    }
    LogLine line;
    if (unpack (bytes, state, line)) return textOf (line);
    is_damaged = true;
    return std::nullopt;
}

}   // namespace tactus
