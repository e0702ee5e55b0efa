// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/rotation.hpp>
#include <tactus/run/device/device_numbers.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/text/message.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// The content of a device profile (host/devices/profiles/*.json) as plain data; docs/devices.md explains how to write one. Bytes
/// of reports are counted from the first byte: the report id if there is one, else the first data byte.
namespace tactus::host::hid
{

inline constexpr std::size_t most_axes = 32;      ///< input values of a device, in all reports together
inline constexpr std::size_t most_efforts = 16;   ///< output values of a device
inline constexpr std::size_t most_channels = 4;   ///< channels of a stream of samples
inline constexpr std::size_t longest_report = 1024;
inline constexpr std::size_t most_blocks = 2;   ///< numbers that a device may return in its init steps

using Bytes = std::vector<std::uint8_t>;

enum class Bus
{
    unknown,
    usb,
    bluetooth
};

/// Selects devices. Missing entries match everything. Strings are compared case-insensitively.
struct MatchRule
{
    std::vector<std::uint16_t> vid, pid;
    std::optional<std::uint16_t> usage_page, usage;
    std::optional<int> interface_number;
    std::optional<Bus> bus;
    std::string product;   ///< a part of the device's product name

    bool operator== (const MatchRule&) const = default;
};

/// The place of a number within a report.
struct Bits
{
    std::size_t at = 0;     ///< offset from the start of the report in bits; the lowest bit of a byte comes first
    std::size_t size = 8;   ///< 1…32
    bool is_signed = false;
    bool big_endian = false;   ///< allowed only for whole bytes
    bool is_float = false;     ///< IEEE 754, 32 bits

    std::size_t end() const noexcept { return at + size; }

    bool operator== (const Bits&) const = default;
};

/// The expected answer to a feature report that requests a number from the device, such as the block of a new effect.
struct Answer
{
    /// A value that may occur in the answer, and the error that it stands for.
    struct Mark
    {
        Bits bits;
        std::uint32_t raw = 1;
        Message means {};   ///< `where` is empty

        bool operator== (const Mark& other) const { return bits == other.bits && raw == other.raw && describe (means) == describe (other.means); }
    };

    std::optional<std::uint8_t> id;        ///< report id
    Bits number;                           ///< where the requested number is; the number 0 means that there is none yet
    std::optional<Mark> success;           ///< a value without which the answer is ignored; empty: not needed
    std::vector<Mark> refusals;            ///< values that mean a refusal: asking again is pointless
    double patience = 0.5, pause = 0.01;   ///< how long to keep asking, and the pause between requests, in s

    bool operator== (const Answer&) const = default;
};

/// One init or exit step of a device.
struct Step
{
    enum class Kind
    {
        output,
        feature,
        get_feature   ///< reads the feature report whose id is the first byte; some devices require such a read
    };

    Kind kind = Kind::output;
    Bytes bytes;
    double delay = 0.0;                ///< pause after the step, in s
    std::string about {};              ///< its purpose, as in "the report that creates an effect"; may be empty
    std::optional<Answer> answer {};   ///< expected answer to a get_feature; empty: any answer. Its number is inserted at `given` of later reports
    std::optional<Bits> given {};
    std::size_t block = 0;   ///< which of the numbers, if the device returns several

    bool operator== (const Step&) const = default;
};

/// An input value: value = raw scale + offset.
struct InputField
{
    std::string name;
    Bits bits;
    double scale = 1.0, offset = 0.0;
    std::string unit = "1";
    bool unwrap = false;                ///< for a counter that wraps around: its value continues past the wrap
    std::optional<double> expect;       ///< required raw value: a report with any other value is refused
    std::vector<std::string> buttons;   ///< one per bit, lowest first; "" for bits without a button
    bool is_hat = false;                ///< true if the value is 0 (up) … 7 (up and left), clockwise; the buttons are up, right, down, left

    bool isAxis() const noexcept { return buttons.empty() && ! expect; }

