// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/profile.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host::hid
{

/// The reason why a report was refused.
enum class Refusal
{
    none,
    too_short,
    too_long,
    unknown_id,
    wrong_mark,   ///< a field with a required value has a different value
    not_finite
};

inline constexpr std::size_t refusals = 6;

/// Describes a refusal, as in "too short".
std::string_view describe (Refusal) noexcept;

/// The order of a report and the previous report with the same id, judged by its sequence number and the device's clock.
enum class ReportOrder
{
    next,
    repeated,        ///< the same number again
    clock_stopped,   ///< another number, but the same time again
    back             ///< the number or the time is an earlier one: the device has restarted, or the report is late
};

/// Decodes bytes into values. Of several reports with the same id, the first whose required values are there is meant, else the last.
/// Unwraps counters, counts lost reports, and converts device clocks to seconds since the first
/// report. A refused report changes no value. Never allocates or throws after construction.
class ReportDecoder
{
public:
    struct Counts
    {
        std::uint64_t taken = 0;
        std::uint64_t lost = 0;                           ///< lost reports, as counted from sequence numbers
        std::uint64_t restarts = 0;                       ///< sequence numbers that went backwards, or forwards by more than half their range
        std::array<std::uint64_t, refusals> refused {};   ///< refused reports, indexed by Refusal
    };

    explicit ReportDecoder (std::shared_ptr<const Profile>);

    Refusal decode (std::span<const std::uint8_t> report) noexcept;

    const std::array<double, most_axes>& axes() const noexcept { return values; }
    std::uint32_t buttons() const noexcept { return pressed; }
    double time() const noexcept { return clock; }
    std::uint32_t lostBefore() const noexcept { return gap; }
    ReportOrder reportOrder() const noexcept { return order; }
    const Counts& counts() const noexcept { return tally; }
    bool hasTime() const noexcept { return has_time; }

    /// The raw value of an axis in the latest report that contains it.
    std::uint32_t raw (std::size_t axis) const noexcept { return raws[axis]; }

    const std::vector<std::string>& axisNames() const noexcept { return names; }
    const std::vector<std::string>& axisUnits() const noexcept { return units; }
    const std::vector<std::string>& buttonNames() const noexcept { return button_names; }

    /// The index of an axis; -1 if there is none.
    int axis (std::string_view name) const noexcept;

    void reset();

private:
    struct Counter
    {
        bool started = false;
        std::uint32_t raw = 0;
        double total = 0.0;   // the unwrapped value, in raw units
    };

    struct Field
    {
        const InputField* field = nullptr;
        int axis = -1;
        std::vector<std::uint32_t> masks;   // one per bit of the buttons; for a hat, one per direction
        std::uint32_t all = 0;              // all masks combined
        Counter counter;
    };

    struct Report
    {
        const InputReport* report = nullptr;
        std::vector<Field> fields;
        int timestamp = -1, sequence = -1;     // indices of fields
        bool counted = false, timed = false;   // true after the first report with a sequence number, or with a timestamp
        std::uint32_t count = 0;
        double first_time = 0.0, last_time = 0.0;
    };

    Report* find (std::span<const std::uint8_t>) noexcept;
    static bool hasMarks (const Report&, std::span<const std::uint8_t>) noexcept;
    Refusal check (const Report&, std::span<const std::uint8_t>) const noexcept;
    void takeAxis (Field&, std::uint32_t raw) noexcept;
    void takeButtons (const Field&, std::uint32_t raw) noexcept;
    void follow (Report&, std::uint32_t raw, std::size_t bits) noexcept;
    void keepTime (Report&) noexcept;

    std::shared_ptr<const Profile> profile;
    std::vector<Report> reports;
    std::vector<std::string> names, units, button_names;
    std::array<double, most_axes> values {};
    std::array<std::uint32_t, most_axes> raws {};
    std::uint32_t pressed = 0;
    double clock = 0.0;
    std::uint32_t gap = 0;
    ReportOrder order = ReportOrder::next;
    bool has_time = false;
    Counts tally;
};

}   // namespace tactus::host::hid
