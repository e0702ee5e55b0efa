// SPDX-License-Identifier: MIT
// Nodes that throw, each in another hook.
#include <tactus/plugin/node_plugin.hpp>

#include <tactus/node/generic.hpp>

#include <stdexcept>

namespace bad
{

using namespace tactus;

struct Quiet
{
    using Inputs = In<double>;
    using Params = Empty;
    using Outputs = Out<double>;

    static constexpr std::tuple ports { input (&Inputs::in, "in", any_unit, "signal"), output (&Outputs::out, "out", sameAs ("in"), "the signal") };

    Params params;

    Outputs tick (const Inputs& in) noexcept { return { .out = in.in - in.in == 0.0 ? in.in : 0.0 }; }
};

template <typename T = int>
T thrown (const char* hook)
{
    throw std::runtime_error (std::string ("thrown in ") + hook);
}

constexpr Info infoOf (std::string_view id) { return { .id = id, .name = "Throwing", .summary = "Throws.", .source = "test" }; }

struct InCost : Quiet
{
    static constexpr Info info = infoOf ("bad.in_cost");
    Cost cost() const { return thrown<Cost> ("cost"); }
};
struct InProblem : Quiet
{
    static constexpr Info info = infoOf ("bad.in_problem");
    std::string problem() const { return thrown<std::string> ("problem"); }
};
struct InWarning : Quiet
{
    static constexpr Info info = infoOf ("bad.in_warning");
    std::string warning (const Setup&) const { return thrown<std::string> ("warning"); }
};
struct InPrepare : Quiet
{
    static constexpr Info info = infoOf ("bad.in_prepare");
    void prepare (const Setup&) { thrown ("prepare"); }
};
struct InClaims : Quiet
{
    static constexpr Info info = infoOf ("bad.in_claims");
    Claims claims() const { return thrown<Claims> ("claims"); }
};
struct InTick : Quiet
{
    static constexpr Info info = infoOf ("bad.in_tick");
    Outputs tick (const Inputs&) noexcept { return thrown<Outputs> ("tick"); }   // ends the program: a tick is noexcept
};

}   // namespace bad

TACTUS_PLUGIN (bad::InCost, bad::InProblem, bad::InWarning, bad::InPrepare, bad::InClaims, bad::InTick)
