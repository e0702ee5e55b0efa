// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// A source file of framework/ or nodes/, as the program contains it.
struct SourceFile
{
    std::string_view path;   ///< as it is included: "tactus/kit/law.hpp"
    std::string_view text;
};

/// All source files that exported code may need. [any thread]
std::span<const SourceFile> sourceFiles() noexcept;

/// The file with this path, or null.
const SourceFile* findSource (std::string_view path) noexcept;

/// The class of a node type and the header that defines it.
struct NodeClass
{
    std::string name;     ///< "tactus::nodes::Grating"
    std::string header;   ///< "tactus/nodes/texture/grating.hpp"
};

/// The class of a node type, by its id. Empty for a type that is not in nodes/.
NodeClass classOf (std::string_view id);

/// The paths of what a file includes, if it is one of ours by its name.
std::vector<std::string> includesOf (const SourceFile&);

/// The paths of these files, of everything that they include, and of the .cpp files that belong to these headers.
std::set<std::string> withIncludes (const std::set<std::string>& paths);

}   // namespace tactus::host
