// SPDX-License-Identifier: GPL-3.0-or-later
// Fits to published recordings, if they are present.

#include "host/cli/program.hpp"

#include <host/tools/fitting/fitting.hpp>
#include <tactus/fit/curve_fit.hpp>
#include <tactus/fit/friction_fit.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus;

namespace
{
Table recordingIn (const std::string& file)
{
    const auto read = host::readRecording (file);
    INFO ((read ? "" : describe (read.error())));
    REQUIRE (read);
    return *read;
}

std::vector<double> columnIn (const Table& table, host::FitKind kind, const std::string& role)
{
    const auto& columns = host::infoOf (kind).columns;
    const auto values = host::columnOf (table, "recording", *std::ranges::find (columns, role, &host::FitColumn::role));
    REQUIRE (values);
    return *values;
}

std::vector<double> part (const std::vector<double>& all, bool second)
{
    const auto middle = all.begin() + static_cast<std::ptrdiff_t> (all.size() / 2);
    return second ? std::vector<double> (middle, all.end()) : std::vector<double> (all.begin(), middle);
}

double workAlongPath (const std::vector<double>& x, const std::vector<double>& f)
{
    double sum = 0.0;
    for (std::size_t i = 1; i < x.size(); ++i)
        sum += 0.5 * (f[i] + f[i - 1]) * (x[i] - x[i - 1]);
    return sum;
}
}   // namespace

TEST_CASE ("presliding friction: one half of a recording predicts the other half within 0.18 N rms and 3 % of the loop energy", "[fit][data]")
{
    const auto folder = test::sharedData ("friction_jchristopherson");
    if (folder.empty()) return;
    const auto table = recordingIn (folder + "/split/presliding_dev_0_100s.txt");
    CHECK (host::guessKind (table) == host::FitKind::friction);
    const RecordedDrag all { columnIn (table, host::FitKind::friction, "position"), columnIn (table, host::FitKind::friction, "force"),
                             columnIn (table, host::FitKind::friction, "load") };
    RecordedDrag first { part (all.position, false), part (all.force, false), part (all.load, false) };
    const RecordedDrag second { part (all.position, true), part (all.force, true), part (all.load, true) };
    const auto fit = fitFriction (first);
    REQUIRE (fit);
    const auto made = part (fit->forceAlong (all), true);
    double squares = 0.0;
    for (std::size_t i = 0; i < made.size(); ++i)
        squares += std::pow (made[i] + fit->offset - second.force[i], 2);
    const double rms = std::sqrt (squares / static_cast<double> (made.size()));
    const double energy = workAlongPath (second.position, made) / workAlongPath (second.position, second.force);
    WARN ("presliding: mu " << fit->mu << ", d_max " << 1e6 * fit->d_max << " um; the other half within " << rms << " N rms, loop energy "
                            << 100.0 * (energy - 1.0) << " % off");
    CHECK (rms < 0.18);
    CHECK (energy == Approx (1.0).margin (0.03));
}

TEST_CASE ("the ring of a board after a shock is one mode near 805 Hz that decays at 44 1/s, and not quite linear", "[fit][data]")
{
    const auto folder = test::sharedData ("shock_highrate_shm");
    if (folder.empty()) return;
    const auto table = recordingIn (folder + "/acc_pcb_a0.txt");
    CHECK (host::guessKind (table) == host::FitKind::modes);
    const auto fit = host::fitRecording (host::FitKind::modes, table, "acc_pcb_a0.txt", {});
    INFO ((fit ? "" : describe (fit.error())));
    REQUIRE (fit);
    const auto &frequency = fit->report.at ("mode 1 frequency"), &decay = fit->report.at ("mode 1 decay");
    WARN ("board: " << host::textOf (frequency) << ", " << host::textOf (decay));
    CHECK (frequency.value == Approx (805.0).epsilon (0.005));
    CHECK (decay.value == Approx (44.0).epsilon (0.1));
    for (const auto& value : fit->report.values)   // others are faint, and near the third harmonic
        CHECK ((! value.is_main || value.name.starts_with ("mode 1")));
    CHECK_FALSE (fit->report.is_good);   // the residual of 6 % rings, too
}

TEST_CASE ("key switches: the fitted curves take the recorded work per stroke within 5 %", "[fit][data]")
{
    const auto folder = test::sharedData ("buttons_switchcurves");
    if (folder.empty()) return;
    for (const std::string name : { "Cherry-MX-Red", "Cherry-MX-Blue-RGB", "Cherry-MX-Hyperglide-Brown" })
    {
        const auto table = recordingIn (folder + "/" + name + ".csv");
        CHECK (host::guessKind (table) == host::FitKind::key_switch);
        const auto fit = fitCurve ({ .depth = columnIn (table, host::FitKind::curve, "depth"), .force = columnIn (table, host::FitKind::curve, "force") });
        REQUIRE (fit);
        const double spacing = fit->law.table.x.front();
        double work = -0.5 * spacing * fit->in.back();
        for (const double f : fit->in)
            work += spacing * f;
        WARN (name << ": " << 1e3 * work << " mJ on the fitted way in, " << 1e3 * fit->work << " mJ recorded");
        CHECK (work == Approx (fit->work).epsilon (0.05));
    }
}

TEST_CASE ("the file of a profilometer, with its preamble and empty columns, is read as it is", "[fit][data]")
{
    const auto folder = test::sharedData ("topography_contactengineering");
    if (folder.empty()) return;
    const auto table = recordingIn (folder + "/dektak-1.csv");
    CHECK (table.rows() == 9600);
    CHECK (host::guessKind (table) == host::FitKind::grating);
    const auto position = columnIn (table, host::FitKind::grating, "position"), height = columnIn (table, host::FitKind::grating, "height");
    CHECK (position.back() == Approx (9599 * 0.156e-6).epsilon (0.01));
    CHECK (std::abs (height.back() - height.front()) == Approx (16.6e-6).epsilon (0.02));   // tilt
    const auto fit = host::fitRecording (host::FitKind::grating, table, "dektak-1.csv", {});
    INFO ((fit ? "" : describe (fit.error())));
    REQUIRE (fit);
    CHECK_FALSE (fit->report.is_good);   // a step on a flat surface is no grating
}
