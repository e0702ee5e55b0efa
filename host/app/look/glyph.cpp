// SPDX-License-Identifier: GPL-3.0-or-later
#include "glyph.hpp"

#include <cmath>
#include <vector>

namespace tactus::host
{

namespace
{
using Points = std::vector<juce::Point<float>>;

juce::Path lines (std::initializer_list<Points> all)
{
    juce::Path path;
    for (const auto& points : all)
        for (std::size_t i = 0; i < points.size(); ++i)
            i == 0 ? path.startNewSubPath (points[i]) : path.lineTo (points[i]);
    return path;
}

template <typename F>
juce::Path curve (F y)
{
    juce::Path path;
    for (int i = 0; i <= 28; ++i)
    {
        const float x = 0.5f * static_cast<float> (i);
        const juce::Point<float> p { x, y (x / 14.0f) };
        i == 0 ? path.startNewSubPath (p) : path.lineTo (p);
    }
    return path;
}

float sine (float turns) { return std::sin (juce::MathConstants<float>::twoPi * turns); }
}   // namespace

juce::Path glyphOf (std::string_view family)
{
    // Each glyph suggests how the family feels or looks on a scope: stick-slip sawtooth, blade, dent, ridges, ringing, spike …
    if (family == "friction") return lines ({ { { 0, 12 }, { 5, 4 }, { 6, 11 }, { 11, 3 }, { 12, 10 }, { 14, 8 } } });
    if (family == "cut") return lines ({ { { 1, 1 }, { 9, 9 } }, { { 9, 9 }, { 7, 11 }, { 1, 1 } }, { { 0, 13 }, { 14, 13 } } });
    if (family == "deform") return curve ([] (float x) { return 5.0f + 7.0f * std::exp (-30.0f * (x - 0.5f) * (x - 0.5f)); });
    if (family == "texture") return curve ([] (float x) { return 7.0f - 3.5f * sine (3.0f * x); });
    if (family == "vibration") return curve ([] (float x) { return 7.0f - 6.5f * std::exp (-3.0f * x) * sine (4.0f * x); });
    if (family == "shock") return curve ([] (float x) { return 12.0f - 11.0f * std::exp (-60.0f * (x - 0.4f) * (x - 0.4f)); });
    if (family == "contact") return lines ({ { { 0, 12 }, { 14, 12 } }, { { 7, 1 }, { 7, 10 } }, { { 4, 7 }, { 7, 10 }, { 10, 7 } } });
    if (family == "coupling") return lines ({ { { 0, 7 }, { 2, 7 }, { 3, 3 }, { 5, 11 }, { 7, 3 }, { 9, 11 }, { 11, 3 }, { 12, 7 }, { 14, 7 } } });
    if (family == "field")
        return lines ({ { { 0, 3 }, { 4, 1 }, { 10, 5 }, { 14, 3 } },
                        { { 0, 7 }, { 4, 5 }, { 10, 9 }, { 14, 7 } },
                        { { 0, 11 }, { 4, 9 }, { 10, 13 }, { 14, 11 } } });
    if (family == "safety") return lines ({ { { 7, 1 }, { 13, 3 }, { 12, 9 }, { 7, 13 }, { 2, 9 }, { 1, 3 }, { 7, 1 } } });
    if (family == "hold") return lines ({ { { 0, 11 }, { 4, 11 }, { 4, 7 }, { 8, 7 }, { 8, 3 }, { 14, 3 } } });
    if (family == "motion") return lines ({ { { 0, 7 }, { 13, 7 } }, { { 9, 3 }, { 13, 7 }, { 9, 11 } } });
    if (family == "filter") return curve ([] (float x) { return 3.0f + 9.0f / (1.0f + std::exp (-14.0f * (x - 0.6f))); });
    if (family == "signal") return curve ([] (float x) { return 7.0f - 5.0f * sine (x); });
    if (family == "vector") return lines ({ { { 1, 13 }, { 12, 2 } }, { { 6, 2 }, { 12, 2 }, { 12, 8 } } });
    if (family == "layer") return lines ({ { { 7, 1 }, { 13, 4 }, { 7, 7 }, { 1, 4 }, { 7, 1 } },
                                           { { 1, 7 }, { 7, 10 }, { 13, 7 } },
                                           { { 1, 10 }, { 7, 13 }, { 13, 10 } } });
    if (family == "device") return lines ({ { { 2, 12 }, { 12, 12 } }, { { 7, 12 }, { 7, 7 }, { 11, 2 } } });
    if (family == "graph") return lines ({ { { 1, 1 }, { 13, 1 }, { 13, 13 }, { 1, 13 }, { 1, 1 } }, { { 4, 5 }, { 10, 9 } } });
    juce::Path dot;
    dot.addEllipse (5, 5, 4, 4);
    return dot;
}

}   // namespace tactus::host
