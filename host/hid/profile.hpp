// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/guard.hpp>
#include <framework/message.hpp>
#include <framework/rotation.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// What a device profile (host/profiles/*.json) says, as plain data; docs/devices.md tells how one is written.
/// Reports are counted from their first byte: the report id where they have one, else the first byte of data.
namespace tactus::host::hid
{

inline constexpr std::size_t most_axes = 32;      ///< values that a device tells, all its reports together
inline constexpr std::size_t most_efforts = 16;   ///< values that it takes
inline constexpr std::size_t most_channels = 4;   ///< of a stream of samples
inline constexpr std::size_t longest_report = 1024;

using Bytes = std::vector<std::uint8_t>;

enum class Bus
{
    unknown,
    usb,
    bluetooth
};

/// Which devices a profile is for; what is not said fits all. Texts are compared without regard to case.
struct MatchRule
{
    std::vector<std::uint16_t> vid, pid;
    std::optional<std::uint16_t> usage_page, usage;
    std::optional<int> interface_number;
    std::optional<Bus> bus;
    std::string product;   ///< a part of the product's name
};

/// Where a number lies within a report.
struct Bits
{
    std::size_t at = 0;     ///< in bits from the start of the report; the lowest bit of a byte comes first
    std::size_t size = 8;   ///< 1…32
    bool is_signed = false;
    bool big_endian = false;   ///< whole bytes only
    bool is_float = false;     ///< IEEE 754, 32 bits

    std::size_t end() const noexcept { return at + size; }
};

/// What a device has to answer to a feature report that asks for a number of its own, such as that of an effect it made.
struct Answer
{
    /// A value that may stand in the answer, and what is wrong then.
    struct Mark
    {
        Bits bits;
        std::uint32_t raw = 1;
        Message means {};   ///< without a place
    };

    std::optional<std::uint8_t> id;        ///< of the report
    Bits number;                           ///< 0 is none
    std::optional<Mark> success;           ///< has to stand there, if anything has to
    std::vector<Mark> refusals;            ///< no use to ask again
    double patience = 0.5, pause = 0.01;   ///< s, how long and how often it is asked
};

/// One step of waking a device up or of letting it go.
struct Step
{
    enum class Kind
    {
        output,
        feature,
        get_feature   ///< reads the feature report of the id in the first byte; some devices want to be asked
    };

    Kind kind = Kind::output;
    Bytes bytes;
    double delay = 0.0;                ///< s, after it
    std::string about {};              ///< what it is for: "the report that makes an effect"; may be empty
    std::optional<Answer> answer {};   ///< of a get_feature, if it matters; its number is put where `given` says from then on
    std::optional<Bits> given {};
};

/// A number that a device tells: value = raw scale + offset.
struct InputField
{
    std::string name;
    Bits bits;
    double scale = 1.0, offset = 0.0;
    std::string unit = "1";
    bool unwrap = false;                ///< a counter that begins again: it goes on beyond its size
    std::optional<double> expect;       ///< raw: a report with another value here is refused
    std::vector<std::string> buttons;   ///< of each bit, the lowest first; empty names are bits without one
    bool is_hat = false;                ///< the value is 0 (up) … 7 (up and left), clockwise: buttons are up, right, down, left

    bool isAxis() const noexcept { return buttons.empty() && ! expect; }
};

struct InputReport
{
    std::optional<std::uint8_t> id;
    std::size_t length = 0;    ///< bytes; a shorter report is refused
    std::size_t longest = 0;   ///< bytes; a longer one, too
    std::vector<InputField> fields;
    std::string timestamp;   ///< the field (in s) that tells when, by the device's clock; may be empty
    std::string sequence;    ///< the field that counts reports; may be empty
    bool verified = false;   ///< against a report that a real device sent
    std::string why_not;     ///< where it was not
};

/// raw = round (value/scale - offset/scale), after the value went through a law.
struct Encoding
{
    enum class Law
    {
        linear,
        log2,   ///< steps log2 (value/reference); 0 and less give the smallest raw value
        table   ///< linear between the points, the ends held
    };

    Law law = Law::linear;
    double steps = 1.0, reference = 1.0;
    std::vector<double> x, y;
    double scale = 1.0, offset = 0.0;   ///< of what the law gave: raw = round ((law - offset)/scale)
};

/// Something that is written into a report.
struct OutputField
{
    enum class Source
    {
        effort,   ///< what is asked for under this name
        enable,   ///< 1 while the device is driven, else as in the neutral report
        echo      ///< the raw value of the input field of this name, as read last
    };

