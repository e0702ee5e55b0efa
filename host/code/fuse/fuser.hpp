// SPDX-License-Identifier: MIT
#pragma once

#include "fusion_compiler.hpp"

#include <tactus/plan/plan.hpp>
#include <tactus/text/message.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tactus::host
{

/// Replaces the records of running plans by compiled code (docs/fusion.md). The code is made in the background, by LLVM or, if that fails, by
/// the system's compiler, and takes over between two ticks. After an edit, the new plan first runs by its records, and is fused when there has
/// been no other edit for a while. If anything fails, the plan keeps running by its records. [main thread]
class Fuser
{
public:
    enum class State
    {
        rests,      ///< the plan is new, and may be replaced soon
        compiles,   ///< code for the plan is being made
        fused,      ///< the plan runs as compiled code
        fails       ///< the plan runs by its records, because it could not be fused
    };

    struct Options
    {
        FusionCompiler::Options compiler {};
        double rest_s = 0.5;            ///< how long a plan has to be in use before it is fused; the first plan need not wait
        double longest_s = 300.0;       ///< how long the compiler may take
        double longest_llvm_s = 60.0;   ///< how long LLVM may take
        bool uses_llvm = true;          ///< false: only the compiler
    };

    explicit Fuser (Options);

    /// Call it several times a second with the newest plan of a run and the time in s. If the plan cannot be fused, returns the reason, once. Ids:
    /// those of FusionCompiler, fuse/too_long, fuse/too_large, fuse/nothing, fuse/cannot_load. The first call returns what is wrong with the
    /// cache: fuse/cache.
    std::optional<Message> poll (const std::shared_ptr<Plan>&, double now_s);

    State state() const noexcept { return now; }
    std::string describe() const;   ///< what runs, for a status line: "plan" or "fused"
    std::string account() const;    ///< what was fused last, and how long it took: "40 of 41 steps in 0.2 s, by LLVM"

private:
    std::optional<Message> begin (const Plan&, double now_s);
    std::optional<Message> beginWith (FusedCode::Language, const Plan&, double now_s);
    std::optional<Message> take (Plan&, double now_s);
    std::optional<Message> load (Plan&, const std::filesystem::path&);
    std::optional<Message> orElse (Message, const Plan&, double now_s);
    double longest() const;
    Message fail (Message);

    const Options options;
    FusionCompiler compiler;
    FusedCode code;
    State now = State::rests;
    bool has_begun = false;
    std::uint64_t serial = 0;                 // of the latest plan
    double since_s = 0.0;                     // since when the plan has been in use, or the compiler has been working
    double took_s = 0.0;                      // the last compilation
    bool tries_llvm, tries_compiler = true;   // false once it could not be started
};

}   // namespace tactus::host
