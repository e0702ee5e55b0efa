// SPDX-License-Identifier: MIT
#include <tactus/nodes/texture/height_map.hpp>

#include <support/no_allocation.hpp>
#include <support/property.hpp>
#include <support/rig.hpp>
#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace tactus;
using nodes::HeightMap;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double pitch = 1e-4;   // m

template <typename Height>
std::shared_ptr<const Grid> grid (int rows, int columns, Height height)
{
    Grid g { rows, columns, {} };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            g.values.push_back (height (row, column));
    return std::make_shared<const Grid> (std::move (g));
}

/// The roughest possible map: every point is independent.
std::shared_ptr<const Grid> rough (unsigned seed, int rows = 24, int columns = 31)
{
    std::mt19937 random { seed };
    std::uniform_real_distribution<double> heights { -1e-5, 1e-5 };
    return grid (rows, columns, [&] (int, int) { return heights (random); });
}

HeightMap over (std::shared_ptr<const Grid> csv, double rate_hz = 4000.0)
{
    HeightMap node;
    node.settings.map.csv.grid = std::move (csv);
    node.settings.map.pitch = pitch;
    REQUIRE (node.problem() == "");
    node.prepare ({ .rate_hz = rate_hz });
    return node;
}

/// The output at a point, in full detail. It is the first sample after a fault, so there is no speed.
HeightMap::Outputs at (HeightMap& node, double x, double y)
{
    node.tick ({ .position = { not_a_number, 0.0, 0.0 } });
    return node.tick ({ .position = { x, y, 0.0 } });
}

/// The forces on a straight scan at a constant speed, from its third tick on.
std::vector<Vec3> scan (HeightMap node, const Vec3& from, const Vec3& step, int ticks)
{
    std::vector<Vec3> forces;
    for (int k = -2; k < ticks; ++k)
    {
        const auto out = node.tick ({ .position = from + k * step });
        if (k >= 0) forces.push_back (out.force);
    }
    return forces;
}

/// Mean square of a signal above the given fraction of its rate, using a window with very low sidelobes.
double energyFrom (double fraction, const std::vector<Vec3>& signal)
{
    const auto n = signal.size();
    double window_energy = 0.0, energy = 0.0;
    for (int axis = 0; axis < 2; ++axis)
    {
        std::vector<double> windowed (n);
        window_energy = 0.0;
        for (std::size_t i = 0; i < n; ++i)
        {
            const double a = 2.0 * M_PI * static_cast<double> (i) / static_cast<double> (n);
            const double w = 0.35875 - 0.48829 * std::cos (a) + 0.14128 * std::cos (2.0 * a) - 0.01168 * std::cos (3.0 * a);   // Blackman and Harris
            windowed[i] = w * signal[i][axis];
            window_energy += w * w;
        }
        Eigen::FFT<double> fft;
        std::vector<std::complex<double>> spectrum;
        fft.fwd (spectrum, windowed);
        for (std::size_t i = 0; i < n; ++i)
        {
            const auto folded = static_cast<double> (std::min (i, n - i)) / static_cast<double> (n);
            if (folded >= fraction) energy += std::norm (spectrum[i]) / static_cast<double> (n);
        }
    }
    return energy / window_energy;
}
}   // namespace

TEST_CASE ("height map: it passes through every point of the map", "[nodes][texture]")
{
    const auto map = rough (1);
    auto node = over (map);
    for (int row = 0; row < map->rows; ++row)
        for (int column = 0; column < map->columns; ++column)
            REQUIRE (at (node, column * pitch, row * pitch).value == Approx ((*map) (row, column)).margin (1e-17));
}

TEST_CASE ("height map: the force is minus gain times the slope", "[nodes][texture]")
{
    test::property ("anywhere, inside and outside the map", [] {
        auto node = over (rough (*rc::gen::arbitrary<unsigned>()));
        node.params.gain = 0.1 * *rc::gen::inRange (-30, 30);
        const double x = 1e-6 * *rc::gen::inRange (-9000, 9000), y = 1e-6 * *rc::gen::inRange (-9000, 9000), h = 1e-8;
        const Vec3 force = at (node, x, y).force;
        RC_ASSERT (force.z() == 0.0);
        RC_ASSERT (std::abs (force.x() + node.params.gain * (at (node, x + h, y).value - at (node, x - h, y).value) / (2.0 * h)) < 1e-5);
        RC_ASSERT (std::abs (force.y() + node.params.gain * (at (node, x, y + h).value - at (node, x, y - h).value) / (2.0 * h)) < 1e-5);
    });
}

