// SPDX-License-Identifier: MIT
#include "mesh_parts.hpp"

#include <string>

namespace tactus::readers
{

/// Reads points and faces; everything else (normals, texture, groups, materials, curves) is ignored. A corner is
/// written point/texture/normal, counted from 1, or backwards from the last point if negative.
void readObj (std::string_view bytes, MeshBuilder& mesh)
{
    Lines lines (bytes);
    std::vector<long long> corners;
    std::string joined;
    while (auto line = lines.next())
    {
        // A backslash continues a line.
        while (line->ends_with ('\\'))
        {
            if (joined.data() != line->data()) joined = *line;
            joined.back() = ' ';
            const auto more = lines.next();
            if (! more) throw MeshProblem { "mesh/truncated", "its last line ends with a backslash", lines.number() };
            joined += *more;
            checkBudget (&Budgets::numbers, joined.size(), lines.number());
            line = joined;
        }
        const auto keyword = takeWord (*line);
        if (keyword == "v") mesh.point (takePoint (*line, lines.number()), lines.number());
        if (keyword != "f") continue;

        corners.clear();
        for (auto word = takeWord (*line); ! word.empty() && word[0] != '#'; word = takeWord (*line))
        {
            const auto number = wholeNumber (word.substr (0, word.find ('/')), lines.number());
            corners.push_back (number < 0 ? mesh.points() + number : number - 1);
            if (corners.size() > 2) checkBudget (&Budgets::triangles, corners.size() - 2, lines.number());
        }
        mesh.face (corners, lines.number());
    }
}

}   // namespace tactus::readers
