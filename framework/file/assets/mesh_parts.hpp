// SPDX-License-Identifier: MIT
#pragma once

#include "lines.hpp"

#include <tactus/kit/assets.hpp>
#include <tactus/text/budget.hpp>

#include <map>
#include <span>
#include <string>

namespace tactus::readers
{

/// Thrown by the functions below and caught by readMesh.
struct MeshProblem
{
    std::string id, what;
    std::size_t line = 0;      ///< line number; 0 for a binary file
    std::string remedy = {};   ///< "": the remedy for a broken file
};

/// Throws if this many points or triangles exceed their budget.
void checkBudget (double Budgets::*which, std::size_t count, std::size_t line);

/// Builds a mesh while the file is read. Points and faces are added in the order of the file, and faces refer to points by
/// their number in the file.
class MeshBuilder
{
public:
    void point (const Vec3&, std::size_t line = 0);
    void face (std::span<const long long> corners, std::size_t line = 0);

    long long points() const noexcept { return static_cast<long long> (joined.size()); }   ///< number of points added so far

    /// The finished mesh. Points closer than a millionth of its size are merged, since programs write the same corner with
    /// different last digits; triangles without area are dropped.
    Mesh take() const;

private:
    Mesh made;
    std::vector<int> joined;                      // maps the index in the file to the index in the mesh
    std::map<std::array<double, 3>, int> known;   // the index in the mesh, by coordinates; merges identical points
};

/// Removes three coordinates from the front of a line.
Vec3 takePoint (std::string_view& line, std::size_t number);

/// Reads a word that must be a whole number.
long long wholeNumber (std::string_view word, std::size_t line);

void readObj (std::string_view bytes, MeshBuilder&);
void readOff (std::string_view bytes, MeshBuilder&);
void readPly (std::string_view bytes, MeshBuilder&);
void readStl (std::string_view bytes, MeshBuilder&);

}   // namespace tactus::readers