TEST_CASE ("height map: a wave on the map is felt as the same wave", "[nodes][texture]")
{
    // whole periods between the mirrored ends
    const double k = 10.0 / (60 * pitch), amplitude = 2e-5;
    auto node = over (grid (61, 61, [&] (int row, int) { return amplitude * std::cos (2.0 * M_PI * k * row * pitch); }));
    for (double y = -3e-3; y < 9e-3; y += 1.7e-5)
    {
        const auto out = at (node, 1e-3, y);
        REQUIRE (out.value == Approx (amplitude * std::cos (2.0 * M_PI * k * y)).margin (3e-3 * amplitude));
        REQUIRE (out.force.y() == Approx (2.0 * M_PI * k * amplitude * std::sin (2.0 * M_PI * k * y)).margin (6e-3 * 2.0 * M_PI * k * amplitude));
        REQUIRE (std::abs (out.force.x()) < 1e-12);
    }
}

TEST_CASE ("height map: the force never steps, and changes no faster than claimed", "[nodes][texture]")
{
    test::property ("two points, near or far", [] {
        auto node = over (rough (*rc::gen::arbitrary<unsigned>()));
        node.params.gain = 2.0;
        const double claimed = node.claims().stiffness;
        const double x = 1e-6 * *rc::gen::inRange (-4000, 4000), y = 1e-6 * *rc::gen::inRange (-4000, 4000);
        const double distance = std::pow (10.0, *rc::gen::inRange (-9, -3)), angle = *rc::gen::inRange (0, 628) / 100.0;
        const Vec3 change = at (node, x + distance * std::cos (angle), y + distance * std::sin (angle)).force - at (node, x, y).force;
        RC_ASSERT (change.norm() <= claimed * distance);
    });

    // and the claim is not too loose: for a sine wave it is at most 1.25 times the steepest slope of the force
    const double k = 10.0 / (60 * pitch), amplitude = 2e-5;
    auto wave = over (grid (61, 61, [&] (int row, int) { return amplitude * std::cos (2.0 * M_PI * k * row * pitch); }));
    const double slope = amplitude * std::pow (2.0 * M_PI * k, 2);
    CHECK (wave.claims().spatial_frequency == Approx (0.6 / pitch));
    CHECK (wave.claims().stiffness > slope);
    CHECK (wave.claims().stiffness < 1.25 * slope);
    CHECK_FALSE (wave.claims().passive);
    CHECK (HeightMap {}.claims().passive);
}

TEST_CASE ("height map: scanned at any speed it has no energy above f_max", "[nodes][texture]")
{
    test::property ("a straight scan in any direction, from slow to far beyond half the tick rate", [] {
        auto node = over (rough (*rc::gen::arbitrary<unsigned>()));
        const double angle = *rc::gen::inRange (0, 628) / 100.0;
        const double points_a_tick = std::pow (2.0, 0.1 * *rc::gen::inRange (-45, 90));
        const Vec3 step = points_a_tick * pitch * Vec3 { std::cos (angle), std::sin (angle), 0.0 };
        const Vec3 from { 1e-6 * *rc::gen::inRange (0, 2000), 1e-6 * *rc::gen::inRange (0, 2000), 0.0 };

        const auto forces = scan (node, from, step, 2048);
        const double below = energyFrom (0.0, forces), above = energyFrom (0.25 + 0.005, forces);
        const double at_rest = energyFrom (0.0, scan (node, from, 0.0837 * step / points_a_tick, 2048));   // the same path, scanned slowly
        RC_ASSERT (above < 3e-5 * below + 1e-13 * at_rest);
    });
}

