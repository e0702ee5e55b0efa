// SPDX-License-Identifier: MIT
#include "pid_device.hpp"
#include "bits.hpp"

#include <tactus/kit/math/math.hpp>
#include <tactus/text/message.hpp>

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

// First the reports, then their fields.
constexpr Usage set_effect = pid (0x21), set_constant_force = pid (0x73), effect_operation = pid (0x77), device_gain_report = pid (0x7d),
                device_control = pid (0x96), create_new_effect = pid (0xab), block_load = pid (0x89), block_free = pid (0x90);
constexpr Usage block_index = pid (0x22), constant_force = pid (0x26), duration = pid (0x50), gain = pid (0x52), direction_enable = pid (0x56),
                axes_enable = pid (0x55), direction = pid (0x57), magnitude = pid (0x70), start = pid (0x79), stop = pid (0x7b), loop_count = pid (0x7c),
                device_gain = pid (0x7e),
                load_success = pid (0x8c), load_full = pid (0x8d), load_error = pid (0x8e), enable_actuators = pid (0x97), stop_all = pid (0x99),
                device_reset = pid (0x9a);

// The time that a device needs to clear its effects; it does not report when it has finished.
constexpr double reset_takes = 0.05;   // s

constexpr const char* from_descriptor = "read from the device's report descriptor";

// The block index in profiles: a placeholder until the device has assigned a block.
constexpr int any_block = 1;

/// A number in a report: its field, and its index in that field.
struct Place
{
    const DescribedField* field = nullptr;
    std::size_t n = 0;

    /// The bits of the number, counted from the start of the report including its id.
    Bits bits (bool has_ids) const noexcept
    {
        return { .at = (has_ids ? 8 : 0) + field->bit + n * field->size, .size = field->size, .is_signed = field->logical_min < 0 };
    }
};

/// The id of the first report of this kind with numbers for the usage `report`. A broken descriptor may spread them over
/// several reports.
std::optional<std::uint8_t> idOf (const ReportDescriptor& d, Kind kind, Usage report)
{
    const auto first = std::ranges::find_if (d.fields, [&] (const DescribedField& f) { return f.kind == kind && d.lies (f.collection, report); });
    if (first == d.fields.end()) return {};
    return first->report;
}

/// The place of a usage within a report of this kind. For an array, this is the place of its index.
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

/// Writes a report, usage by usage.
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

    /// Writes a value, clamped to the logical range.
    Writer& put (Usage what, std::int64_t value)
    {
        if (const auto place = find (descriptor, kind, report, what))
            write (*place, std::clamp (value, place->field->logical_min, std::max (place->field->logical_min, place->field->logical_max)));
        return *this;
    }

    /// Sets a field to its largest value.
    Writer& most (Usage what)
    {
        if (const auto place = find (descriptor, kind, report, what)) write (*place, place->field->logical_max);
        return *this;
    }

    /// Chooses one of several usages: writes its index into an array, or sets its own bit.
    Writer& choose (Usage what)
    {
        if (const auto place = find (descriptor, kind, report, what))
            write (*place, place->field->variable ? 1 : place->field->logical_min + static_cast<std::int64_t> (*place->field->placeOf (what)));
        return *this;
    }

    /// Writes a time given in s, converted to the unit of the field, or to ms if it has none.
    Writer& time (Usage what, double seconds)
    {
        const auto place = find (descriptor, kind, report, what);
        if (! place) return *this;
        const auto& f = *place->field;
        const double exponent = f.unit == 0 ? -3.0 : static_cast<double> (f.unit_exponent);
        const bool scaled = f.physical_max > f.physical_min;
        const double counts = scaled ? static_cast<double> (f.logical_max - f.logical_min) / static_cast<double> (f.physical_max - f.physical_min) : 1.0;
        return put (what, f.logical_min
                              + static_cast<std::int64_t> (
                                  (seconds / math::pow (10.0, exponent) - (scaled ? static_cast<double> (f.physical_min) : 0.0)) * counts + 0.5));
    }

    /// Writes the first number of a collection, as a fraction of its range.
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

