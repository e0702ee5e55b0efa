// SPDX-License-Identifier: GPL-3.0-or-later
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

/// Replaces the records of running plans by compiled code (docs/fusion.md). The code is compiled in the background and takes over between two
/// ticks. After an edit, the new plan first runs by its records, and is fused when there has been no other edit for a while. If anything
/// fails, the plan keeps running by its records. [main thread]
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
        double rest_s = 0.5;        ///< how long a plan has to be in use before it is fused; the first plan need not wait
        double longest_s = 300.0;   ///< how long a compilation may take
    };

    explicit Fuser (Options);

    /// Call it several times a second with the newest plan of a run and the time in s. If the plan cannot be fused, returns the reason, once. Ids:
    /// those of FusionCompiler, fuse/too_long, fuse/too_large, fuse/nothing, fuse/cannot_load.
    std::optional<Message> look (const std::shared_ptr<Plan>&, double now_s);

    State state() const noexcept { return now; }
    std::string describe() const;   ///< what runs, for a status line: "plan" or "fused"
    std::string account() const;    ///< what was fused last, and how long it took: "40 of 41 steps in 3.2 s"

private:
    std::optional<Message> begin (double now_s);
    std::optional<Message> take (Plan&, double now_s);
    Message fail (Message);

    const Options options;
    FusionCompiler compiler;
    FusedCode code;
    State now = State::rests;
    std::uint64_t serial = 0;   // of the latest plan
    double since_s = 0.0;       // since when the plan has been in use, or the compiler has been working
    double took_s = 0.0;        // the last compilation
    bool gives_up = false;      // there is no compiler
};

}   // namespace tactus::host
