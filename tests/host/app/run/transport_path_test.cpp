// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/run/transport_path.hpp>
#include <support/property.hpp>
#include <tactus/run/device/gestures.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;

namespace
{
std::shared_ptr<const Path> stroke() { return std::make_shared<GesturePath> (*findGesture ("stroke"), Placement {}); }
}   // namespace

TEST_CASE ("a path that is only played equals the original path", "[app][transport]")
{
    const auto path = stroke();
    const TransportPath played { path };
    for (int k = 0; k < 20'000; ++k)
    {
        const double t = k / 4000.0;
        const auto a = played.at (t), b = path->at (t);
        // Not exactly equal, because TransportPath sums the time tick by tick.
        REQUIRE ((a.position - b.position).norm() < 1e-12);
    }
}

TEST_CASE ("the hand never jumps on a pause, a seek or a change of speed, and its velocity matches its position", "[app][transport]")
{
    tactus::test::property ("any use of the transport", [] {
        const auto path = stroke();
        TransportPath played { path };
        const double dt = 1.0 / 4000.0;
        auto before = played.at (0.0);
        for (int k = 1; k < 8000; ++k)
        {
            if (k % 800 == 0)
                switch (*rc::gen::inRange (0, 4))
                {
                case 0:
                    played.play (false);
                    break;
                case 1:
                    played.play (true);
                    break;
                case 2:
                    played.seek (*rc::gen::inRange (0, 1000) * 1e-3 * path->duration());
                    break;
                default:
                    played.setSpeed (*rc::gen::inRange (10, 200) * 1e-2);
                    break;
                }
            const auto now = played.at (k * dt);
            const Vec3 step = now.position - before.position;
            RC_ASSERT (step.norm() < 3.0 * dt);   // m/s: enough to catch up over a whole stroke
            RC_ASSERT ((step / dt - 0.5 * (now.velocity + before.velocity)).norm() < 0.05);
            before = now;
        }
    });
}

TEST_CASE ("a recording pauses at its end, and plays again from its beginning", "[app][transport]")
{
    TraceData data;
    for (int i = 0; i <= 10; ++i)
        data.rows.push_back ({ 0.1 * i, { 0.01 * i, 0.0, 0.0 } });
    TransportPath played { std::make_shared<TracePath> (data, Placement {}) };
    double t = 0.0;
    const auto run = [&] (double seconds) {
        for (const double end = t + seconds; t < end; t += 1.0 / 4000.0)
            played.at (t);
    };
    run (0.5);
    CHECK (played.isPlaying());
    CHECK (played.position() == Approx (0.5).epsilon (0.01));
    run (1.0);
    CHECK_FALSE (played.isPlaying());
    CHECK (played.position() == played.duration());
    played.play (true);
    run (0.5);
    CHECK (played.isPlaying());
    CHECK (played.position() > 0.3);
    CHECK (played.position() < 0.6);
}

TEST_CASE ("a paused hand comes to rest, and continues from there", "[app][transport]")
{
    const auto path = stroke();
    TransportPath played { path };
    int k = 0;
    const auto run = [&] (double seconds) {
        auto p = played.at (k / 4000.0);
        for (const int end = k + static_cast<int> (4000 * seconds); k < end; ++k)
            p = played.at (k / 4000.0);
        return p;
    };
    run (0.7);
    played.play (false);
    const auto rest = run (1.0);
    CHECK (rest.velocity.norm() < 1e-6);
    CHECK ((run (1.0).position - rest.position).norm() < 1e-9);
    const double place = played.position();
    played.play (true);
    run (0.5);
    CHECK (played.position() > place);
    played.seek (0.25);
    run (1.0 / 4000.0);
    CHECK (played.position() == Approx (0.25).margin (1e-2));
}
