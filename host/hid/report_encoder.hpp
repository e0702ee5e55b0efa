// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host::hid
{

class ReportDecoder;

/// Values into bytes: clamped to what a field may hold, with counters and checksums. Nothing allocates or throws after
/// construction.
class ReportEncoder
{
public:
    /// The decoder gives what output reports echo; it has to live as long.
    ReportEncoder (std::shared_ptr<const Profile>, const ReportDecoder&);

    /// The n-th output report as the device sees it, with a leading 0 where it has no id. A value that is not finite
    /// leaves its field as it is in the neutral report. Samples are frame by frame, -1…1.
    std::span<const std::uint8_t> encode (std::size_t report, const std::array<double, most_efforts>& values, std::span<const float> samples,
                                          const ReportDecoder&) noexcept;
    std::span<const std::uint8_t> neutral (std::size_t report) noexcept;

    const std::vector<std::string>& effortNames() const noexcept { return names; }
    const std::vector<std::string>& effortUnits() const noexcept { return units; }

    /// What each effort is in the neutral report.
    const std::array<double, most_efforts>& restEfforts() const noexcept { return rest; }

    /// -1 if there is no such effort.
    int effort (std::string_view name) const noexcept;

    void reset();

private:
    struct Field
    {
        const OutputField* field = nullptr;
        int index = -1;   // of the effort, or of the axis that is echoed
        std::uint32_t neutral = 0;
    };

    struct Report
    {
        const OutputReport* report = nullptr;
        std::vector<Field> fields;
        Bytes wire;   // what was made last
        unsigned count = 0;
    };

    std::span<std::uint8_t> begin (Report&, const Bytes& from) noexcept;
    void finish (Report&, std::span<std::uint8_t> body) noexcept;

    std::shared_ptr<const Profile> profile;
    std::vector<Report> reports;
    std::vector<std::string> names, units;
    std::array<double, most_efforts> rest {};
};

}   // namespace tactus::host::hid
