// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/layers/gain_text.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <cmath>

using namespace tactus;
using namespace tactus::host;

namespace
{
std::string idOf (const Result<double>& r) { return r ? std::string() : std::string (r.error().id); }
}   // namespace

TEST_CASE ("a gain is typed in dB, as a factor, in percent, or as the level that it gives", "[layers]")
{
    const UnityLevel level { 0.6, "N" };
    CHECK (*readGain ("-6", level) == -6.0);
    CHECK (*readGain (" -6 dB ", level) == -6.0);
    CHECK (*readGain ("0dB", level) == 0.0);
    CHECK (*readGain ("off", level) == silent_db);
    CHECK (*readGain ("-inf dB", level) == silent_db);
    CHECK (*readGain ("x0.5", level) == -6.0);
    CHECK (*readGain ("2x", level) == 6.0);
    CHECK (*readGain ("50 %", level) == -6.0);
    CHECK (*readGain ("0.3 N", level) == -6.0);
    CHECK (*readGain ("300 mN", level) == -6.0);
    CHECK (*readGain ("3 m/s2", { 3.0, "m/s2" }) == 0.0);
}

TEST_CASE ("a gain that cannot be read is refused with the reason", "[layers]")
{
    const UnityLevel level { 0.6, "N" };
    CHECK (idOf (readGain ("", level)) == "gain/syntax");
    CHECK (idOf (readGain ("loud", level)) == "gain/syntax");
    CHECK (idOf (readGain ("nan", level)) == "gain/syntax");
    CHECK (idOf (readGain ("3 mm", level)) == "gain/unit");
    CHECK (idOf (readGain ("3 N", { 0.0, "N" })) == "gain/no_level");
    CHECK (idOf (readGain ("3 N", {})) == "gain/no_level");
    CHECK (idOf (readGain ("3 N", level)) == "gain/quiet");   // 14 dB
    CHECK (idOf (readGain ("0.3 N", { 1e-3, "N" })) == "gain/quiet");
    CHECK (*readGain ("2 N", level) == Approx (10.5));
    CHECK (*readGain ("14 dB", level) == 14.0);   // a gain is taken as it is typed
}

TEST_CASE ("a gain in dB and back changes it by less than the step of the field", "[layers]")
{
    CHECK (decibelsOf (0.0) == silent_db);
    CHECK (gainOf (silent_db) == 0.0);
    CHECK (rc::check ([] {
        const double gain = *rc::gen::inRange (1, 400'000) * 1e-5;
        RC_ASSERT (std::abs (20.0 * std::log10 (gainOf (decibelsOf (gain)) / gain)) <= 0.0501);
        RC_ASSERT (decibelsOf (-gain) == decibelsOf (gain));
        RC_ASSERT (*readGain (std::to_string (gain) + " N", { 1.0, "N" }) == decibelsOf (std::stod (std::to_string (gain))));
    }));
}