/// "x", "rx", "slider" … of the generic desktop page; empty for other usages.
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
    auto report = std::ranges::find_if (inputs, [&] (const InputReport& r) { return ! d.has_ids || r.id == f.report; });
    if (report == inputs.end())
    {
        const auto length = d.length (Kind::input, f.report) + (d.has_ids ? 1 : 0);
        inputs.push_back ({ .id = d.has_ids ? std::optional (f.report) : std::nullopt,
                            .length = length,
                            .longest = length,
                            .fields = {},
                            .timestamp = {},
                            .sequence = {},
                            .why_not = from_descriptor });
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
        // If several axes have the same name, keep the first.
        const auto same = [&] (const InputField& other) { return other.name == field.name && other.buttons == field.buttons; };
        const bool known = std::ranges::any_of (inputs, [&] (const InputReport& r) { return std::ranges::any_of (r.fields, same); });
        if (! known) report->fields.push_back (std::move (field));
    }
}

/// Scales axes to m or rad if their travel is known, and assigns axes and force to the tool.
void calibrate (Profile& p, const PidCalibration& calibration)
{
    const auto driven = drivenAxis (calibration);
    double quantum = 0.0;
    std::vector<std::string> scaled;
    for (auto& report : p.inputs)
        for (auto& field : report.fields)
            if (const auto travel = calibration.travel.find (field.name); travel != calibration.travel.end())
            {
                field.scale *= 0.5 * travel->second;
                field.offset *= 0.5 * travel->second;
                field.unit = calibration.turns ? "rad" : "m";
                scaled.push_back (field.name);
                if (field.name == driven) quantum = field.scale;
            }
    const auto known = [&] (const std::string& name) { return std::ranges::count (scaled, name) > 0 ? name : std::string(); };

    if (calibration.turns)
        p.rotation[1] = known (driven);
    else
    {
        p.position = { known ("x"), known ("y"), known ("z") };
        p.axes = Vec3 (1.0, -1.0, -1.0).asDiagonal();   // a stick's y increases towards the user, its z downwards
    }

    if (calibration.full_force <= 0.0) return;
    (calibration.turns ? p.torque[1] : p.force[0]) = "force";
    const double travel = known (driven).empty() ? 0.0 : calibration.travel.find (driven)->second;
    auto weaker = calibration;   // within its force, neither motor is cut off, so the direction of the force is kept
    if (calibration.full_force_y > 0.0)
    {
        p.force[1] = "force_y";
        weaker.full_force = std::min (calibration.full_force, calibration.full_force_y);
    }
    limitForce (p.limits.guard, weaker, travel, quantum);
}

/// The place of the block index in a report of this kind.
std::optional<Bits> blockOf (const ReportDescriptor& d, Usage report)
{
    const auto place = find (d, Kind::output, report, block_index);
    if (! place) return {};
    auto bits = place->bits (d.has_ids);
    bits.is_signed = false;
    return bits;
}

Step step (const char* about, Bytes bytes, std::optional<Bits> given = {}, std::size_t block = 0)
{
    Step s { .bytes = std::move (bytes), .about = about };
    s.given = given;
    s.block = block;
    return s;
}

Step zeroForce (const ReportDescriptor& d, std::size_t block)
{
    return step ("the report that sets zero force", Writer (d, Kind::output, set_constant_force).put (block_index, any_block).take(),
                 blockOf (d, set_constant_force), block);
}

/// The directions that the effects come from, in turns from "away". A quarter turn is along x: wheels have no other direction, and the drivers of
/// other devices use this one too (linux, hid-pidff.c). With the direction 0, nothing is along x.
constexpr double directions[most_blocks] { 0.25, 0.0 };

