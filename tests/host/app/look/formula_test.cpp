// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/inspector/blocks/formula_block.hpp>
#include <host/app/look/formula.hpp>
#include <host/app/model/node_doc.hpp>
#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// The runs as text: raised parts in ^{}, lowered ones in _{}.
std::string written (std::string_view formula)
{
    std::string text;
    for (const auto& run : typeset (formula))
    {
        if (run.level == FormulaRun::Level::base) text += run.text;
        if (run.level == FormulaRun::Level::raised) text += "^{" + run.text + "}";
        if (run.level == FormulaRun::Level::lowered) text += "_{" + run.text + "}";
    }
    return text;
}
}   // namespace

TEST_CASE ("formulas are typeset with Greek letters, raised and lowered parts, and signs", "[app][formula]")
{
    CHECK (written ("sigma = mu f_n / d_max") == "σ = μ f_{n} / d_{max}");
    CHECK (written ("value = gain sum_i a_i v e^(-decay_i t)") == "value = gain Σ_{i} a_{i} v e^{−decay_i t}");
    CHECK (written ("m d'' = -N,  d >= 0") == "m d'' = −N,  d ≥ 0");
    CHECK (written ("c <- c + |dp| zeta d~") == "c ← c + |dp| ζ d~");
    CHECK (written ("n . p * 2") == "n · p · 2");
    CHECK (written ("H(s) = 1 / (s^2 + sqrt (2) s + 1)") == "H(s) = 1 / (s^{2} + √(2) s + 1)");
    CHECK (written ("g0^-1 (x)") == "g_{0}^{−1} (x)");
    CHECK (written ("u^nu, E_(n-1), f_k") == "u^{ν}, E_{n−1}, f_{k}");
    CHECK (written ("dE / dphi") == "dE / dφ");
}

TEST_CASE ("names of params, numbers and words stay as they are in a formula", "[app][formula]")
{
    CHECK (written ("d_ba = break_away d_max") == "d_{ba} = break_away d_{max}");
    CHECK (written ("1e-9 m, 2.5e3 N") == "1e-9 m, 2.5e3 N");
    CHECK (written ("up to rupture_force, cold-forged") == "up to rupture_force, cold-forged");
    CHECK (written ("adhesion `stick`: it yields") == "adhesion stick: it yields");
    CHECK (written ("sum of d_i") == "sum of d_{i}");
    CHECK (written ("").empty());
    CHECK (written ("^") == "^");
    CHECK (written ("a_(b") == "a_{b}");
}

TEST_CASE ("the laws of all nodes are typeset without leftovers, and fit the help and the inspector", "[app][formula]")
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    for (const auto& type : catalogue())
    {
        const auto law = lawOf (type.info.id);
        if (law.empty()) continue;
        INFO (type.info.id);
        for (const auto& line : law)
            for (const auto& run : typeset (line))
                CHECK (run.text.find ('^') == std::string::npos);
        FormulaBlock block (law);
        const int wide = block.heightFor (512), narrow = block.heightFor (264);
        CHECK (wide >= static_cast<int> (law.size()) * 20);
        CHECK (narrow >= wide);
        block.setBounds (0, 0, 264, narrow);
        const auto picture = block.createComponentSnapshot (block.getLocalBounds());
        int at_edge = 0;   // text that is cut off would touch the right edge
        for (int y = 0; y < picture.getHeight(); ++y)
            at_edge += picture.getPixelAt (263, y).getAlpha() > 0 ? 1 : 0;
        CHECK (at_edge == 0);
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}

TEST_CASE ("a paragraph wraps at its width, and typesets the symbols in it", "[app][formula]")
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    const std::string text = "Pulled further than d_max, it is dragged along and the hand feels mu f_n. A long d_max feels like rubber or flesh.";
    const auto block = FormulaBlock::paragraph (text);
    const int one = FormulaBlock::paragraph ("short")->heightFor (512);
    CHECK (block->heightFor (2000) == one);
    CHECK (block->heightFor (512) > one);
    CHECK (block->heightFor (264) > block->heightFor (512));
    CHECK (block->heightFor (2000) == one);   // placed again for each width
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}
