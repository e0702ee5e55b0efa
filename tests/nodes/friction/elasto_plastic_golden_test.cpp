// SPDX-License-Identifier: MIT
#include <tactus/nodes/friction/elasto_plastic.hpp>

#include <golden/golden.hpp>

#include <catch2/catch.hpp>

#include <vector>

using tactus::Vec3;
using tactus::nodes::ElastoPlastic;
using tactus::test::Golden;

namespace
{
using Adhesion = ElastoPlastic::Adhesion;
using Integrator = ElastoPlastic::Integrator;
using Load = ElastoPlastic::Load;

std::vector<ElastoPlastic::Outputs> play1d (const Golden& golden, const ElastoPlastic::Params& params)
{
    ElastoPlastic node;
    node.params = params;
    std::vector<ElastoPlastic::Outputs> outputs;
    for (std::size_t i = 0; i < golden.rows(); ++i)
        outputs.push_back (node.tick ({ .position = { golden (i, "p"), 0, 0 }, .normal_force = golden (i, "fn") }));
    return outputs;
}

std::vector<ElastoPlastic::Outputs> play3d (const Golden& golden, const ElastoPlastic::Params& params)
{
    ElastoPlastic node;
    node.params = params;
    std::vector<ElastoPlastic::Outputs> outputs;
    for (std::size_t i = 0; i < golden.rows(); ++i)
        outputs.push_back (node.tick ({
            .position = { golden (i, "p_x"), golden (i, "p_y"), golden (i, "p_z") },
            .normal = { golden (i, "n_x"), golden (i, "n_y"), golden (i, "n_z") },
            .normal_force = golden (i, "fn"),
        }));
    return outputs;
}
}   // namespace

TEST_CASE ("friction: along a line every form matches the golden columns", "[nodes][friction][golden]")
{
    const Golden golden ("friction_1d");
    ElastoPlastic::Params base;
    base.mu = golden.param ("mu");
    base.d_max = golden.param ("d_max");
    base.break_away = golden.param ("d_ba") / golden.param ("d_max");

    const auto with = [&] (Adhesion adhesion, Integrator integrator, Load load, double ratio = 1.0) {
        auto params = base;
        params.adhesion = adhesion;
        params.integrator = integrator;
        params.load = load;
        params.static_ratio = ratio;
        return play1d (golden, params);
    };
    const auto deflectionMeets = [&] (const std::string& column, const std::vector<ElastoPlastic::Outputs>& outputs) {
        INFO (column);
        CHECK (golden.worst (column, [&] (std::size_t i) { return outputs[i].deflection.x(); })
               <= 1.0);
    };
    const auto forceMeets = [&] (const std::string& column, const std::vector<ElastoPlastic::Outputs>& outputs) {
        INFO (column);
        CHECK (golden.worst (column, [&] (std::size_t i) { return outputs[i].force.x(); })
               <= 1.0);
    };

    const auto eq3 = with (Adhesion::stick, Integrator::exponential, Load::scale);
    deflectionMeets ("d_eq3", eq3);
    forceMeets ("f_eq3", eq3);
    CHECK (golden.worst ("state_eq3", [&] (std::size_t i) { return eq3[i].state; })
           == 0.0);

    deflectionMeets ("d_euler2", with (Adhesion::dupont, Integrator::euler, Load::scale));
    deflectionMeets ("d_euler3", with (Adhesion::ramp, Integrator::euler, Load::scale));
    deflectionMeets ("d_euler4", with (Adhesion::dahl, Integrator::euler, Load::scale));
    deflectionMeets ("d_etd4", with (Adhesion::dahl, Integrator::exponential, Load::scale));
    deflectionMeets ("d_etd2", with (Adhesion::dupont, Integrator::exponential, Load::scale));
    deflectionMeets ("d_stickslip", with (Adhesion::stick, Integrator::exponential, Load::scale, golden.param ("d_stick_stickslip") / golden.param ("d_max")));
    forceMeets ("f_passive", with (Adhesion::stick, Integrator::exponential, Load::passive));
}

