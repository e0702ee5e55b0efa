// SPDX-License-Identifier: MIT
#include "flat.hpp"

#include <tactus/text/budget.hpp>

#include <algorithm>
#include <set>

namespace tactus::plan
{

namespace
{
void appendEscaped (std::string& pointer, std::string_view name)
{
    for (const char c : name)
        if (c == '~')
            pointer += "~0";
        else if (c == '/')
            pointer += "~1";
        else
            pointer += c;
}

/// The JSON pointer of a place within its file.
std::string pointerTo (Origin place)
{
    if (place == nullptr || place->kind == Place::Kind::file) return {};
    auto pointer = pointerTo (place->around);
    if (place->kind != Place::Kind::as_is) pointer += '/';
    if (place->kind == Place::Kind::entry)
        pointer += std::to_string (place->number);
    else if (place->kind == Place::Kind::name)
        appendEscaped (pointer, place->text);
    else
        pointer += place->text;
    return pointer;
}

Message messageAt (Origin origin, Message::Severity severity, std::string id, std::string text, std::string remedy)
{
    const auto file = fileOf (origin);
    auto m = Message::error (std::move (id), pointerTo (origin), std::move (text), std::move (remedy));
    m.severity = severity;
    if (file != nullptr) m.file = file->text;
    return m;
}

/// Turns a sentence about "finger[3]/drag", or about 'finger[3]', into one about "finger/drag" or 'finger'.
std::string withoutInstances (const std::string& text)
{
    std::string result;
    std::size_t copied = 0;
    for (auto end = text.find (']'); end != std::string::npos; end = text.find (']', end + 1))
    {
        const auto begin = text.rfind ('[', end);
        const bool follows_name = end + 1 < text.size() && (text[end + 1] == '/' || text[end + 1] == '\'');
        if (! follows_name || begin == std::string::npos || begin < copied) continue;
        result.append (text, copied, begin - copied);
        copied = end + 1;
    }
    return result.append (text, copied);
}
}   // namespace

Origin fileOf (Origin place) noexcept
{
    while (place != nullptr && place->kind != Place::Kind::file)
        place = place->around;
    return place;
}

std::span<double> Flat::param (int number, std::size_t row) noexcept
{
    const auto& n = node (number);
    auto first = n.values;
    for (std::size_t p = 0; p < row; ++p)
        first += tactus::at (n.slots (n.type->params[p]));
    return { values.data() + first, tactus::at (n.slots (n.type->params[row])) };
}

std::string Flat::nameOf (const PortRef& r) const
{
    auto name = node (r).path + "." + std::string (sheet (r).id);
    if (r.index >= 0) name += "[" + std::to_string (r.index) + "]";
    if (r.component >= 0) name += std::string (".") + "xyz"[r.component];
    return name;
}

std::vector<int> Flat::sectionsBetween (int around, int within) const
{
    std::vector<int> between;
    for (int s = within; s != around; s = section (s).around)
        between.push_back (s);
    std::ranges::reverse (between);
    return between;
}

double Flat::speed (int s) const
{
    double up = 1.0, down = 1.0;   // kept separate, so that equal rates are bit-identical
    for (; s > 0; s = section (s).around)
        (section (s).kind == Section::Kind::times ? up : down) *= section (s).factor;
    return up / down;
}

int Flat::ticksOf (int s) const
{
    int ticks = 1;
    for (; s > 0; s = section (s).around)
        if (section (s).kind == Section::Kind::every) ticks *= section (s).factor;
    return ticks;
}

bool Flat::rests (int s) const { return ticksOf (s) > 1; }

std::vector<std::uint64_t> Flat::restPeriods() const
{
    std::set<std::uint64_t> all;
    for (int s = 1; s < sectionCount(); ++s)
        if (rests (s)) all.insert (static_cast<std::uint64_t> (ticksOf (s)));
    return { all.begin(), all.end() };
}

bool Flat::spend (double work, double memory, Origin origin)
{
    spent.work += work;
    spent.memory += memory;
    const auto& most = budgets();
    if (work_unit_s * spent.work <= most.time && spent.memory <= most.memory) return ! spent.is_over;
    const auto check = [&] (double Budgets::*which, double needed) {
        if (spent.is_over || needed <= budgets().*which) return;
        spent.is_over = true;
        auto over = overBudget ("graph/too_large", which, "with this, the graph", needed, "use fewer instances, or smaller settings");
        error (std::move (over.id), origin, std::move (over.text), std::move (over.remedy));
    };
    check (&Budgets::time, work_unit_s * spent.work);
    check (&Budgets::memory, spent.memory);
    return ! spent.is_over;
}

void Flat::error (std::string id, Origin origin, std::string text, std::string remedy)
{
    if (! isFull()) add (messageAt (origin, Message::Severity::error, std::move (id), std::move (text), std::move (remedy)));
}

void Flat::warn (std::string id, Origin origin, std::string text, std::string remedy)
{
    if (! isFull()) add (messageAt (origin, Message::Severity::warning, std::move (id), std::move (text), std::move (remedy)));
}

void Flat::add (Message m)
{
    if (auto key = withoutInstances (m.text); key.size() < m.text.size() && ! reported.insert (m.id + m.file + m.where + key).second) return;
    messages.push_back (std::move (m));
}

}   // namespace tactus::plan
