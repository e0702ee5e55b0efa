// SPDX-License-Identifier: MIT
#include "fuser.hpp"
#include "bitcode.hpp"
#include "load_fused.hpp"

#include <tactus/text/number_text.hpp>

#include <cmath>
#include <utility>

namespace tactus::host
{

Fuser::Fuser (Options o) : options (std::move (o)), compiler (options.compiler), tries_llvm (options.uses_llvm && ! allBitcode().empty()) {}

std::string Fuser::describe() const
{
    switch (now)
    {
    case State::fused:
        return "fused";
    case State::compiles:
        return "plan, fusing";
    case State::rests:
    case State::fails:
        break;
    }
    return "plan";
}

std::string Fuser::account() const
{
    const auto all = std::to_string (code.fused + code.called), seconds = numberText (std::round (10.0 * took_s) / 10.0);
    const auto* by = code.language == FusedCode::Language::llvm ? " s, by LLVM" : " s, by the compiler";
    return std::to_string (code.fused) + " of " + all + " steps in " + seconds + by;
}

Message Fuser::fail (Message why)
{
    now = State::fails;
    compiler.stop();
    why.severity = Message::Severity::warning;
    return why;
}

std::optional<Message> Fuser::poll (const std::shared_ptr<Plan>& plan, double now_s)
{
    if (! std::exchange (has_begun, true) && compiler.cacheTrouble()) return compiler.cacheTrouble();
    if (plan->serial() != serial)
    {
        const bool is_first = std::exchange (serial, plan->serial()) == 0;
        compiler.stop();
        now = State::rests;
        since_s = is_first ? now_s - options.rest_s : now_s;
    }
    if (! tries_llvm && ! tries_compiler) now = State::fails;
    if (now == State::compiles) return take (*plan, now_s);
    if (now != State::rests || now_s - since_s < options.rest_s) return std::nullopt;
    return begin (*plan, now_s);
}

std::optional<Message> Fuser::begin (const Plan& plan, double now_s)
{
    return beginWith (tries_llvm ? FusedCode::Language::llvm : FusedCode::Language::cpp, plan, now_s);
}

std::optional<Message> Fuser::beginWith (FusedCode::Language language, const Plan& plan, double now_s)
{
    const bool is_llvm = language == FusedCode::Language::llvm;
    code = is_llvm ? FusedCode::wiringOf (plan) : FusedCode::of (plan);
    if (code.text.empty())
        return fail (Message::warning ("fuse/too_large", {},
                                       "the graph has more than " + std::to_string (FusedCode::most_records) + " steps, so it is not fused",
                                       "the run continues as it is"));
    if (code.fused == 0)
        return fail (Message::warning ("fuse/nothing", {}, "the graph has nothing to fuse: the code of its nodes is in plugins", "the run continues as it is"));
    since_s = now_s;
    now = State::compiles;
    const auto started = compiler.start (code);
    if (started) return std::nullopt;
    (is_llvm ? tries_llvm : tries_compiler) = false;
    return orElse (started.error(), plan, now_s);
}

/// Tries the compiler after LLVM has failed. If the compiler has failed, gives up for this plan.
std::optional<Message> Fuser::orElse (Message why, const Plan& plan, double now_s)
{
    if (code.language == FusedCode::Language::llvm && tries_compiler) return beginWith (FusedCode::Language::cpp, plan, now_s);
    return fail (std::move (why));
}

double Fuser::longest() const { return code.language == FusedCode::Language::llvm ? options.longest_llvm_s : options.longest_s; }

std::optional<Message> Fuser::take (Plan& plan, double now_s)
{
    auto compiled = compiler.finished();
    took_s = now_s - since_s;
    if (! compiled && took_s > longest())
    {
        compiler.stop();
        return orElse (Message::warning ("fuse/too_long", {}, "the compiler took longer than " + numberText (longest()) + " s, so the graph is not fused",
                                         "the run continues as it is"),
                       plan, now_s);
    }
    if (! compiled) return std::nullopt;
    if (! *compiled && compiled->error().id == "fuse/no_llvm") tries_llvm = false;
    const auto why = *compiled ? load (plan, **compiled) : std::optional (compiled->error());
    return why ? orElse (*why, plan, now_s) : std::nullopt;
}

/// Lets the plan run as this code, or returns the reason why not.
std::optional<Message> Fuser::load (Plan& plan, const std::filesystem::path& object)
{
    auto loaded = loadFused (object, std::move (code.objects));
    if (! loaded) return loaded.error();
    plan.fuse (std::move (*loaded));
    now = State::fused;
    return std::nullopt;
}

}   // namespace tactus::host
