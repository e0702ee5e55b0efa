// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "text.hpp"

#include <framework/assets.hpp>

#include <map>
#include <span>
#include <string>

namespace tactus::host
{

/// Thrown by what is below, caught by readMesh.
struct MeshProblem
{
    std::string id, what;
    std::size_t line = 0;   ///< 0: the file has no lines
};

/// A mesh as it is read. Points and faces come in the order of the file, and faces name points by their number there.
class MeshBuilder
{
public:
    void point (const Vec3&, std::size_t line = 0);
    void face (std::span<const long long> corners, std::size_t line = 0);

    long long points() const noexcept { return static_cast<long long> (joined.size()); }   ///< so far

    /// What was read, with points welded that are nearer than a millionth of its size, as programs write the same corner
    /// differently in its last digit; and without triangles that have no area.
    Mesh take() const;

private:
    Mesh made;
    std::vector<int> joined;                      // number in the file to number in the mesh
    std::map<std::array<double, 3>, int> known;   // points at the very same place are one
};

/// Three coordinates off the front of a line.
Vec3 takePoint (std::string_view& line, std::size_t number);

/// A word that must be a whole number.
long long wholeNumber (std::string_view word, std::size_t line);

void readObj (std::string_view bytes, MeshBuilder&);
void readOff (std::string_view bytes, MeshBuilder&);
void readPly (std::string_view bytes, MeshBuilder&);
void readStl (std::string_view bytes, MeshBuilder&);

}   // namespace tactus::host
