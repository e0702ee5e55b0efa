// SPDX-License-Identifier: MIT
#pragma once

#include "reading_fields.hpp"

#include <cstdint>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// A reading of which some fields have changed.
struct ChangedReading
{
    std::string role;
    std::uint32_t fields = 0;   ///< bits: reading_fields in their order, then channel_fields
    LoggedReading reading;
};

/// The inputs of a tick, as a line of a log tells them. The common ones are numbers; all others are text.
struct LogLine
{
    std::uint64_t tick = 0;
    std::optional<double> passed {};
    std::string rest {};   ///< other members of the JSON object, each after a comma
    std::vector<ChangedReading> read {};
    std::optional<std::vector<double>> feed {};

    bool isEmpty() const noexcept { return ! passed && rest.empty() && read.empty() && ! feed; }
};

/// The line as JSON, without a line break.
std::string textOf (const LogLine&);

/// Numbers that are written as their distance from what the two before them suggest. Smooth movements take few bytes, and all bits are kept.
class Predicted
{
public:
    void put (std::string& to, double);

    /// Reads a number from the front of `from`. False if there is none.
    bool take (std::string_view& from, double& to);

private:
    std::uint64_t last = 0, before = 0;   // bits of doubles
    std::uint64_t next (std::uint64_t bits) noexcept;
    std::uint64_t expected() const noexcept { return 2 * last - before; }
};

/// The memory that both ends of a packed log share: the last numbers by role and place, and the numbers of the roles.
struct PackedState
{
    std::map<std::string, std::size_t, std::less<>> numbers;   ///< of roles, in the order in which they appeared
    std::vector<std::string> roles;
    std::vector<std::vector<Predicted>> values;   ///< by role: the numbers of a reading, then axes, then signals
    std::vector<Predicted> feed;
    Predicted passed;

    std::size_t roleNumber (std::string_view role);   ///< gives a new role a number
};

/// Packs the lines of a log: docs/replay.md describes the format.
class LogPacker
{
public:
    std::string pack (const LogLine&);

private:
    PackedState state;
};

/// The lines of a log as text, whether it is packed or not. Accepts any bytes. [main thread]
class LogLines
{
public:
    LogLines() = default;
    explicit LogLines (std::unique_ptr<std::istream> from) : in (std::move (from)) {}

    /// The next complete line; empty if there is none, if it breaks off, if it is longer than any line of a log can be, or if it is not packed as it
    /// should be.
    std::optional<std::string> next();

    /// True if the last call of next() met bytes that are not packed as they should be.
    bool isDamaged() const noexcept { return is_damaged; }

private:
    std::optional<std::string> textLine();
    std::optional<std::string> packedLine();

    std::unique_ptr<std::istream> in;
    bool has_head = false, is_packed = false, is_damaged = false;
    PackedState state;
};

/// The ending of the name of a packed log.
inline constexpr std::string_view packed_log = ".tlog";

}   // namespace tactus
