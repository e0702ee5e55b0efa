// SPDX-License-Identifier: MIT
#include "mesh_parts.hpp"

namespace tactus::readers
{

namespace
{
/// The next line that is not empty, without its comment.
std::string_view nextLine (Lines& lines)
{
    while (const auto line = lines.next())
    {
        auto said = line->substr (0, line->find ('#')), first = said;
        if (! takeWord (first).empty()) return said;
    }
    throw MeshProblem { "mesh/truncated", "it ends before its last point or face", lines.number() };
}
}   // namespace

/// Reads OFF; ignores the normals, colours and texture coordinates of NOFF, COFF and STOFF.
void readOff (std::string_view bytes, MeshBuilder& mesh)
{
    Lines lines (bytes);
    auto line = nextLine (lines), counts = line;
    if (const auto keyword = takeWord (line); keyword.ends_with ("OFF"))
    {
        if (keyword.find_first_of ("4n") != std::string_view::npos)
            throw MeshProblem { "mesh/syntax", "its points have more than three coordinates", lines.number() };
        auto rest = line;
        counts = takeWord (rest).empty() ? nextLine (lines) : line;
    }
    if (auto rest = counts; takeWord (rest) == "BINARY")
        throw MeshProblem { "mesh/syntax", "binary OFF files are not supported, only text ones", lines.number() };
    const auto points = wholeNumber (takeWord (counts), lines.number());
    const auto faces = wholeNumber (takeWord (counts), lines.number());

    for (long long i = 0; i < points; ++i)
    {
        auto at = nextLine (lines);
        mesh.point (takePoint (at, lines.number()), lines.number());
    }
    std::vector<long long> corners;
    for (long long i = 0; i < faces; ++i)
    {
        auto face = nextLine (lines);
        corners.clear();
        auto left = wholeNumber (takeWord (face), lines.number());
        if (left > 2) checkBudget (&Budgets::triangles, static_cast<std::size_t> (left - 2), lines.number());   // before the corners are stored
        for (; left > 0; --left)
            corners.push_back (wholeNumber (takeWord (face), lines.number()));
        mesh.face (corners, lines.number());
    }
}

}   // namespace tactus::readers