TEST_CASE ("height map: up to half of f_max nothing is lost, and beyond it, detail goes first", "[nodes][texture]")
{
    const auto map = rough (5);
    auto node = over (map);   // at 4 kHz, f_max is 1 kHz; the finest level ends at 6000 1/m
    const auto energyAt = [&] (double speed) {
        HeightMap moving = node;
        double sum = 0.0;
        moving.tick ({ .position = { 1e-3 - speed / 4000.0, 0.7e-3, 0.0 } });
        for (int k = 0; k < 4000; ++k)
            sum += moving.tick ({ .position = { 1e-3 + k * speed / 4000.0, 0.7e-3, 0.0 } }).force.squaredNorm() / 4000.0;
        return sum;
    };

    HeightMap slow = node;
    for (int k = 0; k < 500; ++k)
    {
        const double x = k * 0.08 / 4000.0;
        const auto out = slow.tick ({ .position = { x, 0.7e-3, 0.0 } });
        REQUIRE (out.value == at (node, x, 0.7e-3).value);
        REQUIRE (out.force == at (node, x, 0.7e-3).force);
    }

    double before = energyAt (0.08);
    for (const double speed : { 0.4, 1.0, 2.0 })
    {
        const double now = energyAt (speed);
        CHECK (now < before);
        before = now;
    }
    CHECK (energyAt (100.0) < 1e-6 * energyAt (0.08));

    // at the highest speeds only the mean is left; the map is mirrored at its edges, so points on an edge count half
    double sum = 0.0, all = 0.0;
    for (int row = 0; row < map->rows; ++row)
        for (int column = 0; column < map->columns; ++column)
        {
            const double weight = (row % (map->rows - 1) == 0 ? 0.5 : 1.0) * (column % (map->columns - 1) == 0 ? 0.5 : 1.0);
            sum += weight * (*map) (row, column);
            all += weight;
        }
    HeightMap fast = node;
    fast.tick ({ .position = { 0.0, 0.0, 0.0 } });
    CHECK (fast.tick ({ .position = { 20.0, 0.4, 0.0 } }).value == Approx (sum / all).margin (1e-18));
}

