// SPDX-License-Identifier: MIT
#include "tick_code.hpp"

#include <algorithm>

namespace tactus::host
{

std::string TickCode::statements()
{
    write();
    return std::move (code);
}

void TickCode::begin()
{
    CppWalk::begin();
    indent = 4;
}

void TickCode::walk()
{
    records (plan.settled());   // on each tick, because exported code does not know which params were written
    records (plan.records());
    for (const auto& tap : plan.taps())
        if (tap.samples == nullptr) read (tap.value);
}

void TickCode::sum (const plan::Sum& s)
{
    if (wiring.isRead (&s.out)) line (wiring.target (&s.out, "auto") + " = " + sumOf (s) + ";");
}

void TickCode::strike (const plan::Strike& s)
{
    const auto target = wiring.isRead (&s.out) ? wiring.target (&s.out) + " = " : Text {};
    line (target + "hits[" + std::to_string (wiring.hitOf (s.pulse)) + "] (" + read (s.from) + ");");
}

void TickCode::readDelay (const plan::Line& wire)
{
    if (wiring.isRead (&wire.out)) line (wiring.target (&wire.out) + " = " + wiring.object (&wire) + ".read();");
}

void TickCode::writeDelay (const plan::Line& wire, const double* from) { line (wiring.object (&wire) + ".write (" + read (from) + ");"); }

void TickCode::bypass (const plan::Bypass& b, const Record& r)
{
    for (const auto& copy : b.copies)
    {
        if (! wiring.isRead (copy.to)) continue;
        Texts all;
        for (const auto slot : copy.slots)
            all.push_back (read (r.sources[slot]));
        const auto value = all.size() == 1 ? all.front() : all.empty() ? "0.0"
                                                                       : "sumOf (" + listText (all) + ")";
        line (wiring.target (copy.to) + " = " + value + ";   // bypassed");
    }
}

void TickCode::title (const PlanNode& n)
{
    line();
    line (titleOf (n));
}

void TickCode::peek (const PlanNode& n)
{
    if (exported (n).is_read) line (result (exported (n)) + n.name + ".peek();");
}

void TickCode::tick (const PlanNode& n, const Texts& inputs, const Text& stored, const Text& reset)
{
    const bool has_result = ! type (n).peek && exported (n).is_read;
    callTick (n, has_result ? result (exported (n), reset.empty() ? "const auto " : "auto ") : Text {}, inputs, stored);
    if (has_result && ! reset.empty()) line ("if (" + reset + ".fault) " + PlanNames::outputsOf (exported (n)) + " = {};");
}

std::pair<TickCode::Text, TickCode::Text> TickCode::placeOf (const PlanNode& n, const plan::DrivenNode::Drive& drive)
{
    const auto& knobs = plan.instances()[n.instance].knobs->all;
    std::size_t number = exported (n).parameters, knob = 0;
    for (const auto& row : type (n).params)
    {
        for (int k = 0; k < flat (n).slots (row); ++k, ++number)
            if (&knobs[knob + at (k)].value == drive.stored) return { read (drive.target), "parameters.stored (" + std::to_string (number) + ")" };
        knob += plan::Knobs::roomOf (row);
    }
    return {};
}

TickCode::Text TickCode::store (const PlanNode& n, const plan::DrivenNode&, const plan::DrivenNode::Drive& drive)
{
    const auto [target, value] = placeOf (n, drive);
    return n.name + "_stored" + target.substr ((n.name + ".params").size()) + " = " + value + ";";
}

void TickCode::convert (Action action, const plan::ConversionLink& link, const Text& part)
{
    const auto object = wiring.object (link.converter), from = read (link.from);
    if (action == Action::latch) line (object + ".out = " + from + ";");
    if (action == Action::silence) line (object + ".out = 0.0;");
    if (action == Action::gather) line (object + ".gather (" + from + ");");
    if (action == Action::deliver) line (object + ".deliver();");
    if (action == Action::head) line (object + ".head (" + from + ");");
    if (action == Action::follow) line (object + ".follow (" + from + ", " + part + ");");
}

void TickCode::section (const SectionStep& s, const Body& body)
{
    const auto name = comment (wiring.sections.at (&s.running)), factor = std::to_string (s.running.factor);
    line();
    if (s.kind == plan::Section::Kind::times)
    {
        line ("// " + name + " runs " + factor + " times a tick");
        return body();
    }
    line ("{   // " + name + " runs on every tick of " + factor);
    indent += 4;
    body();
    indent -= 4;
    line ("}");
}

TickCode::Text TickCode::samples (const double* first)
{
    const auto tap = std::ranges::find (plan.taps(), first, &Tap::samples);
    return "out." + wiring.tap_names[static_cast<std::size_t> (tap - plan.taps().begin())];
}

}   // namespace tactus::host