    bool operator== (const InputField&) const = default;
};

struct InputReport
{
    std::optional<std::uint8_t> id;
    std::size_t length = 0;    ///< in bytes; a shorter report is refused
    std::size_t longest = 0;   ///< in bytes; a longer report is refused
    std::vector<InputField> fields;
    std::string timestamp;   ///< the field with the device's time in s; may be empty
    std::string sequence;    ///< the field that counts reports; may be empty
    bool verified = false;   ///< true if checked against a report from a real device
    std::string why_not;     ///< why it was not verified, if it was not

    bool operator== (const InputReport&) const = default;
};

/// raw = round (value/scale - offset/scale), after the value has passed through a law.
struct Encoding
{
    enum class Law
    {
        linear,
        log2,   ///< law = steps log2 (value/reference); values of 0 and below give the smallest raw value
        table   ///< linear interpolation, clamped at the ends
    };

    Law law = Law::linear;
    double steps = 1.0, reference = 1.0;
    std::vector<double> x, y;
    double scale = 1.0, offset = 0.0;   ///< applied to the law's result: raw = round ((law - offset)/scale)

    bool operator== (const Encoding&) const = default;
};

/// A field of an output report.
struct OutputField
{
    enum class Source
    {
        effort,   ///< the effort that has the field's name
        enable,   ///< 1 while the device is driven, else the value in the neutral report
        echo      ///< the latest raw value of the input field of this name
    };

    std::string name;
    Source source = Source::effort;
    Bits bits;
    Encoding encoding;
    double min = -std::numeric_limits<double>::infinity();   ///< lower limit of the value; the bits limit it too
    double max = std::numeric_limits<double>::infinity();
    std::string unit = "1";

    bool operator== (const OutputField&) const = default;
};

/// True for the unit of an effort that pushes. Other units, such as Hz, are those of sounds and settings.
inline bool isMechanical (std::string_view unit) noexcept { return unit == "N" || unit == "N*m" || unit == "A"; }

/// A counter that the device requires in each report.
struct SequenceNibble
{
    std::size_t byte = 0;
    int shift = 0;
    int modulo = 16;

    bool operator== (const SequenceNibble&) const = default;
};

/// CRC-32 (IEEE 802.3) over a prefix that is not sent, followed by the report up to the checksum. Little-endian.
struct Checksum
{
    Bytes prefix;
    std::size_t at = 0;

    bool operator== (const Checksum&) const = default;
};

/// Interleaved samples within a report.
struct Stream
{
    std::size_t at = 0;   ///< first byte
    std::size_t frames = 0;
    double rate = 0.0;   ///< Hz
    std::vector<std::string> channels;
    bool is_signed = true;
    int bits = 8;   ///< 8 or 16, little-endian; full scale is 1

    bool operator== (const Stream&) const = default;
};

struct OutputReport
{
    std::string name;
    std::optional<std::uint8_t> id;
    bool is_feature = false;   ///< true if sent as a feature report
    Bytes body;                ///< the whole report with its constants, as sent while the device is driven
    Bytes neutral;             ///< the whole report that makes the device do nothing
    std::vector<OutputField> fields;
    std::vector<SequenceNibble> sequences;   ///< each one counts the reports sent
    std::optional<Checksum> checksum;
    std::optional<Bits> given;   ///< place of the number that the device returned (Answer); not allowed together with a checksum
    std::size_t block = 0;       ///< which of the numbers
    Bytes stop, rearm;           ///< sent instead: see BoardStop; empty: never
    std::optional<Stream> stream;
    double max_rate = 1000.0;   ///< Hz
    double keepalive = 0.0;     ///< time after which an unchanged report is sent again, in s; 0: sent on each tick
    bool verified = false;
    std::string why_not;

    bool operator== (const OutputReport&) const = default;
};

/// A device whose position and force need no conversion.
struct DirectKinematics
{
    bool operator== (const DirectKinematics&) const = default;
};

/// A signal output for a motor that takes an amplitude, and perhaps a frequency, instead of samples. Each member names an effort.
struct SignalEffort
{
    std::string amplitude;   ///< the effort that is set to the signal's amplitude
    std::string frequency;   ///< the effort that is set to its frequency in Hz; empty: the motor has a fixed frequency

