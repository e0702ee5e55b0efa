// SPDX-License-Identifier: MIT
#include <tactus/nodes/friction/anisotropic.hpp>
#include <tactus/nodes/friction/partial_slip.hpp>

#include <golden/golden.hpp>

#include <catch2/catch.hpp>

#include <vector>

using tactus::Vec3;
using tactus::nodes::Anisotropic;
using tactus::nodes::PartialSlip;
using tactus::test::Golden;

TEST_CASE ("grain: each form of friction on a grain, and of a soft tip, matches the golden columns", "[nodes][friction][anisotropic][partial_slip][golden]")
{
    const Golden golden ("friction_grain");
    const auto vector = [&] (std::size_t i, const std::string& name) {
        return Vec3 { golden (i, name + "_x"), golden (i, name + "_y"), golden (i, name + "_z") };
    };
    const auto meets = [&] (const std::string& form, auto tick) {
        using Outputs = decltype (tick (0));
        std::vector<Outputs> outputs;
        for (std::size_t i = 0; i < golden.rows(); ++i)
            outputs.push_back (tick (i));
        for (int axis = 0; axis < 3; ++axis)
        {
            const std::string end = "_" + form + "_" + "xyz"[axis];
            INFO (end);
            CHECK (golden.worst ("d" + end, [&] (std::size_t i) { return outputs[i].deflection[axis]; }) <= 1.0);
            CHECK (golden.worst ("f" + end, [&] (std::size_t i) { return outputs[i].force[axis]; }) <= 1.0);
        }
        if (form == "stick") CHECK (golden.worst ("state_stick", [&] (std::size_t i) { return outputs[i].state; }) == 0.0);
    };
    const auto grained = [&] (const std::string& form, Anisotropic::Adhesion adhesion, double ratio) {
        Anisotropic node;
        node.params = { .mu_along = golden.param ("mu_along"),
                        .mu_against = golden.param ("mu_against"),
                        .mu_across = golden.param ("mu_across"),
                        .d_max = golden.param ("d_max"),
                        .static_ratio = ratio,
                        .adhesion = adhesion,
                        .reference_load = golden.param ("reference_load") };
        meets (form, [&] (std::size_t i) {
            return node.tick ({ .position = vector (i, "p"), .normal = vector (i, "n"), .grain = vector (i, "g"), .normal_force = golden (i, "fn") });
        });
    };
    grained ("stick", Anisotropic::Adhesion::stick, 1.0);
    grained ("dahl", Anisotropic::Adhesion::dahl, 1.0);
    grained ("dupont", Anisotropic::Adhesion::dupont, 1.0);
    grained ("slip", Anisotropic::Adhesion::stick, golden.param ("static_ratio_slip"));

    PartialSlip tip;
    tip.params.mu = golden.param ("mu_across");
    tip.params.s_max = golden.param ("d_max");
    meets ("tip", [&] (std::size_t i) {
        return tip.tick ({ .position = vector (i, "p"), .normal = vector (i, "n"), .normal_force = golden (i, "fn") });
    });
}
