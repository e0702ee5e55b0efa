// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuser.hpp"
#include "load_fused.hpp"

#include <tactus/text/number_text.hpp>

#include <cmath>
#include <utility>

namespace tactus::host
{

Fuser::Fuser (Options o) : options (std::move (o)), compiler (options.compiler) {}

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
    return std::to_string (code.fused) + " of " + all + " steps in " + seconds + " s";
}

Message Fuser::fail (Message why)
{
    now = State::fails;
    compiler.stop();
    why.severity = Message::Severity::warning;
    return why;
}

std::optional<Message> Fuser::look (const std::shared_ptr<Plan>& plan, double now_s)
{
    if (plan->serial() != serial)
    {
        const bool is_first = std::exchange (serial, plan->serial()) == 0;
        compiler.stop();
        now = State::rests;
        since_s = is_first ? now_s - options.rest_s : now_s;
    }
    if (gives_up) now = State::fails;
    if (now == State::compiles) return take (*plan, now_s);
    if (now != State::rests || now_s - since_s < options.rest_s) return std::nullopt;

    code = FusedCode::of (*plan);
    if (code.text.empty())
        return fail (Message::warning ("fuse/too_large", {},
                                       "the graph has more than " + std::to_string (FusedCode::most_records) + " steps, so it is not fused",
                                       "the run continues as it is"));
    if (code.fused == 0)
        return fail (Message::warning ("fuse/nothing", {}, "the graph has nothing to fuse: the code of its nodes is in plugins", "the run continues as it is"));
    return begin (now_s);
}

std::optional<Message> Fuser::begin (double now_s)
{
    since_s = now_s;
    now = State::compiles;
    auto started = compiler.start (code);
    if (started) return std::nullopt;
    gives_up = true;
    return fail (started.error());
}

std::optional<Message> Fuser::take (Plan& plan, double now_s)
{
    auto compiled = compiler.finished();
    took_s = now_s - since_s;
    if (! compiled && took_s > options.longest_s)
        return fail (Message::warning ("fuse/too_long", {}, "the compiler took longer than " + numberText (options.longest_s) + " s, so the graph is not fused",
                                       "the run continues as it is"));
    if (! compiled) return std::nullopt;
    if (! *compiled) return fail (compiled->error());
    auto loaded = loadFused (**compiled, std::move (code.objects));
    if (! loaded) return fail (loaded.error());
    plan.fuse (std::move (*loaded));
    now = State::fused;
    return std::nullopt;
}

}   // namespace tactus::host
