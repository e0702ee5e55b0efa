// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/devices/problem.hpp>
#include <host/hid/bits.hpp>
#include <host/hid/pid_device.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace tactus::host::hid
{
namespace
{
using Kind = DescribedField::Kind;

constexpr Usage pid (unsigned id) noexcept { return usageOf (0x0f, id); }

// Reports, then what stands in them.
constexpr Usage set_effect = pid (0x21), set_constant_force = pid (0x73), effect_operation = pid (0x77), device_gain_report = pid (0x7d), device_control = pid (0x96),
                create_new_effect = pid (0xab), block_load = pid (0x89);
constexpr Usage block_index = pid (0x22), constant_force = pid (0x26), duration = pid (0x50), gain = pid (0x52), direction_enable = pid (0x56), direction = pid (0x57),
                magnitude = pid (0x70), start = pid (0x79), stop = pid (0x7b), loop_count = pid (0x7c), device_gain = pid (0x7e), load_success = pid (0x8c),
                enable_actuators = pid (0x97), stop_all = pid (0x99);

// A device has no watchdog, so the effect is a short one that is started again and again: if the host dies, it ends.
constexpr double lasts = 0.5, started_each = 0.2;   // s

/// A number in a report: its field, and which of several.
struct Place
{
    const DescribedField* field = nullptr;
    std::size_t n = 0;

    /// The bits, counted from the start of the report with its id.
    Bits bits (bool has_ids) const noexcept { return { .at = (has_ids ? 8 : 0) + field->bit + n * field->size, .size = field->size, .is_signed = field->logical_min < 0 }; }
};

/// The id under which the first numbers of such a report are sent. A broken descriptor may spread it over several.
std::optional<std::uint8_t> idOf (const ReportDescriptor& d, Kind kind, Usage report)
{
    const auto first = std::ranges::find_if (d.fields, [&] (const DescribedField& f)
                                             { return f.kind == kind && d.lies (f.collection, report); });
    if (first == d.fields.end()) return {};
    return first->report;
}

/// Where a usage stands within a report of this kind. Of an array, where the number of the usage would.
std::optional<Place> find (const ReportDescriptor& d, Kind kind, Usage report, Usage what)
{
    const auto id = idOf (d, kind, report);
    for (const auto& f : d.fields)
        if (f.kind == kind && f.report == id && ! f.constant && f.size <= 32 && d.lies (f.collection, report))
            if (const auto n = f.placeOf (what))
            {
                if (! f.variable) return Place { &f, 0 };
                if (*n < f.count) return Place { &f, *n };
            }
    return {};
}

/// A report being written, by usages.
class Writer
{
public:
    Writer (const ReportDescriptor& d, Kind k, Usage r) : descriptor (d), kind (k), report (r)
    {
        const auto id = idOf (d, kind, report);
        if (! id) return;
        bytes.assign (d.length (kind, *id) + (d.has_ids ? 1 : 0), 0);
        if (d.has_ids) bytes[0] = *id;
    }

    /// A value, held within the logical range.
    Writer& put (Usage what, std::int64_t value)
    {
        if (const auto place = find (descriptor, kind, report, what))
            write (*place, std::clamp (value, place->field->logical_min, std::max (place->field->logical_min, place->field->logical_max)));
        return *this;
    }

    /// As much as the field says it takes.
    Writer& most (Usage what)
    {
        if (const auto place = find (descriptor, kind, report, what)) write (*place, place->field->logical_max);
        return *this;
    }

    /// One of several things that can be chosen: its number in an array, or a bit of its own.
    Writer& choose (Usage what)
    {
        if (const auto place = find (descriptor, kind, report, what))
            write (*place, place->field->variable ? 1 : place->field->logical_min + static_cast<std::int64_t> (*place->field->placeOf (what)));
        return *this;
    }

    /// A time in s, as the unit of the field wants it: ms where it says nothing else.
    Writer& time (Usage what, double seconds)
    {
        const auto place = find (descriptor, kind, report, what);
        if (! place) return *this;
        const auto& f = *place->field;
        const double exponent = f.unit == 0 ? -3.0 : static_cast<double> (f.unit_exponent);
        const bool scaled = f.physical_max > f.physical_min;
        const double counts = scaled ? static_cast<double> (f.logical_max - f.logical_min) / static_cast<double> (f.physical_max - f.physical_min) : 1.0;
        return put (what, f.logical_min + static_cast<std::int64_t> ((seconds / std::pow (10.0, exponent) - (scaled ? static_cast<double> (f.physical_min) : 0.0)) * counts + 0.5));
    }

    /// The first number of a collection within the report, as a share of its range.
    Writer& first (Usage collection, double share)
    {
        for (const auto& f : descriptor.fields)
            if (f.kind == kind && ! f.constant && f.size <= 32 && descriptor.lies (f.collection, report) && descriptor.lies (f.collection, collection))
            {
                write ({ &f, 0 }, f.logical_min + static_cast<std::int64_t> (share * static_cast<double> (f.logical_max - f.logical_min) + 0.5));
                break;
            }
        return *this;
    }

    Bytes take() { return std::move (bytes); }

private:
    void write (const Place& place, std::int64_t value)
    {
        const auto bits = place.bits (descriptor.has_ids);
        if (bits.end() <= 8 * bytes.size()) putBits (bits, static_cast<std::uint32_t> (value), bytes);
    }

    const ReportDescriptor& descriptor;
    Kind kind;
    Usage report;
    Bytes bytes;
};

Bytes forWrite (const ReportDescriptor& d, Bytes report)
{
    if (! d.has_ids) report.insert (report.begin(), 0);
    return report;
}

/// "x", "rx", "slider" … of the generic desktop page; nothing for what is no axis.
std::string_view axisName (Usage usage) noexcept
{
    constexpr std::string_view names[] { "x", "y", "z", "rx", "ry", "rz", "slider", "dial", "wheel" };
    if (usage >= usageOf (0x01, 0x30) && usage <= usageOf (0x01, 0x38)) return names[usage - usageOf (0x01, 0x30)];
    if (usage == usageOf (0x02, 0xc8)) return "steering";
    if (usage == usageOf (0x02, 0xc4)) return "accelerator";
    if (usage == usageOf (0x02, 0xc5)) return "brake";
    return {};
}

void addInput (std::vector<InputReport>& inputs, const ReportDescriptor& d, const DescribedField& f)
{
    auto report = std::ranges::find_if (inputs, [&] (const InputReport& r)
                                        { return ! d.has_ids || r.id == f.report; });
    if (report == inputs.end())
    {
        const auto length = d.length (Kind::input, f.report) + (d.has_ids ? 1 : 0);
        inputs.push_back ({ .id = d.has_ids ? std::optional (f.report) : std::nullopt, .length = length, .longest = length, .fields = {}, .timestamp = {}, .sequence = {}, .why_not = "read from the device's report descriptor" });
        report = inputs.end() - 1;
    }

    for (std::size_t n = 0; n < f.count; ++n)
    {
        const auto usage = f.usage (n).value_or (0);
        InputField field;
        field.bits = Place { &f, n }.bits (d.has_ids);
        if (const auto name = axisName (usage); ! name.empty() && f.logical_max > f.logical_min)
        {
            field.name = name;
            field.scale = 2.0 / static_cast<double> (f.logical_max - f.logical_min);
            field.offset = -1.0 - static_cast<double> (f.logical_min) * field.scale;
        }
        else if (usage > usageOf (0x09, 0) && usage <= usageOf (0x09, 32) && f.size == 1)
            field.buttons = { "button" + std::to_string (usage - usageOf (0x09, 0)) };
        else
            continue;
        // A device with several sticks of one name keeps the first.
        const auto same = [&] (const InputField& other)
        { return other.name == field.name && other.buttons == field.buttons; };
        const bool known = std::ranges::any_of (inputs, [&] (const InputReport& r)
                                                { return std::ranges::any_of (r.fields, same); });
        if (! known) report->fields.push_back (std::move (field));
    }
}
}   // namespace

std::optional<PidDevice> PidDevice::from (const ReportDescriptor& d, Messages& messages)
{
    struct Need
    {
        Kind kind;
        Usage report, what;
        std::string_view name;
    };
    const Need needs[] = {
        { Kind::feature, create_new_effect, constant_force, "Create New Effect with a constant force" },
        { Kind::feature, block_load, block_index, "Block Load with a block index" },
        { Kind::output, set_effect, block_index, "Set Effect with a block index" },
        { Kind::output, set_constant_force, block_index, "Set Constant Force with a block index" },
        { Kind::output, set_constant_force, magnitude, "Set Constant Force with a magnitude" },
        { Kind::output, effect_operation, start, "Effect Operation with a start" },
        { Kind::output, effect_operation, stop, "Effect Operation with a stop" },
        { Kind::output, device_control, stop_all, "Device Control with a stop of all effects" },
    };
    bool whole = true;
    for (const auto& need : needs)
        if (! find (d, need.kind, need.report, need.what))
        {
            messages.push_back (problem ("pid/missing", "the report descriptor", "the device has no " + std::string (need.name), "it cannot be driven as a force feedback device; a profile of its own may help"));
            whole = false;
        }
    const auto force = find (d, Kind::output, set_constant_force, magnitude);
    if (whole && (force->field->logical_min >= 0 || force->field->logical_max <= 0))
    {
        messages.push_back (problem ("pid/missing", "the report descriptor", "the magnitude of a constant force has no sign", "it cannot be driven as a force feedback device; a profile of its own may help"));
        whole = false;
    }
    if (! whole) return {};
    return PidDevice (d);
}

Bytes PidDevice::createEffect() const
{
    return forWrite (descriptor, Writer (descriptor, Kind::feature, create_new_effect).choose (constant_force).take());
}

Bytes PidDevice::blockLoad() const { return forWrite (descriptor, Writer (descriptor, Kind::feature, block_load).take()); }

std::optional<int> PidDevice::block (std::span<const std::uint8_t> answer) const noexcept
{
    // hidapi's answer begins with the id, or with a 0 where there is none.
    if (! descriptor.has_ids && ! answer.empty()) answer = answer.subspan (1);

    const auto read = [&] (const Place& place) -> std::optional<std::int64_t>
    {
        const auto bits = place.bits (descriptor.has_ids);
        if (bits.end() > 8 * answer.size()) return {};
        return static_cast<std::int64_t> (numberOf (bits, bitsAt (bits, answer)));
    };
    const auto index = find (descriptor, Kind::feature, block_load, block_index);
    const auto number = read (*index);
    if (! number || *number <= 0 || (descriptor.has_ids && answer[0] != index->field->report)) return {};

    if (const auto status = find (descriptor, Kind::feature, block_load, load_success))
    {
        const auto expected = status->field->variable ? 1 : status->field->logical_min + static_cast<std::int64_t> (*status->field->placeOf (load_success));
        if (read (*status) != expected) return {};
    }
    return static_cast<int> (*number);
}

Profile PidDevice::profile (int block) const
{
    const auto& d = descriptor;
    const auto output = [&] (Usage report)
    { return Writer (d, Kind::output, report); };

    Profile p;
    p.id = "pid";
    p.name = "Force feedback device";
    p.sources = { "the device's own report descriptor", "Device Class Definition for Physical Interface Devices 1.0" };
    for (const auto& f : d.fields)
        if (f.kind == Kind::input && ! f.constant && f.variable && f.size <= 32) addInput (p.inputs, d, f);

    // At full gain, triggered by no button, and towards the right: a quarter of a turn from away. That is what a wheel,
    // which has no other direction, and the drivers of others take (linux, hid-pidff.c).
    auto effect = output (set_effect);
    effect.put (block_index, block).choose (constant_force).time (duration, lasts).most (gain).put (direction_enable, 1).first (direction, 0.25);

    const auto step = [&] (Bytes bytes)
    { return Step { .kind = Step::Kind::output, .bytes = forWrite (d, std::move (bytes)), .delay = 0.0 }; };
    p.init.push_back (step (output (device_control).choose (enable_actuators).take()));
    if (find (d, Kind::output, device_gain_report, device_gain)) p.init.push_back (step (output (device_gain_report).most (device_gain).take()));
    p.init.push_back (step (effect.take()));
    p.init.push_back (step (output (set_constant_force).put (block_index, block).take()));   // 0; the report `start` starts it
    p.exit = { step (output (set_constant_force).put (block_index, block).take()), step (output (device_control).choose (stop_all).take()) };

    const auto force = find (d, Kind::output, set_constant_force, magnitude);
    const double full = static_cast<double> (std::min (force->field->logical_max, -force->field->logical_min));
    OutputField field;
    field.name = "force";
    field.bits = force->bits (d.has_ids);
    field.encoding.scale = 1.0 / full;
    field.min = -1.0;
    field.max = 1.0;

    OutputReport report;
    report.name = "constant_force";
    if (d.has_ids) report.id = force->field->report;
    report.body = report.neutral = output (set_constant_force).put (block_index, block).take();
    report.fields = { std::move (field) };
    report.why_not = "read from the device's report descriptor";

    OutputReport again;
    again.name = "start";
    if (d.has_ids) again.id = find (d, Kind::output, effect_operation, start)->field->report;
    again.body = output (effect_operation).put (block_index, block).choose (start).put (loop_count, 1).take();
    again.neutral = output (effect_operation).put (block_index, block).choose (stop).take();
    again.max_rate = 1.0 / started_each;
    again.keepalive = started_each;
    again.why_not = report.why_not;

    p.outputs = { std::move (report), std::move (again) };
    p.limits.device_watchdog = find (d, Kind::output, set_effect, duration) ? lasts : 0.0;
    p.limits.guard.watchdog = 0.05;
    p.limits.guard.ramp = 0.2;
    return p;
}

}   // namespace tactus::host::hid
