// SPDX-License-Identifier: MIT
#include "support/parted.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::test;

TEST_CASE ("aliasing is reported where the rate decreases", "[plan][rates]")
{
    const auto into = [] (std::string type, Json params, Json settings, int k, const std::string& output, const std::string& filter = "signal.gain",
                          Json filtered = Json::object()) {
        auto sketch = doubling (every (k));
        sketch.node ("source", std::move (type), std::move (params), std::move (settings)).node ("filter", filter, std::move (filtered));
        sketch.wire (output + " -> filter.in").wire ("filter.out -> sec.in");
        return sketch.compile().messages;
    };
    const auto mode = [] (double f) { return Json { { "modes", Json::array ({ { { "frequency", f }, { "decay", 20.0 }, { "amplitude", 0.5 } } }) } }; };
    CHECK (has (into ("vibration.modal", Json::object(), mode (800.0), 4, "source.value"), "rate/aliasing"));   // the section runs at 1 kHz
    CHECK_FALSE (has (into ("vibration.modal", Json::object(), mode (300.0), 4, "source.value"), "rate/aliasing"));
    CHECK_FALSE (has (into ("vibration.modal", Json::object(), mode (800.0), 4, "source.value", "filter.one_pole", { { "cutoff", 200.0 } }), "rate/aliasing"));
    CHECK (has (into ("vibration.modal", Json::object(), mode (800.0), 4, "source.value", "filter.biquad", { { "cutoff", 200.0 }, { "kind", "high" } }),
                "rate/aliasing"));
    CHECK_FALSE (has (into ("vibration.modal", Json::object(), mode (800.0), 4, "source.value", "filter.biquad", { { "cutoff", 200.0 }, { "kind", "low" } }),
                      "rate/aliasing"));
    CHECK (has (into ("texture.grating", { { "spatial_frequency", 1200.0 } }, Json::object(), 4, "source.value"), "rate/aliasing"));
    CHECK_FALSE (has (into ("texture.grating", { { "spatial_frequency", 100.0 } }, Json::object(), 4, "source.value"), "rate/aliasing"));

    Parted inside { every (8), { { "hit", "bar.hit" } }, { { "value", "bar.value" } } };
    inside.add (inside.part(), "bar", "vibration.modal", Json::object(), mode (800.0));
    const auto messages = inside.compile().messages;
    REQUIRE (has (messages, "rate/aliasing"));
    CHECK (messages[0].where == "/graphs/part/nodes/bar");
    CHECK (messages[0].text.find ("'sec/bar' (vibration.modal) contains up to 800 Hz, but runs at 500 Hz in 'sec'") != std::string::npos);

    Parted out { times (4), { { "hit", "bar.hit" } }, { { "value", "bar.value" } } };
    out.add (out.part(), "bar", "vibration.modal", Json::object(), mode (3000.0)).node ("after", "signal.gain");
    CHECK (out.compile().messages.empty());
    out.wire ("sec.value -> after.in");
    CHECK (has (out.compile().messages, "rate/aliasing"));
    out.add (out.part(), "low", "filter.butterworth2", { { "cutoff", 1000.0 } }).add (out.part(), "bar.value -> low.in");
    out.expose ("part", { { "hit", "bar.hit" } }, { { "value", "low.out" } });
    CHECK (out.compile().messages.empty());
    CHECK (doubling (times (2)).compile().messages.empty());   // without a signal, nothing can alias
}