TEST_CASE ("height map: with a given f_max it is the same relief at 1, 4 and 20 kHz", "[nodes][texture]")
{
    const double v = 0.15;
    const auto forces = [&] (double rate_hz, double f_max) {
        auto node = over (rough (4), rate_hz);
        node.params.f_max = f_max;
        node.update();
        return scan (node, { 0.0, 1e-4, 0.0 }, { v / rate_hz, 0.0, 0.0 }, static_cast<int> (0.02 * rate_hz));
    };
    const auto expected = forces (20'000.0, 200.0);
    for (const std::size_t every : { 5U, 20U })
    {
        const auto is = forces (20'000.0 / static_cast<double> (every), 200.0);
        for (std::size_t k = 0; k < is.size(); ++k)
            REQUIRE ((is[k] - expected[every * k]).norm() < 1e-9);
    }
    const auto by_default = forces (20'000.0, 0.0);
    double finer = 0.0;
    for (std::size_t k = 0; k < expected.size(); ++k)
        finer = std::max (finer, (by_default[k] - expected[k]).norm());
    CHECK (finer > 1e-3);
}

TEST_CASE ("height map: speed blends the levels without a step", "[nodes][texture]")
{
    auto node = over (rough (6));
    const Vec3 p { 1.234e-3, 0.777e-3, 0.0 };
    Vec3 before = Vec3::Zero();
    for (double speed = 0.01; speed < 50.0; speed *= 1.001)
    {
        HeightMap moving = node;
        moving.tick ({ .position = p - Vec3 { speed / 4000.0, 0.0, 0.0 } });
        const Vec3 now = moving.tick ({ .position = p }).force;
        if (speed > 0.01) REQUIRE ((now - before).norm() < 0.01);   // forces are up to 0.5 N
        before = now;
    }
}

TEST_CASE ("height map: at a constant speed a closed loop does no work", "[nodes][texture]")
{
    // At 400 kHz the speed of the first two samples is held for 8000 ticks: enough for a loop in dense steps.
    const double rate = 400'000.0;
    const auto map = rough (7);
    double most = 0.0;
    for (const double speed : { 0.5, 12.0, 18.0, 33.0, 70.0, 150.0 })
    {
        auto node = over (map, rate);
        const auto path = [] (int k) {
            const double a = 2.0 * M_PI * k / 7000.0;
            return Vec3 { 1.3e-3 + 0.6e-3 * std::cos (a) + 0.2e-3 * std::sin (3.0 * a), 1.1e-3 + 0.7e-3 * std::sin (a) + 0.1e-3 * std::cos (2.0 * a), 0.0 };
        };
        Vec3 p = path (0);
        node.tick ({ .position = p - Vec3 { speed / rate, 0.0, 0.0 } });
        Vec3 force = node.tick ({ .position = p }).force;
        double work = 0.0, handled = 0.0;
        for (int k = 1; k <= 7000; ++k)
        {
            const Vec3 next = path (k), now = node.tick ({ .position = next }).force;
            work += 0.5 * (force + now).dot (next - p);
            handled += std::abs (0.5 * (force + now).dot (next - p));
            force = now;
            p = next;
        }
        REQUIRE (handled > 0.0);
        CHECK (std::abs (work) < 1e-5 * handled);
        if (most > 0.0) CHECK (handled < most);   // the higher the speed, the less force is left
        most = handled;
    }
}

TEST_CASE ("height map: outside the map the relief is continued by mirroring", "[nodes][texture]")
{
    const auto map = rough (8);
    auto node = over (map);
    const double width = (map->columns - 1) * pitch, depth = (map->rows - 1) * pitch;
    for (double x = 0.0; x < width; x += 3.1e-5)
    {
        const double y = 0.4 * x;
        const auto inside = at (node, x, y);
        for (const auto& [mx, my] : { std::pair { -x, y }, { 2.0 * width - x, y }, { x, -y }, { x, 2.0 * depth - y }, { x + 20.0 * width, y - 6.0 * depth } })
        {
            const auto outside = at (node, mx, my);
            REQUIRE (outside.value == Approx (inside.value).margin (1e-12));
            REQUIRE (outside.force.norm() == Approx (inside.force.norm()).margin (1e-7));
        }
    }
}

TEST_CASE ("height map: one row is a profile, the same for all y", "[nodes][texture]")
{
    auto node = over (rough (9, 1, 40));
    HeightMap still = node, sliding = node;
    for (int k = 0; k < 100; ++k)
    {
        const double x = k * 1e-5;
        const auto a = still.tick ({ .position = { x, 0.0, 0.0 } }), b = sliding.tick ({ .position = { x, 0.5 * k, 0.0 } });
        REQUIRE (a.value == b.value);   // moving along the ridges does not count as speed
        REQUIRE (a.force == b.force);
        REQUIRE (a.force.y() == 0.0);
    }

    auto column = over (rough (9, 40, 1));
    CHECK (at (column, 1.0, 3e-4).force.x() == 0.0);
    CHECK (at (column, 1.0, 3e-4).value == at (node, 3e-4, 1.0).value);
    auto point = over (rough (9, 1, 1));
    CHECK (at (point, 3.0, 4.0).force.norm() == 0.0);
}

TEST_CASE ("height map: a measured profile is felt as measured, and does not buzz at the speed of a hand", "[nodes][texture][data]")
{
    std::ifstream file (TACTUS_SHARED_DATA "/topography_contactengineering/dektak-1.csv");
    if (! file)
    {
        std::printf ("skipped: the profilometer line dektak-1.csv is missing\n");
        return;
    }
    std::vector<double> across, heights;   // um
    double position = 0.0, height = 0.0;
    for (std::string line; std::getline (file, line);)
        if (std::sscanf (line.c_str(), "%lf,%lf,,", &position, &height) == 2)
        {
            across.push_back (position);
            heights.push_back (height);
        }
    REQUIRE (heights.size() > 9000);

    HeightMap node;
    const auto columns = static_cast<int> (heights.size());
    const double step = 1e-6 * (across.back() - across.front()) / (columns - 1);
    node.settings.map = { .csv = { std::make_shared<const Grid> (Grid { 1, columns, heights }) }, .pitch = step, .height = 1e-6 };
    REQUIRE (node.problem() == "");
    node.prepare ({ .rate_hz = 4000.0 });
    for (int i = 0; i < columns; i += 7)
        REQUIRE (at (node, i * step, 0.0).value == Approx (1e-6 * heights[static_cast<std::size_t> (i)]).margin (1e-15));

    for (const double speed : { 1e-4, 1e-3, 1e-2, 0.1 })
    {
        const auto forces = scan (node, Vec3::Zero(), { speed / 4000.0, 0.0, 0.0 }, 2048);
        CHECK (energyFrom (0.255, forces) < 3e-5 * energyFrom (0.0, forces));
    }
}

TEST_CASE ("height map: a picture lies as it is seen from above, a table as its rows are numbered", "[nodes][texture]")
{
    const auto corner = grid (3, 4, [] (int row, int column) { return row == 0 && column == 3 ? 1.0 : 0.0; });
    const auto type = describe<HeightMap>();
    const auto heightAt = [&] (const Values& map, double x, double y) {
        Rig rig { type };
        rig.set ("map", map);
        CHECK (rig.problem() == "");
        rig.prepare();
        rig.input ("position", { x, y, 0.0 });
        rig.tick();
        return rig.out ("value");
    };
    CHECK (heightAt ({ Image { corner }, Sheet {}, 1e-3, 0.0, 0.0 }, 3e-3, 2e-3) == Approx (1e-4));
    CHECK (heightAt ({ Image { corner }, Sheet {}, 1e-3, -5e-4, 0.0 }, 3e-3, 2e-3) == Approx (-5e-4));
    CHECK (heightAt ({ Image {}, Sheet { corner }, 1e-3, 0.0, 0.0 }, 3e-3, 0.0) == Approx (1.0));
    CHECK (heightAt ({ Image {}, Sheet { corner }, 1e-3, 1e-6, 0.0 }, 3e-3, 0.0) == Approx (1e-6));
    CHECK (heightAt ({ Image {}, Sheet {}, 1e-3, 1e-6, 0.0 }, 3e-3, 0.0) == 0.0);
}

TEST_CASE ("height map: a quantised position makes the detail coarse, but nothing flutters", "[nodes][texture]")
{
    // A step of one quantum (10 um) in a tick counts as at least 0.04 m/s. At this speed the finest detail of a map with a pitch
    // of 10 um is left out, and it must not return while the position stays between two steps.
    HeightMap node;
    node.settings.map = { .csv = { rough (10) }, .pitch = 1e-5 };
    node.prepare ({ .rate_hz = 4000.0 });
    const double quantum = 1e-5, speed = 0.008;   // a quantum every five ticks
    Vec3 at_first = Vec3::Zero();
    double worst = 0.0, strongest = 0.0;
    double cell = -1.0;
    for (int k = 0; k < 4000; ++k)
    {
        const double x = quantum * std::floor (k * speed / 4000.0 / quantum + 0.5);
        const Vec3 force = node.tick ({ .position = { x, 1e-5, 0.0 } }).force;
        if (x == 0.0) continue;
        if (x != cell) at_first = force;
        cell = x;
        worst = std::max (worst, (force - at_first).norm());
        strongest = std::max (strongest, force.norm());
    }
    CHECK (strongest > 0.01);
    CHECK (worst < 1e-9 * strongest);
}

TEST_CASE ("height map: a faulty position is forgotten, and so is its speed", "[nodes][texture]")
{
    for (const double bad : { not_a_number, inf, -inf })
    {
        auto node = over (rough (11));
        for (int k = 0; k < 10; ++k)
            node.tick ({ .position = { 0.01 * k, 0.0, 0.0 } });
        const auto fault = node.tick ({ .position = { 0.0, 0.0, bad } });
        CHECK (fault.force.norm() == 0.0);
        CHECK (fault.value == 0.0);
        const auto after = node.tick ({ .position = { 3.3e-4, 4.4e-4, 0.0 } });
        CHECK (after.force == at (node, 3.3e-4, 4.4e-4).force);
        CHECK (after.force != Vec3::Zero());
    }
    auto node = over (rough (11));
    node.tick ({ .position = { 0.0, 0.0, 0.0 } });
    node.tick ({ .position = { not_a_number, 0.0, 0.0 } });
    CHECK (node.tick ({ .position = { 0.33, 4.4e-4, 0.0 } }).force == at (node, 0.33, 4.4e-4).force);
}

TEST_CASE ("height map: a new map adopts the speed of the hand", "[nodes][texture]")
{
    auto old = over (rough (12));
    for (int k = 0; k < 10; ++k)
        old.tick ({ .position = { 1e-3 * k, 0.0, 0.0 } });
    auto young = over (rough (12));
    young.adopt (old);
    for (int k = 10; k < 50; ++k)
    {
        const Vec3 p { 1e-2 + 1e-5 * k, 1e-4, 0.0 };
        REQUIRE (young.tick ({ .position = p }).force == old.tick ({ .position = p }).force);
    }
}

TEST_CASE ("height map: an invalid map is refused with a sentence", "[nodes][texture]")
{
    const auto refused = [] (const HeightMap::Map& map) {
        HeightMap node;
        node.settings.map = map;
        return ! node.problem().empty();
    };
    const auto map = rough (1);
    CHECK_FALSE (refused ({}));
    CHECK_FALSE (refused ({ .image = { map } }));
    CHECK (refused ({ .image = { map }, .csv = { map } }));
    for (const double bad : { 0.0, -1e-4, not_a_number, inf })
        CHECK (refused ({ .csv = { map }, .pitch = bad }));
    CHECK (refused ({ .csv = { map }, .height = inf }));
    CHECK (refused ({ .csv = { std::make_shared<const Grid>() } }));
    CHECK (refused ({ .csv = { std::make_shared<const Grid> (Grid { 2, 2, { 1.0 } }) } }));
    const Grid huge { 1 << 12, (1 << 10) + 1, std::vector<double> (std::size_t (1 << 12) * ((1 << 10) + 1)) };
    CHECK (refused ({ .csv = { std::make_shared<const Grid> (huge) } }));

    HeightMap node;
    node.settings.map.csv.grid = grid (3, 4, [] (int row, int column) { return row == 1 && column == 2 ? not_a_number : 0.0; });
    CHECK (node.problem().find ("row 2, column 3") != std::string::npos);
}

TEST_CASE ("height map: no input breaks it, and a tick allocates nothing", "[nodes][texture]")
{
    test::property ("the outputs are finite", [] {
        auto node = over (rough (13, *rc::gen::inRange (1, 6), *rc::gen::inRange (1, 6)), *rc::gen::element (10.0, 4000.0, 48'000.0));
        node.params.gain = *rc::gen::element (0.0, 1.0, -1e300);
        for (int k = 0; k < 40; ++k)
        {
            const auto any = [] { return *rc::gen::element (0.0, 1e-4, -1.0, 1e9, 1e300, -1.7e308, 5e-324, not_a_number, inf); };
            const HeightMap::Inputs in { { any(), any(), any() } };
            const NoAllocation watch;
            const auto out = node.tick (in);
            const bool allocated = watch.allocations() > 0;
            RC_ASSERT (isFinite (out.force) && isFinite (out.value) && ! allocated);
        }
    });
}

TEST_CASE ("height map: the force that the warning states is the one that is felt at each step", "[nodes][texture][height_map]")
{
    // Stairs of one step in a row of columns, as a ramp in 8 bits is. The force of the whole ramp would be less than 0.4 of a step per pitch.
    const int run = GENERATE (3, 4, 5, 8, 20);
    const auto stairs = grid (4, 60 * run, [&] (int, int column) { return 1e-6 * (column / run); });
    auto node = over (stairs);
    double most = 0.0;
    for (double x = 20.0 * run * pitch; x < 24.0 * run * pitch; x += 0.02 * pitch)
        most = std::max (most, std::abs (at (node, x, 1.5 * pitch).force.x()));
    CHECK (most / (1e-6 / pitch) == Approx (1.2).margin (0.1));

    char stated[64];
    std::snprintf (stated, sizeof stated, "with about %.3g N at each step", 1.2 * 1e-6 / pitch);
    CHECK (node.warning ({}).find (stated) != std::string::npos);
}