std::vector<Step> initSteps (const PidDevice& device, const ReportDescriptor& d, std::size_t effects)
{
    const auto output = [&] (Usage report) { return Writer (d, Kind::output, report); };
    std::vector<Step> init;
    if (find (d, Kind::output, device_control, device_reset))
    {
        init.push_back (step ("the report that clears all effects", output (device_control).choose (device_reset).take()));
        init.back().delay = reset_takes;
    }
    for (std::size_t block = 0; block < effects; ++block)
    {
        init.push_back (step ("the report that creates a constant force", device.createEffect()));
        init.back().kind = Step::Kind::feature;
        init.push_back (step ("the report with the block of the constant force", device.blockLoad(), {}, block));
        init.back().kind = Step::Kind::get_feature;
        init.back().answer = device.answer();
    }
    init.push_back (step ("the report that switches the motors on", output (device_control).choose (enable_actuators).take()));
    if (find (d, Kind::output, device_gain_report, device_gain))
        init.push_back (step ("the report that sets full gain", output (device_gain_report).most (device_gain).take()));
    for (std::size_t block = 0; block < effects; ++block)
    {
        // Full gain, and no trigger button.
        auto effect = output (set_effect);
        effect.put (block_index, any_block).choose (constant_force).time (duration, effect_lasts).most (gain).put (direction_enable, 1);
        effect.first (direction, directions[block]);
        init.push_back (step ("the report that sets up the effect", effect.take(), blockOf (d, set_effect), block));
        init.push_back (zeroForce (d, block));   // the `start` report then starts the effect
    }
    return init;
}

std::vector<Step> exitSteps (const ReportDescriptor& d, std::size_t effects)
{
    std::vector<Step> exit;
    for (std::size_t block = 0; block < effects; ++block)
        exit.push_back (zeroForce (d, block));
    exit.push_back (step ("the report that stops all effects", Writer (d, Kind::output, device_control).choose (stop_all).take()));
    if (const auto freed = blockOf (d, block_free))
        for (std::size_t block = 0; block < effects; ++block)
            exit.push_back (step ("the report that frees the effect", Writer (d, Kind::output, block_free).put (block_index, any_block).take(), freed, block));
    return exit;
}

OutputReport forceReport (const ReportDescriptor& d, const PidCalibration& calibration, double full_force, std::size_t block)
{
    // The direction of an effect is where it comes from (DirectX, Effect Direction): from the right means a push to the left, from "away" one
    // towards the user, which is where the y of a stick increases.
    const double side = block == 0 ? -1.0 : 1.0;
    const auto force = find (d, Kind::output, set_constant_force, magnitude);
    const double counts = static_cast<double> (std::min (force->field->logical_max, -force->field->logical_min));
    OutputField field;
    field.name = block == 0 ? "force" : "force_y";
    field.bits = force->bits (d.has_ids);
    field.encoding.scale = (calibration.is_reversed ? -side : side) * full_force / counts;
    field.min = -full_force * calibration.usable;
    field.max = full_force * calibration.usable;
    if (calibration.full_force > 0.0) field.unit = calibration.turns ? "N*m" : "N";

    OutputReport report;
    report.name = block == 0 ? "constant_force" : "constant_force_y";
    if (d.has_ids) report.id = force->field->report;
    report.body = report.neutral = Writer (d, Kind::output, set_constant_force).put (block_index, any_block).take();
    report.fields = { std::move (field) };
    report.given = blockOf (d, set_constant_force);
    report.block = block;
    report.why_not = from_descriptor;
    return report;
}

OutputReport startReport (const ReportDescriptor& d, std::size_t block)
{
    const auto operation = [&] { return Writer (d, Kind::output, effect_operation).put (block_index, any_block); };
    OutputReport report;
    report.name = block == 0 ? "start" : "start_y";
    if (d.has_ids) report.id = find (d, Kind::output, effect_operation, start)->field->report;
    report.body = operation().choose (start).put (loop_count, 1).take();
    report.neutral = operation().choose (stop).take();
    report.given = blockOf (d, effect_operation);
    report.block = block;
    report.max_rate = 1.0 / effect_restarts;
    report.keepalive = effect_restarts;
    report.why_not = from_descriptor;
    return report;
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
            messages.push_back (Message::error ("pid/missing", "the report descriptor", "the device has no " + std::string (need.name),
                                                "it cannot be driven as a standard force feedback device; a profile for it may help"));
            whole = false;
        }
    const auto force = find (d, Kind::output, set_constant_force, magnitude);
    if (whole && (force->field->logical_min >= 0 || force->field->logical_max <= 0))
    {
        messages.push_back (Message::error ("pid/missing", "the report descriptor", "the magnitude of a constant force has no sign",
                                            "it cannot be driven as a standard force feedback device; a profile for it may help"));
        whole = false;
    }
    if (! whole) return {};
    return PidDevice (d);
}

