// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "block.hpp"

#include <host/app/look/formula.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// Lines of formulas, typeset. Parts that are aligned in the source (after two spaces or more) are aligned here, too. The numbers of
/// equations are at the right, and what does not fit continues on the next line.
class FormulaBlock final : public Block
{
public:
    explicit FormulaBlock (const std::vector<std::string>& lines);

    /// A paragraph of text with formulas in it.
    static std::unique_ptr<FormulaBlock> paragraph (const std::string& text);

    int heightFor (int width) override;
    void paint (juce::Graphics&) override;

private:
    /// Runs without a space to break at.
    using Word = std::vector<FormulaRun>;

    struct Part
    {
        std::size_t column = 0;   ///< in the source, in characters
        bool is_formula = true;   ///< false: a remark
        bool is_number = false;   ///< of an equation, which goes to the right edge
        std::vector<Word> words {};
    };

    struct PlacedRun
    {
        const FormulaRun* run;
        juce::Point<float> at;   ///< left end of the base line
        bool is_formula;
    };

    /// The place for the next word, and where lines begin and end.
    struct Pen
    {
        float x = 0.0f, y = 0.0f, indent = 0.0f, right = 0.0f;
    };

    float widthOf (const Word&) const;
    float widthOf (const Part&) const;
    std::vector<std::pair<std::size_t, float>> columnsFor (float width) const;
    const std::vector<PlacedRun>& place (float width);
    Pen put (const Part&, Pen, std::vector<PlacedRun>&) const;
    juce::Font fontOf (FormulaRun::Level) const;

    std::vector<std::vector<Part>> lines;
    bool is_text = false;   // a paragraph

    // The latest layout, kept because measuring text is slow.
    float placed_for = -1.0f, placed_height = 0.0f;
    std::vector<PlacedRun> placed;
};

}   // namespace tactus::host
