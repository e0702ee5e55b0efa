// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/sources/sources.hpp>
#include <tactus/plan/plan.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

/// A plan as one function.
struct FusedCode
{
    enum class Language
    {
        cpp,   ///< C++, for the system's compiler
        llvm   ///< LLVM's assembly language, for LLVM and the bitcode that the program contains
    };

    Language language = Language::cpp;

    /// The function's name, without its namespace. It has C linkage and the type of FusedTick::tick.
    static constexpr const char* function = "tactus_fused_tick";

    /// The most records that are fused: a compiler takes a minute for them.
    static constexpr std::size_t most_records = 3000;

    /// The header of what code calls for steps that are not nodes.
    static constexpr const char* parts = "tactus/run/generated/fused_parts.hpp";

    std::string text;                ///< the same for each plan of the same shape
    std::set<std::string> headers;   ///< what it includes, as in sourceFiles(), or whose bitcode it calls
    std::vector<void*> objects;      ///< see FusedTick
    std::size_t fused = 0;           ///< number of records that the code contains
    std::size_t called = 0;          ///< number of records that it calls as the plan does: those of plugins, and of bypassed nodes

    /// The classes of node types that are not in nodes/, by id. The compiler has to find their headers.
    using Classes = std::map<std::string, NodeClass, std::less<>>;

    /// Writes the code of a plan, which may be running. Empty if the plan has too many records. [main thread]
    static FusedCode of (const Plan&, const Classes& more = {});
    static FusedCode wiringOf (const Plan&);   ///< for LLVM
};

}   // namespace tactus::host
