// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_size.hpp"

#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
/// Reads a positive number at the start of the text, and removes it. Returns 0 if there is none.
double takeNumber (std::string_view& text)
{
    const auto number = readNumber (text);
    if (! number.is_in_range || ! (number.value > 0.0 && number.value < 1e4)) return 0.0;
    text.remove_prefix (number.size);
    return number.value;
}
}   // namespace

std::pair<Option, Option> FigureSize::addSize (const Command& command)
{
    const auto paper = command.addOption ("--size", size, "The size of the plot on paper in mm, such as 120x80, or only its width; default: 212 wide");
    const auto fineness = command.addOption ("--dpi", dots_per_inch, "Pixels per inch of a .png; default: 192").check (finiteWithin (30.0, 2400.0));
    return { paper, fineness };
}

void FigureSize::readSize()
{
    double width_mm = 25.4 * 800.0 / 96.0, height_mm = 0.0;
    if (! size.empty())
    {
        std::string_view rest = size;
        width_mm = takeNumber (rest);
        const bool has_height = width_mm > 0.0 && rest.starts_with ('x');
        if (has_height)
        {
            rest.remove_prefix (1);
            height_mm = takeNumber (rest);
        }
        if (width_mm == 0.0 || (has_height && height_mm == 0.0) || ! rest.empty())
            throw UsageError ("--size", quote (size) + " is not a size in mm, such as 120x80 or 120");
    }
    dpi = dots_per_inch;
    width = static_cast<int> (std::lround (width_mm / 25.4 * dpi));
    height = static_cast<int> (std::lround (height_mm / 25.4 * dpi));
}

}   // namespace tactus::host