bool PidDevice::hasForceAlongY() const noexcept
{
    return std::ranges::any_of (descriptor.fields, [&] (const DescribedField& f) {
        return f.kind == Kind::output && descriptor.lies (f.collection, axes_enable) && f.placeOf (usageOf (0x01, 0x31));
    });
}

bool PidDevice::isMeantBy (const ReportDescriptor& d) noexcept
{
    return std::ranges::any_of (d.collections, [] (const DescribedCollection& c) { return c.usage >> 16 == 0x0f; });
}

Bytes PidDevice::createEffect() const { return Writer (descriptor, Kind::feature, create_new_effect).choose (constant_force).take(); }

Bytes PidDevice::blockLoad() const { return Writer (descriptor, Kind::feature, block_load).take(); }

Answer PidDevice::answer() const
{
    const auto& d = descriptor;
    Answer a;
    const auto index = find (d, Kind::feature, block_load, block_index);
    if (d.has_ids) a.id = index->field->report;
    a.number = index->bits (d.has_ids);
    a.number.is_signed = false;
    const auto mark = [&] (Usage status) -> std::optional<Answer::Mark> {
        const auto place = find (d, Kind::feature, block_load, status);
        if (! place) return {};
        const auto raw = place->field->variable ? 1 : place->field->logical_min + static_cast<std::int64_t> (*place->field->placeOf (status));
        return Answer::Mark { .bits = place->bits (d.has_ids),
                              .raw = static_cast<std::uint32_t> (static_cast<std::uint64_t> (raw) & maskOf (place->bits (d.has_ids))) };
    };
    a.success = mark (load_success);
    if (auto full = mark (load_full))
    {
        full->means = Message::error ("pid/full", "", "the device has no room for another effect",
                                      "close other programs that use its force feedback, or unplug it and plug it in again");
        a.refusals.push_back (std::move (*full));
    }
    if (auto refused = mark (load_error))
    {
        refused->means = Message::error ("pid/refused", "", "the device could not create a constant force",
                                         "check that it has power and its motor is switched on, and plug it in again");
        a.refusals.push_back (std::move (*refused));
    }
    return a;
}

std::vector<std::string> PidDevice::axisNames() const
{
    std::vector<std::string> names;
    for (const auto& report : profile().inputs)
        for (const auto& field : report.fields)
            if (field.isAxis()) names.push_back (field.name);
    return names;
}

Profile PidDevice::profile (const PidCalibration& calibration) const
{
    const auto& d = descriptor;
    const double full_force = calibration.full_force > 0.0 ? calibration.full_force : 1.0;
    Profile p;
    p.id = "pid";
    p.name = calibration.turns ? "Force feedback wheel" : "Force feedback device";
    p.sources = { "the device's own report descriptor", "Device Class Definition for Physical Interface Devices 1.0" };
    for (const auto& f : d.fields)
        if (f.kind == Kind::input && ! f.constant && f.variable && f.size <= 32) addInput (p.inputs, d, f);
    const std::size_t effects = calibration.full_force_y > 0.0 ? 2 : 1;
    p.init = initSteps (*this, d, effects);
    p.exit = exitSteps (d, effects);
    for (std::size_t block = 0; block < effects; ++block)
        p.outputs.push_back (forceReport (d, calibration, block == 0 ? full_force : calibration.full_force_y, block));
    for (std::size_t block = 0; block < effects; ++block)
        p.outputs.push_back (startReport (d, block));
    p.limits.device_watchdog = find (d, Kind::output, set_effect, duration) ? effect_lasts : 0.0;
    p.limits.guard.watchdog = 0.05;
    p.limits.guard.ramp = 0.2;
    p.limits.guard.max_axis_effort = full_force * calibration.usable;
    p.limits.guard.max_axis_slew = slewOf (p.limits.guard.max_axis_effort);
    p.quirks = { "only_changes" };   // USB HID devices may send only when something moves
    calibrate (p, calibration);
    return p;
}

}   // namespace tactus::host::hid