TEST_CASE ("friction: with load bound every form matches the golden columns", "[nodes][friction][golden]")
{
    const Golden golden ("friction_bound");
    const auto play = [&] (Adhesion adhesion, double ratio) {
        ElastoPlastic::Params stored;
        stored.mu = golden.param ("mu");
        stored.d_max = golden.param ("d_max");
        stored.reference_load = golden.param ("reference_load");
        stored.static_ratio = ratio;
        stored.adhesion = adhesion;

        ElastoPlastic node;
        node.params = stored;
        std::vector<ElastoPlastic::Outputs> outputs;
        for (std::size_t i = 0; i < golden.rows(); ++i)
        {
            node.params.mu = golden (i, "mu");
            node.params.d_max = golden (i, "d_max");
            outputs.push_back (node.tick ({ .position = { golden (i, "p"), 0, 0 }, .normal_force = golden (i, "fn") }, stored));
        }
        return outputs;
    };
    const auto meets = [&] (const std::string& name, const std::vector<ElastoPlastic::Outputs>& outputs) {
        INFO (name);
        CHECK (golden.worst ("d_" + name, [&] (std::size_t i) { return outputs[i].deflection.x(); })
               <= 1.0);
        CHECK (golden.worst ("f_" + name, [&] (std::size_t i) { return outputs[i].force.x(); })
               <= 1.0);
    };

    const auto stick = play (Adhesion::stick, 1.0);
    meets ("stick", stick);
    CHECK (golden.worst ("state_stick", [&] (std::size_t i) { return stick[i].state; })
           == 0.0);
    meets ("dahl", play (Adhesion::dahl, 1.0));
    meets ("slip", play (Adhesion::stick, golden.param ("static_ratio_slip")));
}

TEST_CASE ("friction: on a turning surface every form matches the golden columns", "[nodes][friction][golden]")
{
    const Golden golden ("friction_3d");
    ElastoPlastic::Params params;
    params.mu = golden.param ("mu");
    params.d_max = golden.param ("d_max");
    params.break_away = golden.param ("d_ba") / golden.param ("d_max");
    params.load = Load::scale;

    const auto meets = [&] (const std::string& column, const std::vector<ElastoPlastic::Outputs>& outputs, Vec3 ElastoPlastic::Outputs::*port) {
        for (int axis = 0; axis < 3; ++axis)
        {
            const std::string component = column + "_" + "xyz"[axis];
            INFO (component);
            CHECK (golden.worst (component, [&] (std::size_t i) { return (outputs[i].*port)[axis]; })
                   <= 1.0);
        }
    };

    const auto eq3 = play3d (golden, params);
    meets ("d_eq3", eq3, &ElastoPlastic::Outputs::deflection);
    meets ("f_eq3", eq3, &ElastoPlastic::Outputs::force);
    CHECK (golden.worst ("state_eq3", [&] (std::size_t i) { return eq3[i].state; })
           == 0.0);

    params.adhesion = Adhesion::dupont;
    params.integrator = Integrator::euler;
    meets ("f_euler2", play3d (golden, params), &ElastoPlastic::Outputs::force);

    params.adhesion = Adhesion::dahl;
    params.integrator = Integrator::exponential;
    meets ("f_etd4", play3d (golden, params), &ElastoPlastic::Outputs::force);
}

TEST_CASE ("friction: a grating on d_max matches the golden column", "[nodes][friction][golden]")
{
    const Golden golden ("texture");
    ElastoPlastic node;
    node.params.stiffness = golden.param ("mu") / golden.param ("d_max");
    node.params.load = Load::passive;

    CHECK (golden.worst ("f_friction_mod", [&] (std::size_t i) {
        const double x = golden (i, "x");
        node.params.d_max = golden.param ("d_max") * (1.0 + golden.param ("mod") * std::sin (2.0 * M_PI * golden.param ("k") * x));
        return node.tick ({ .position = { x, 0, 0 }, .normal_force = golden (i, "dz") > 0.0 ? 1.0 : 0.0 }).force.x();
    }) <= 1.0);
}