    bool operator== (const SignalEffort&) const = default;
};

/// A linear map: p = M q + p0; effort = transpose (M) F.
struct LinearMap
{
    Mat3 matrix = Mat3::Identity();
    Vec3 origin = Vec3::Zero();

    bool operator== (const LinearMap&) const = default;
};

/// A motor with an encoder that drives a joint. The signs give the directions of rotation.
struct Drive
{
    double counts_per_turn = 1.0;                                   ///< encoder counts per turn of the motor
    double ratio = 1.0;                                             ///< joint turns per motor turn: capstan diameter over body diameter
    double offset = 0.0;                                            ///< joint angle at count 0, in rad
    double torque_constant = 1.0;                                   ///< of the motor, in N m/A
    double max_current = std::numeric_limits<double>::infinity();   ///< A

    bool operator== (const Drive&) const = default;
};

/// A rotating column (a), with an upper link (b) and a lower link (c) moved in parallel, as in WoodenHaptics: x = cos a (Lb
/// sin b + Lc sin c), y = sin a (…), z = La + Lb cos b - Lc cos c.
struct SerialArm
{
    std::array<Drive, 3> drives;
    Vec3 links = Vec3::Ones();    ///< La, Lb, Lc in m
    Vec3 origin = Vec3::Zero();   ///< the point that is reported as position 0, in m

    bool operator== (const SerialArm&) const = default;
};

/// Two driven links whose ends are joined by two passive links, in the plane z = 0. The left pivot is at (-base, 0), the
/// right pivot at 0; angles from the x axis. (Campion, Wang, Hayward: The Pantograph Mk-II, IROS 2005.)
struct FiveBar
{
    std::array<Drive, 2> drives;                          ///< right, left
    double base = 0.0;                                    ///< distance between the pivots, in m
    std::array<double, 4> links { 1.0, 1.0, 1.0, 1.0 };   ///< lengths in m: right driven, right passive, left passive, left driven
    Vec3 origin = Vec3::Zero();                           ///< the point that is reported as position 0, in m

    bool operator== (const FiveBar&) const = default;
};

using KinematicsModel = std::variant<DirectKinematics, LinearMap, SerialArm, FiveBar>;

/// A field by which the device says that something is wrong.
struct Alarm
{
    std::string field;
    std::optional<std::uint32_t> is;             ///< the raw value that means the alarm; empty: any but 0
    ReadingFault means = ReadingFault::failed;   ///< one that isAlarm
    double while_driven = 0.0;                   ///< counts only after the motors have been driven for this long, in s

    bool operator== (const Alarm&) const = default;
};

/// Limits and properties of the device; infinity or 0 if unknown.
struct Limits
{
    GuardLimits guard;                           ///< its watchdog is the largest age that an input may have on the host
    double max_motor = GuardLimits::none;        ///< of each effort that renders the force, in its unit (A, N m or N)
    double max_motor_slew = GuardLimits::none;   ///< of the same, per s
    double still_travel = GuardLimits::none;     ///< how far the tool may travel without a change of every value that its position comes from, in m
    double max_stiffness = GuardLimits::none;    ///< N/m
    double max_damping = GuardLimits::none;      ///< N s/m
    double device_damping = 0.0;                 ///< damping of the device itself, in N s/m
    double first_mode = 0.0;                     ///< Hz
    double position_quantum = 0.0;               ///< m
    double force_quantum = 0.0;                  ///< N
    double device_watchdog = 0.0;                ///< time after which the device itself switches its force off, in s; 0: never

    bool operator== (const Limits&) const = default;
};

/// The method to keep reports apart on a line that carries only bytes: see writeFrame().
enum class Framing
{
    none,
    cobs,
    length,
    dualpanto,
    answer   ///< as none, from a device that only answers: with one report to each that it gets
};

/// A serial line, on which a device with this profile may be connected.
struct SerialWire
{
    int baud = 115200;
    Framing framing = Framing::cobs;
    std::optional<std::uint8_t> filler {};   ///< a byte that only completes a message of which the device has missed a part; else it ignores the byte

