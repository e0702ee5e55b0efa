// SPDX-License-Identifier: GPL-3.0-or-later
#include "formula_block.hpp"

#include <host/app/look/fitted_text.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr float formula_size = 13.0f, small_size = 10.0f, formula_line = 20.0f, text_line = 17.0f, formula_gap = 16.0f, hanging = 16.0f;

/// Splits runs at the spaces of the base level.
std::vector<std::vector<FormulaRun>> breakWords (const std::vector<FormulaRun>& runs)
{
    std::vector<std::vector<FormulaRun>> words (1);
    for (const auto& run : runs)
    {
        if (run.level != FormulaRun::Level::base)
        {
            words.back().push_back (run);
            continue;
        }
        for (std::size_t begin = 0; begin <= run.text.size();)
        {
            const auto end = std::min (run.text.find (' ', begin), run.text.size());
            if (end > begin) words.back().push_back ({ run.text.substr (begin, end - begin) });
            if (end < run.text.size() && ! words.back().empty()) words.emplace_back();
            begin = end + 1;
        }
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

/// "(3)" and "(1) (2)", as equations have them at the right.
bool isEquationNumber (std::string_view part)
{
    return part.starts_with ('(') && part.ends_with (')') && part.find_first_not_of ("()0123456789 ") == std::string_view::npos
           && part.find_first_of ("0123456789") != std::string_view::npos;
}

bool looksLikeFormula (std::string_view part)
{
    return part.find ('=') != std::string_view::npos || part.find ("<-") != std::string_view::npos || part.find ("->") != std::string_view::npos;
}
}   // namespace

FormulaBlock::FormulaBlock (const std::vector<std::string>& texts)
{
    setInterceptsMouseClicks (false, false);
    for (const auto& text : texts)
    {
        auto& line = lines.emplace_back();
        for (std::size_t begin = text.find_first_not_of (' '); begin < text.size();)
        {
            const auto end = std::min (text.find ("  ", begin), text.size());
            const auto part = text.substr (begin, end - begin);
            line.push_back ({ begin, line.empty() || looksLikeFormula (part), isEquationNumber (part), breakWords (typeset (part)) });
            begin = std::min (text.find_first_not_of (' ', end), text.size());
        }
    }
}

juce::Font FormulaBlock::fontOf (FormulaRun::Level level) const
{
    return lookOf (*this).font (level == FormulaRun::Level::base ? formula_size : small_size);
}

float FormulaBlock::widthOf (const Word& word) const
{
    float width = 0.0f;
    for (const auto& run : word)
        width += fontOf (run.level).getStringWidthFloat (fromUtf8 (run.text));
    return width;
}

float FormulaBlock::widthOf (const Part& part) const
{
    const float space = fontOf (FormulaRun::Level::base).getStringWidthFloat (" ");
    float width = part.words.empty() ? 0.0f : space * static_cast<float> (part.words.size() - 1);
    for (const auto& word : part.words)
        width += widthOf (word);
    return width;
}

/// The places where the columns of the source begin: each to the right of all parts that end before it.
std::vector<std::pair<std::size_t, float>> FormulaBlock::columnsFor (float width) const
{
    std::vector<std::pair<std::size_t, float>> columns;
    for (const auto& line : lines)
        for (const auto& part : line)
            if (std::ranges::count (columns, part.column, &std::pair<std::size_t, float>::first) == 0) columns.emplace_back (part.column, 0.0f);
    std::ranges::sort (columns);
    const auto xOf = [&] (std::size_t column) -> float& { return std::ranges::find (columns, column, &std::pair<std::size_t, float>::first)->second; };
    for (auto& [column, x] : columns)
        for (const auto& line : lines)
            for (std::size_t i = 1; i < line.size(); ++i)
                if (const float end = xOf (line[i - 1].column) + widthOf (line[i - 1]); line[i].column == column && end < width)
                    x = std::max (x, end + formula_gap);
    return columns;
}

const std::vector<FormulaBlock::PlacedRun>& FormulaBlock::place (float width)
{
    if (width == placed_for) return placed;
    placed_for = width;
    placed.clear();
    const float step = is_text ? text_line : formula_line;
    const auto columns = columnsFor (width);
    float y = 0.0f;
    for (const auto& line : lines)
    {
        Pen pen { .y = y += step, .right = width - 1.0f };   // letters may reach beyond their width by a part of a pixel
        if (line.size() > 1 && line.back().is_number)
        {
            const float x = width - widthOf (line.back());
            put (line.back(), { .x = x, .y = y, .indent = x, .right = width }, placed);
            pen.right = x - formula_gap;
        }
        float end = 0.0f;
        for (const auto& part : line)
        {
            if (line.size() > 1 && part.is_number) continue;
            pen.x = pen.indent = std::max (end, std::ranges::find (columns, part.column, &std::pair<std::size_t, float>::first)->second);
            const bool is_narrow = pen.x > 0.4f * pen.right;
            if (&part != &line.front() && is_narrow && pen.x + widthOf (part) > pen.right)   // continues below
            {
                pen.x = hanging;
                pen.y += formula_line;
            }
            if (is_narrow || &part == &line.front()) pen.indent = is_text ? 0.0f : hanging;
            pen = put (part, pen, placed);
            end = pen.x + formula_gap;
        }
        y = pen.y;
    }
    placed_height = y;
    return placed;
}

/// Places the words of a part where the pen is. Returns where it is afterwards.
FormulaBlock::Pen FormulaBlock::put (const Part& part, Pen pen, std::vector<PlacedRun>& all) const
{
    const float space = fontOf (FormulaRun::Level::base).getStringWidthFloat (" ");
    bool is_first = true;
    for (const auto& word : part.words)
    {
        if (! std::exchange (is_first, false)) pen.x += space;
        if (pen.x + widthOf (word) > pen.right && pen.x > pen.indent)
        {
            pen.x = pen.indent;
            pen.y += is_text ? text_line : formula_line;
        }
        for (const auto& run : word)
        {
            const float shift = run.level == FormulaRun::Level::raised ? -5.0f : 3.0f;
            all.push_back ({ &run, { pen.x, pen.y - 6.0f + (run.level == FormulaRun::Level::base ? 0.0f : shift) }, part.is_formula });
            pen.x += fontOf (run.level).getStringWidthFloat (fromUtf8 (run.text));
        }
    }
    return pen;
}

std::unique_ptr<FormulaBlock> FormulaBlock::paragraph (const std::string& text)
{
    auto made = std::make_unique<FormulaBlock> (std::vector<std::string> {});
    made->is_text = true;
    made->lines.push_back ({ { .words = breakWords (typeset (text)) } });
    return made;
}

int FormulaBlock::heightFor (int width)
{
    place (static_cast<float> (width));
    return static_cast<int> (std::ceil (placed_height)) + 6;
}

void FormulaBlock::paint (juce::Graphics& g)
{
    const auto& theme = themeOf (*this);
    for (const auto& p : place (static_cast<float> (getWidth())))
    {
        juce::GlyphArrangement glyphs;   // keeps fractions of a pixel, so that the runs of a word stay together
        glyphs.addLineOfText (fontOf (p.run->level), fromUtf8 (p.run->text), p.at.x, p.at.y);
        g.setColour (p.is_formula ? theme.text : theme.dim);
        glyphs.draw (g);
    }
}

}   // namespace tactus::host
