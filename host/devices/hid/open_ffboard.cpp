// SPDX-License-Identifier: MIT
#include "open_ffboard.hpp"
#include "bits.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace tactus::host::hid
{
namespace ffboard
{
namespace
{
constexpr std::uint8_t channel = 0xa1;
constexpr std::size_t size = 25;   // with the id
constexpr Bits type_at { .at = 8 }, class_at { .at = 16, .size = 16 }, instance_at { .at = 32 }, command_at { .at = 40, .size = 32 };
constexpr Bits value_at { .at = 72, .size = 32 };   // the lower half

enum Type : std::uint32_t
{
    write = 0,
    request = 1,
    acknowledged = 10
};

/// A value of the board, by its class, instance and number in the board's protocol.
struct Row
{
    std::uint32_t of_class, of_instance, number;
};

constexpr Row emergency_stop { 0x1, 0, 0xa };
constexpr Row torqueOf (std::uint32_t axis) noexcept { return { 0xa01, axis, 0xd }; }
constexpr double full_torque = 0x7fff;

Bytes bytesOf (Type what, const Row& row, std::uint32_t data = 0)
{
    Bytes bytes (size);
    bytes[0] = channel;
    putBits (type_at, what, bytes);
    putBits (class_at, row.of_class, bytes);
    putBits (instance_at, row.of_instance, bytes);
    putBits (command_at, row.number, bytes);
    putBits (value_at, data, bytes);
    return bytes;
}

OutputReport ask (const Row& row, std::string name, double period_s)
{
    OutputReport report;
    report.name = std::move (name);
    report.id = channel;
    report.body = report.neutral = bytesOf (request, row);
    report.max_rate = 2.0 / period_s;
    report.keepalive = period_s;
    report.why_not = "no board available; layout from its firmware";
    return report;
}

/// The answer of this type. Firmware answers a request with one, or with an acknowledgement.
InputReport answer (Type what, const Row& row, const std::string& name, const Bits& bits, double scale)
{
    InputReport report;
    report.id = channel;
    report.length = report.longest = size;
    const auto mark = [&] (const Bits& at, std::uint32_t number) {
        InputField field;
        field.bits = at;
        field.expect = number;
        report.fields.push_back (std::move (field));
    };
    mark (type_at, what);
    mark (class_at, row.of_class);
    mark (instance_at, row.of_instance);
    mark (command_at, row.number);
    InputField field;
    field.name = name;
    field.bits = bits;
    field.scale = scale;
    report.fields.push_back (std::move (field));
    report.why_not = "no board available; layout from its firmware";
    return report;
}

void add (Profile& p, const Row& row, const std::string& name, bool is_signed, double scale, double period_s)
{
    auto bits = value_at;
    bits.is_signed = is_signed;
    p.inputs.insert (p.inputs.end() - 1, { answer (request, row, name, bits, scale), answer (acknowledged, row, name, bits, scale) });
    p.outputs.push_back (ask (row, "ask_" + name, period_s));
}
}   // namespace
}   // namespace ffboard

void addOpenFFBoard (Profile& p, const ReportDescriptor& d, bool two_axes)
{
    using namespace ffboard;
    using Kind = DescribedField::Kind;
    if (d.length (Kind::input, channel) + 1 != size || d.length (Kind::output, channel) + 1 != size) return;
    constexpr double often = 0.02, sometimes = 0.05;   // s
    InputReport others;                                // the last of those with this id, so that nothing is refused
    others.id = channel;
    others.length = others.longest = size;
    others.why_not = "no board available; layout from its firmware";
    std::erase_if (p.inputs, [] (const auto& r) { return r.id == channel; });
    p.inputs.push_back (std::move (others));

    add (p, emergency_stop, "board_stopped", false, 1.0, sometimes);
    p.outputs.back().stop = bytesOf (write, emergency_stop, 1);
    p.outputs.back().rearm = bytesOf (write, emergency_stop, 0);
    p.alarms.push_back ({ .field = "board_stopped", .is = {}, .means = ReadingFault::stopped });
    add (p, torqueOf (0), "torque_x", true, 1.0 / full_torque, often);
    if (two_axes) add (p, torqueOf (1), "torque_y", true, 1.0 / full_torque, often);
    p.sources.emplace_back ("Ultrawipf/OpenFFBoard, HidCommandInterface.h and the wiki: report 0xA1 and its commands; facts only, nothing copied");
}

}   // namespace tactus::host::hid
