// SPDX-License-Identifier: MIT
// A node that throws in the hook that its setting names.
#include <tactus/plugin/node_plugin.hpp>

#include <tactus/node/generic.hpp>

#include <stdexcept>

namespace bad
{

using namespace tactus;

struct Throwing
{
    using Inputs = In<double>;
    using Params = Empty;
    using Outputs = Out<double>;

    struct Settings
    {
        std::string hook = "none";
    };

    static constexpr Info info { .id = "bad.throwing", .name = "Throwing", .summary = "Throws.", .source = "test" };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        setting (&Settings::hook, "hook", unit::count, "the hook that throws"),
        output (&Outputs::out, "out", sameAs ("in"), "the signal"),
    };

    Params params;
    Settings settings;

    Cost cost() const
    {
        check ("cost");
        return {};
    }
    std::string problem() const
    {
        check ("problem");
        return {};
    }
    std::string warning (const Setup&) const
    {
        check ("warning");
        return {};
    }
    void prepare (const Setup&) { check ("prepare"); }
    Claims claims() const
    {
        check ("claims");
        return {};
    }

    Outputs tick (const Inputs& in) noexcept { return { .out = in.in }; }

private:
    void check (const std::string& hook) const
    {
        if (settings.hook == hook) throw std::runtime_error ("thrown in " + hook);
        if (settings.hook == hook + " int") throw 1;
    }
};

}   // namespace bad

TACTUS_NODE (bad::Throwing);
TACTUS_PLUGIN (bad::Throwing)
