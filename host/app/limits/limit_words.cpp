// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_words.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace tactus::host
{

namespace
{
/// The subject of a condition. Some are about what the device lacks, the others about what the graph asks for.
struct LimitNoun
{
    const char *id, *noun;
    bool is_of_device = false;
};

constexpr LimitNoun nouns[] {
    { "stiffness", NEEDS_TRANS ("The stiffness") },
    { "coupling", NEEDS_TRANS ("The stiffness between the hands") },
    { "curl", NEEDS_TRANS ("The turning force") },
    { "jump", NEEDS_TRANS ("The step of the force") },
    { "damping", NEEDS_TRANS ("The virtual damping") },
    { "peak_force", NEEDS_TRANS ("The largest force") },
    { "slew", NEEDS_TRANS ("The fastest change of force") },
    { "deadbeat", NEEDS_TRANS ("The wall") },
    { "blow", NEEDS_TRANS ("The blow of the damper") },
    { "scanning", NEEDS_TRANS ("The speed of strokes") },
    { "gain", NEEDS_TRANS ("The slope of the texture") },
    { "structural", NEEDS_TRANS ("The frequency of the texture") },
    { "quantum", NEEDS_TRANS ("The position sensor"), true },
    { "d_max", NEEDS_TRANS ("The position sensor"), true },
    { "low_speed", NEEDS_TRANS ("The position sensor"), true },
    { "high_speed", NEEDS_TRANS ("The position sensor"), true },
    { "force_resolution", NEEDS_TRANS ("The steps of force"), true },
};

/// "4.02e+03 N*s/m" as "4020 N·s/m".
std::string readableNumbers (const std::string& text)
{
    std::string all;
    for (std::size_t i = 0; i < text.size();)
    {
        const bool begins = std::isdigit (static_cast<unsigned char> (text[i])) != 0 && (i == 0 || text[i - 1] == ' ');
        char* end = nullptr;
        const double v = begins ? std::strtod (text.c_str() + i, &end) : 0.0;
        const auto length = begins ? static_cast<std::size_t> (end - (text.c_str() + i)) : 1;
        const auto part = text.substr (i, length);
        const bool has_exponent = begins && part.find ('e') != part.npos;
        all += has_exponent ? (v >= 1.0 ? numberText (std::round (v)) : roundedText (v, 2)) : part;
        i += length;
    }
    return fromUtf8 (unitShown (all)).replace (" um", fromUtf8 (" \xc2\xb5m")).toStdString();
}
}   // namespace

std::string twoDigits (double v)
{
    if (! (v > 0.0) || ! std::isfinite (v)) return "0";
    const double unit = std::pow (10.0, std::floor (std::log10 (v)) - 1.0);
    if (std::abs (v - 1.0) < 0.1) return roundedText (v, 3);
    return v >= 10.0 ? numberText (std::round (v / unit) * unit) : roundedText (v, 2);
}

bool isPastPassivity (const check::Condition& c)
{
    const bool is_contact = c.id == "stiffness" || c.id == "coupling";
    return is_contact && c.verdict == check::Verdict::stable && c.value > c.limit && std::isfinite (c.may_grow);
}

bool isMostlyDamping (const check::Condition& c)
{
    return c.id == "stiffness" && c.loops.size() < 2 && c.damping > 0.5 * c.value && (c.value <= c.limit || c.damping >= c.limit);
}

std::string limitSentence (const check::Condition& c, const std::string& node, const std::string& device)
{
    const auto* found = std::ranges::find (nouns, isMostlyDamping (c) ? "damping" : c.id, &LimitNoun::id);
    const auto noun = found == std::end (nouns) ? juce::String (std::string (c.id)) : juce::translate (found->noun);
    const bool of_device = found != std::end (nouns) && found->is_of_device;
    const auto role = filled ("%1 (%2)", printableName (c.role), printableName (device));
    constexpr double matters = 0.01;
    const bool has_damping = c.damping > matters * c.value || c.loops.size() > 1;   // how much of a single loop is damping is not known
    auto who = node.empty() ? TRANS ("the graph") : juce::String (printableName (node));
    if (isMostlyDamping (c))
    {
        if (c.value - c.damping > matters * c.value) who = filled (TRANS ("%1 together with its stiffness"), who);
    }
    else if (c.id == "stiffness" && has_damping)
        who = filled (TRANS ("%1 together with its damping"), who);
    const double margin = c.margin();
    const bool has_factor = margin > 0.0 && std::isfinite (margin) && (c.isBroken() == (margin < 1.0));
    const auto percent = std::to_string (static_cast<int> (std::floor (100.0 / std::max (1.0, margin))));
    juce::String text;
    if (! c.isKnown())
        text = c.verdict == check::Verdict::not_reached ? filled (TRANS ("The hand does not reach %1, so that it is not judged"), who)
                                                        : filled (TRANS ("%1 of %2 is not judged for %3"), noun, who, role);
    else if (of_device && c.isBroken())
        text = has_factor ? filled (TRANS ("%1 of %2 is too coarse for %3 by a factor of %4"), noun, role, who, twoDigits (1.0 / margin))
                          : filled (TRANS ("%1 of %2 is too coarse for %3"), noun, role, who);
    else if (of_device)
        text = filled (TRANS ("%1 of %2 is nearly too coarse for %3"), noun, role, who);
    else if (c.verdict == check::Verdict::unstable && std::isnan (c.may_grow))   // only trials say so
        text = filled (TRANS ("The tool of %1 does not come to rest at %2"), role, who);
    else if (c.isBroken())
        text = has_factor ? filled (TRANS ("%1 of %2 is %3 times what %4 allows"), noun, who, twoDigits (1.0 / margin), role)
                          : filled (TRANS ("%1 of %2 is more than %3 allows"), noun, who, role);
    else if (isPastPassivity (c))
        text = filled (TRANS ("%1 of %2 is not passive on %3, but rests with usual hands"), noun, who, role);
    else if (c.id == "stiffness" && (c.verdict == check::Verdict::passive || c.verdict == check::Verdict::passive_here))
        text = filled (TRANS ("%1 of %2 is at %3 % of what is passive on %4"), noun, who, percent, role);
    else
        text = filled (TRANS ("%1 of %2 is at %3 % of what %4 allows"), noun, who, percent, role);
    return text.toStdString();
}

std::string firstRemedy (const check::Condition& c)
{
    const auto passive = isPastPassivity (c) ? c.remedy.find ("for a contact that is passive") : 0;
    auto first = c.remedy.substr (passive == c.remedy.npos ? 0 : passive);
    first.erase (std::min (first.size(), first.find ("; ")));
    if (const auto about = first.rfind (": "); about != first.npos) first.erase (0, about + 2);
    first.erase (std::min (first.size(), first.find (", ")));
    return readableNumbers (first);
}

}   // namespace tactus::host