    /// A pause this long ends an unfinished report. A USB adapter may deliver a report in two parts, but with a shorter pause in between. Not a key of
    /// profiles. Tests make it longer, because a busy computer pauses, too.
    std::chrono::milliseconds pause { 5 };

    bool operator== (const SerialWire&) const = default;
};

/// The wires, besides HID, over which a device sends and gets the same reports.
struct Wires
{
    std::optional<SerialWire> serial;
    bool udp = false;   ///< each datagram is a report

    bool any() const noexcept { return serial || udp; }

    bool operator== (const Wires&) const = default;
};

/// A report and its values, for testing a profile without the device.
struct GoldenSample
{
    std::string about, source;
    bool captured = false;                                ///< true if recorded from a real device; else computed from the layout
    std::vector<Bytes> input;                             ///< input reports, decoded first and in order
    std::vector<std::pair<std::string, double>> values;   ///< values after decoding: axes, position.x …, rotation.x …, pressure, buttons
    std::vector<std::string> pressed;                     ///< all buttons that are pressed
    std::string output;                                   ///< name of an output report; `values` are then the requested efforts, force.x …, torque.x …
    std::vector<float> samples;                           ///< samples of the output report's stream, interleaved
    Bytes expected;                                       ///< the bytes that must be sent

    bool operator== (const GoldenSample&) const = default;
};

struct Profile
{
    std::string id, name, about;
    std::string replaces;   ///< the id of the shipped profile that a user's profile replaces; empty for none
    std::string file;       ///< the file from which the profile was read
    std::vector<MatchRule> match;
    Wires wires;
    std::vector<Step> init, exit;
    std::vector<InputReport> inputs;
    std::vector<OutputReport> outputs;

    std::array<std::string, 3> position, rotation;   ///< input axes of the kinematics, or the pose itself; empty: none
    std::string pressure, valid;                     ///< names of axes; the one named by `valid` is nonzero while the reading is valid
    std::vector<Alarm> alarms;                       ///< the first that is on is the one reported
    std::array<std::string, 3> force, torque;        ///< names of efforts; with kinematics, `force` names the motors
    std::vector<SignalEffort> signals;               ///< signal outputs after those of the streams
    Mat3 axes = Mat3::Identity();                    ///< Tactus (x right, y away, z up) = axes · device

    KinematicsModel kinematics;
    Limits limits;
    DeviceNumbers physics;
    double rate = 0.0;   ///< rate of input reports, in Hz; 0: unknown
    std::vector<std::string> quirks;
    std::vector<std::string> sources;
    std::vector<GoldenSample> samples;

    bool operator== (const Profile&) const = default;
};

/// The input reports that say where the tool is; empty if none does.
inline std::vector<const InputReport*> placingReports (const Profile& p)
{
    const auto places = [&] (const InputField& f) {
        return ! f.name.empty() && (std::ranges::count (p.position, f.name) > 0 || std::ranges::count (p.rotation, f.name) > 0);
    };
    std::vector<const InputReport*> all;
    for (const auto& report : p.inputs)
        if (std::ranges::any_of (report.fields, places)) all.push_back (&report);
    return all;
}

/// True if the reports of the device begin with an id.
inline bool usesIds (const Profile& p)
{
    const auto has = [] (const auto& report) { return report.id.has_value(); };
    return std::ranges::any_of (p.inputs, has) || std::ranges::any_of (p.outputs, has);
}

/// The most bytes that an input report can have; at least 1.
inline std::size_t longestInput (const Profile& p)
{
    std::size_t longest = 1;
    for (const auto& report : p.inputs)
        longest = std::max (longest, report.longest);
    return longest;
}

/// True for a device that sends only when something changes (quirk "only_changes").
inline bool sendsOnlyChanges (const Profile& p) { return std::ranges::count (p.quirks, "only_changes") > 0; }

}   // namespace tactus::host::hid