    std::string name;
    Source source = Source::effort;
    Bits bits;
    Encoding encoding;
    double min = -std::numeric_limits<double>::infinity();   ///< of the value; also what the bits can hold
    double max = std::numeric_limits<double>::infinity();
    std::string unit = "1";
};

/// A counter that the device wants in each report.
struct SequenceNibble
{
    std::size_t byte = 0;
    int shift = 0;
    int modulo = 16;
};

/// CRC-32 (IEEE 802.3) over some bytes that are not sent and the report up to where the sum is put, little-endian.
struct Checksum
{
    Bytes prefix;
    std::size_t at = 0;
};

/// Samples, frame by frame, within a report.
struct Stream
{
    std::size_t at = 0;   ///< byte
    std::size_t frames = 0;
    double rate = 0.0;   ///< Hz
    std::vector<std::string> channels;
    bool is_signed = true;
    int bits = 8;   ///< 8 or 16, little-endian; full scale is 1
};

struct OutputReport
{
    std::string name;
    std::optional<std::uint8_t> id;
    bool is_feature = false;   ///< sent as a feature report
    Bytes body;                ///< the whole report, with its constants, while the device is driven
    Bytes neutral;             ///< the whole report that makes the device do nothing
    std::vector<OutputField> fields;
    std::vector<SequenceNibble> sequences;   ///< all count the reports
    std::optional<Checksum> checksum;
    std::optional<Bits> given;   ///< where the number goes that the device gave (Answer); not together with a checksum
    std::optional<Stream> stream;
    double max_rate = 1000.0;   ///< Hz
    double keepalive = 0.0;     ///< s after which it is sent again though nothing changed; 0: on each tick
    bool verified = false;
    std::string why_not;
};

/// Position and force as they are.
struct Direct
{
};

/// A signal output whose motor takes no samples, but how strong it is to shake, and perhaps how fast: names of efforts.
struct SignalEffort
{
    std::string amplitude;   ///< gets the signal's amplitude
    std::string frequency;   ///< gets its frequency in Hz; empty: the motor has one of its own
};

/// p = M q + p0; effort = transpose (M) F.
struct LinearMap
{
    Mat3 matrix = Mat3::Identity();
    Vec3 origin = Vec3::Zero();
};

/// A motor with an encoder, and how it moves a joint. Signs say which way each turns.
struct Drive
{
    double counts_per_turn = 1.0;                                   ///< of the motor
    double ratio = 1.0;                                             ///< the joint turns so much for a turn of the motor: capstan over body diameter
    double offset = 0.0;                                            ///< rad, the joint at count 0
    double torque_constant = 1.0;                                   ///< N m/A of the motor
    double max_current = std::numeric_limits<double>::infinity();   ///< A
};

/// A column that turns (a), an upper link (b) and a lower one (c) moved in parallel, as of WoodenHaptics:
/// x = cos a (Lb sin b + Lc sin c), y = sin a (…), z = La + Lb cos b - Lc cos c.
struct SerialArm
{
    std::array<Drive, 3> drives;
    Vec3 links = Vec3::Ones();    ///< m: La, Lb, Lc
    Vec3 origin = Vec3::Zero();   ///< m, which becomes 0
};

/// Two driven links whose ends meet over two passive ones, in the plane z = 0. The left pivot is at (-base, 0), the
/// right one at 0; angles from the x axis. (Campion, Wang, Hayward: The Pantograph Mk-II, IROS 2005.)
struct FiveBar
{
    std::array<Drive, 2> drives;                          ///< right, left
    double base = 0.0;                                    ///< m, between the pivots
    std::array<double, 4> links { 1.0, 1.0, 1.0, 1.0 };   ///< m: right driven, right passive, left passive, left driven
    Vec3 origin = Vec3::Zero();                           ///< m, which becomes 0
};

using KinematicsModel = std::variant<Direct, LinearMap, SerialArm, FiveBar>;

/// What the device stands and does; inf and 0 where nobody knows.
struct Limits
{
    GuardLimits guard;                          ///< watchdog: on the host's side, how old an input may be
    double max_stiffness = GuardLimits::none;   ///< N/m
    double max_damping = GuardLimits::none;     ///< N s/m
    double device_damping = 0.0;                ///< N s/m, of the device itself
    double first_mode = 0.0;                    ///< Hz
    double position_quantum = 0.0;              ///< m
    double force_quantum = 0.0;                 ///< N
    double device_watchdog = 0.0;               ///< s after which the device itself lets go; 0: never
};

/// A report and what it says: how a profile is tested without the device.
struct GoldenSample
{
    std::string about, source;
    bool captured = false;                                ///< of a real device; else computed from the layout
    std::vector<Bytes> input;                             ///< decoded first, one after the other
    std::vector<std::pair<std::string, double>> values;   ///< afterwards: axes, position.x …, rotation.x …, pressure, buttons
    std::vector<std::string> pressed;                     ///< all buttons that are down
    std::string output;                                   ///< of an output report; `values` are what is asked for: efforts, force.x …, torque.x …
    std::vector<float> samples;                           ///< of its stream, frame by frame
    Bytes expected;                                       ///< as sent
};

struct Profile
{
    std::string id, name, about;
    std::string file;   ///< where it was read
    std::vector<MatchRule> match;
    std::vector<Step> init, exit;
    std::vector<InputReport> inputs;
    std::vector<OutputReport> outputs;

    std::array<std::string, 3> position, rotation;   ///< axes that kinematics takes, or that are it; empty: none
    std::string pressure, valid;                     ///< axes; `valid` is not 0 while the reading is
    std::array<std::string, 3> force, torque;        ///< efforts; with kinematics, `force` are its motors
    std::vector<SignalEffort> signals;               ///< signal outputs that follow those of the streams
    Mat3 axes = Mat3::Identity();                    ///< Tactus (x right, y away, z up) = axes · device

    KinematicsModel kinematics;
    Limits limits;
    double rate = 0.0;   ///< Hz, of input reports; 0: not known
    std::vector<std::string> quirks;
    std::vector<std::string> sources;
    std::vector<GoldenSample> samples;
};

}   // namespace tactus::host::hid
