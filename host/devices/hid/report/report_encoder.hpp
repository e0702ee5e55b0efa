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

class ReportDecoder;

/// A finite value after its law and its scale are applied: the number to write, before it is rounded and limited to the bits of its field.
double encoded (const Encoding&, double value) noexcept;

/// The value that a number in a report stands for. Where a law gives several values the same number, one of them.
double decoded (const Encoding&, double number) noexcept;

/// Encodes values into bytes: clamped to the range of each field, with counters and checksums. Never allocates or throws
/// after construction.
class ReportEncoder
{
public:
    /// The decoder provides the values that output reports echo; it must outlive the encoder.
    ReportEncoder (std::shared_ptr<const Profile>, const ReportDecoder&);

    /// The n-th output report as it is sent to the device, with a leading 0 if it has no id. A field stays neutral if its
    /// value is not finite. Samples are interleaved, -1…1.
    std::span<const std::uint8_t> encode (std::size_t report, const std::array<double, most_efforts>& values, std::span<const float> samples,
                                          const ReportDecoder&) noexcept;
    std::span<const std::uint8_t> neutral (std::size_t report) noexcept;

    const std::vector<std::string>& effortNames() const noexcept { return names; }
    const std::vector<std::string>& effortUnits() const noexcept { return units; }

    /// The value of each effort in the neutral report.
    const std::array<double, most_efforts>& restEfforts() const noexcept { return rest; }

    /// The index of an effort; -1 if there is none.
    int effort (std::string_view name) const noexcept;

    void reset();

private:
    struct Field
    {
        const OutputField* field = nullptr;
        int index = -1;   // index of the effort, or of the echoed axis
        std::uint32_t neutral = 0;
    };

    struct Report
    {
        const OutputReport* report = nullptr;
        std::vector<Field> fields;
        Bytes wire;   // the latest encoded report
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
