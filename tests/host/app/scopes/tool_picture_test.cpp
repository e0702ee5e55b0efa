// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/scopes/tool_picture.hpp>
#include <host/app/scopes/trace_file.hpp>

#include "made_trace.hpp"

#include "support/rig.hpp"
#include "support/temporary_folder.hpp"

#include <support/property.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <map>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// A running friction node, with its ports as traces.
struct Rub
{
    static constexpr double d_max = 1e-3, static_ratio = 1.5;

    Rig node { "friction.elasto_plastic" };
    std::map<std::string, std::vector<std::shared_ptr<Trace>>> ports;
    std::uint64_t tick = 0;

    Rub()
    {
        node.param ("d_max", d_max).param ("static_ratio", static_ratio).prepare();
        for (const char* port : { "drag.position", "drag.deflection", "drag.force", "drag.normal" })
            for (const char* c : { ".x", ".y", ".z" })
                ports[port].push_back (emptyTrace (std::string (port) + c));
        for (const char* port : { "drag.state", "drag.d_max", "drag.static_ratio" })
            ports[port].push_back (emptyTrace (port));
    }

    void move (const Vec3& p, double load = 1.0)
    {
        node.input ("position", p).input ("normal_force", load).tick();
        const auto vector = [this] (const char* port, const Vec3& v) {
            for (int i = 0; i < 3; ++i)
                ports[port][static_cast<std::size_t> (i)]->add (tick, v[i]);
        };
        vector ("drag.position", p);
        vector ("drag.deflection", node.vector ("deflection"));
        vector ("drag.force", node.vector ("force"));
        vector ("drag.normal", Vec3::UnitZ());
        ports["drag.state"][0]->add (tick, node.out ("state"));
        ports["drag.d_max"][0]->add (tick, d_max);
        ports["drag.static_ratio"][0]->add (tick, static_ratio);
        ++tick;
    }

    std::optional<ToolPicture> picture() const
    {
        return toolPicture ("drag", [this] (const std::string& port) {
            const auto at = ports.find (port);
            return at == ports.end() ? TraceList {} : TraceList (at->second.begin(), at->second.end());
        });
    }
};
}   // namespace

TEST_CASE ("scopes: the anchor does not move while stuck, and is dragged while sliding, within d_stick and against the force", "[app][scopes]")
{
    Rub rub;
    CHECK_FALSE (rub.picture());
    rub.move (Vec3::Zero());
    Vec3 anchor = rub.picture()->anchor();
    bool has_stuck = false, has_slid = false;
    for (int k = 1; k < 400; ++k)
    {
        rub.move (Vec3 (2e-5 * k, 1e-5 * k, 0.0));
        const auto p = rub.picture();
        REQUIRE (p);
        CHECK (p->touches());
        CHECK (p->deflection.norm() <= p->d_stick * (1.0 + 1e-6));
        CHECK (p->force.dot (p->deflection) <= 0.0);
        if (p->state == 1)
        {
            has_stuck = true;
            CHECK ((p->anchor() - anchor).norm() < 1e-12);
        }
        else
        {
            has_slid = true;
            CHECK ((p->anchor() - anchor).norm() > 1e-5);
        }
        anchor = p->anchor();
    }
    CHECK (has_stuck);
    CHECK (has_slid);
    rub.move (Vec3::Zero(), 0.0);
    CHECK_FALSE (rub.picture()->touches());
}

TEST_CASE ("scopes: a plane of any orientation is seen from above, without mirroring", "[app][scopes]")
{
    CHECK (PlaneView (Vec3::UnitZ()).right == Vec3::UnitX());
    CHECK (PlaneView (Vec3::UnitZ()).up == Vec3::UnitY());
    tactus::test::property ("any normal", [] (short x, short y, short z) {
        const Vec3 n (x, y, z);
        RC_PRE (n.norm() > 0.0);
        const PlaneView v (n);
        RC_ASSERT (std::abs (v.right.norm() - 1.0) < 1e-9);
        RC_ASSERT (std::abs (v.up.norm() - 1.0) < 1e-9);
        RC_ASSERT (std::abs (v.right.dot (n.normalized())) < 1e-9);
        RC_ASSERT (v.right.cross (v.up).dot (n.normalized()) > 0.999);
    });
}

TEST_CASE ("scopes: saved traces read back tick by tick, with nan where a trace has no value", "[app][scopes]")
{
    const TemporaryFolder folder;
    const auto path = folder / "scopes.csv";
    const auto force = traceOf ({ 0.1, 0.2, 0.3 }, 10, 1000.0, "a.force.x"), depth = traceOf ({ 7.0, 8.0 }, 12, 1000.0, "b.depth");
    REQUIRE (writeTraces (path, { force, depth, traceOf ({ 0.1 }, 10, 1000.0, "a.force.x") }));
    const auto table = readTable (path);
    REQUIRE (table);
    CHECK (table->columns == std::vector<std::string> { "t", "a.force.x", "b.depth" });
    REQUIRE (table->rows() == 4);
    CHECK (table->at (0, 0) == 0.01);
    CHECK (table->at (2, 1) == 0.3);
    CHECK (std::isnan (table->at (0, 2)));
    CHECK (table->at (2, 2) == 7.0);
    CHECK (std::isnan (table->at (3, 1)));
    CHECK (writeTraces (path, {}).error().id == "scope/nothing");
}
