// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "block.hpp"

#include <host/app/look/formula.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// Lines of formulas, typeset. Parts that stand below one another in the source (after two spaces or more) do so here; what does not fit
/// goes on below.
class FormulaBlock final : public Block
{
public:
    explicit FormulaBlock (const std::vector<std::string>& lines);

    int heightFor (int width) override;
    void paint (juce::Graphics&) override;

private:
    /// Runs without a space to break at.
    using Word = std::vector<FormulaRun>;

    struct Part
    {
        std::size_t column = 0;   ///< in the source, in characters
        bool is_formula = true;   ///< false: a remark
        std::vector<Word> words {};
    };

    struct Placed
    {
        const FormulaRun* run;
        juce::Point<float> at;   ///< left end of the base line
        bool is_formula;
    };

    float widthOf (const Word&) const;
    float widthOf (const Part&) const;
    std::vector<std::pair<std::size_t, float>> columnsFor (float width) const;
    std::vector<Placed> place (float width, float& height) const;
    juce::Font fontOf (FormulaRun::Level) const;

    std::vector<std::vector<Part>> lines;
};

}   // namespace tactus::host
