// SPDX-License-Identifier: GPL-3.0-or-later
// Wheels and pads at event devices, in the Devices panel. The device is that of tests/plugins/objects/moving_stick.cpp.
#include "host/app/support/on_stage.hpp"
#include "host/app/support/seen_text.hpp"

#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/app/devices_panel/devices_panel.hpp>
#include <host/app/presets/preset_list.hpp>
#include <tactus/file/graph_file.hpp>

#include <cstdlib>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::OnStage;
using tactus::host::test::Stage;

namespace
{
std::vector<ConnectedEvents> listed()
{
    return { { "Moving stick", "/dev/null", "" }, { "Pad", "/dev/input/event8", "" }, { "Pad", "/dev/input/event9", "join the group input" } };
}

/// The Devices panel on a screen, with a board to feel.
struct Bench : OnStage
{
    Bench()
    {
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        ::setenv ("TACTUS_PLUGINS", TACTUS_MOVING_STICK, 1);
        setup.open (home.path());
        run.use (setup);
        setup.onChange = [this] { run.setupChanged(); };
        panel = std::make_unique<DevicesPanel> (document, run, setup);
        panel->bindings().onHint = [this] (const juce::String& text) { hint = text; };
        stage = std::make_unique<Stage> (1200, 900);
        stage->fill (*panel);
    }

    ~Bench()
    {
        run.letGo();
        panel.reset();
        stage.reset();
        ::unsetenv ("TACTUS_PLUGINS");
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }
    Bench (const Bench&) = delete;
    Bench& operator= (const Bench&) = delete;

    static graph::Graph board() { return loadGraph (std::filesystem::path (TACTUS_SOURCE_DIR "/graphs/dry_wood.json")).graph; }

    template <typename F>
    bool until (F&& isSo)
    {
        return tactus::test::eventually ({}, [&] {
            run.poll();
            panel->refresh();
            OnStage::settle (5);
            return isSo();
        });
    }

    juce::Component& part (const juce::String& title)
    {
        auto* found = OnStage::titledIn (*panel, title);
        REQUIRE (found != nullptr);
        return *found;
    }

    void type (const juce::String& label, const juce::String& text)
    {
        stage->click (middleOf (part (label)));
        OnStage::settle();
        stage->type (text);
        stage->key ("return");
        OnStage::settle();
    }

    juce::String text()
    {
        juce::String all;
        for (const auto& seen : host::test::readTexts (*panel))
            all << seen.text << " ";
        return all;
    }

    Json binding() const
    {
        const auto* bound = setup.session().session.binding ("stylus");
        return bound != nullptr ? *bound : Json();
    }

    juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    TemporaryFolder home;
    Document document { board() };
    DeviceSetup setup { hid::thisComputer(), deviceProfiles(), listed };
    LiveRun run { document, catalogue() };
    std::unique_ptr<DevicesPanel> panel;
    juce::String hint;
};
}   // namespace

TEST_CASE ("event devices are choices, by their names unless two are alike", "[app][sessions][evdev]")
{
    const auto events = listed();
    const auto choices = bindingChoices (nullptr, {}, {}, {}, events);
    const auto has = [&] (const char* label, const char* port) {
        return std::ranges::count (choices, BindingChoice { label, { { "driver", "evdev" }, { "port", port } } }) == 1;
    };
    CHECK (has ("Moving stick, through the kernel", "Moving stick"));
    CHECK (has ("Pad (/dev/input/event8), through the kernel", "/dev/input/event8"));
    CHECK (has ("Pad (/dev/input/event9), through the kernel", "/dev/input/event9"));

    const Json calibrated { { "driver", "evdev" }, { "port", "Moving stick" }, { "calibration", { { "full_force", "4 N" } } }, { "max_rate", "100 Hz" } };
    CHECK (bindingChoices (&calibrated, {}, {}, {}, events).size() == choices.size());   // it is the first one
}

TEST_CASE ("an event device is chosen and calibrated in the window, runs, and its rate is what reaches it", "[app][sessions][evdev]")
{
    Bench b;
    const auto offers = [&] {
        auto* box = dynamic_cast<juce::ComboBox*> (OnStage::titledIn (*b.panel, "device"));
        for (int i = 0; box != nullptr && i < box->getNumItems(); ++i)
            if (box->getItemText (i).startsWith ("Moving stick")) return i;
        return -1;
    };
    REQUIRE (b.until ([&] { return offers() >= 0; }));   // the scan has found it
    OnStage::chooseFrom (*b.stage, b.middleOf (b.part ("device")), offers(), juce::ModifierKeys::leftButtonModifier);
    CHECK (b.binding() == Json { { "driver", "evdev" }, { "port", "Moving stick" } });
    REQUIRE (b.until ([&] { return b.text().contains ("Connected."); }));

    b.type ("full force", "4 N");
    b.type ("travel", "{\"x\": \"12 cm\"}");
    b.type ("max rate", "100 Hz");
    b.type ("offset", "[0, 0, \"-1 mm\"]");   // on the board
    CHECK (b.hint.isEmpty());
    CHECK (b.binding()["max_rate"] == Json ("100 Hz"));
    CHECK (dynamic_cast<juce::ComboBox&> (b.part ("device")).getText().startsWith ("Moving stick"));   // still the same choice

    b.run.start ({});
    REQUIRE (b.run.isRunning());
    CHECK (b.run.drivesDevice());
    CHECK (b.until ([&] { return b.run.tool() && std::abs (b.run.tool()->force.x()) > 0.01; }));   // the friction of the board
    REQUIRE (b.until ([&] { return ! b.run.health().empty() && b.run.health().front().reached_hz > 1.0; }));
    CHECK (b.run.health().front().reached_hz < 200.0);   // neither the rate of the graph, nor the 250 Hz of its port
    REQUIRE (b.until ([&] { return b.text().contains ("efforts/s reach it"); }));
    const auto before = b.text().upToFirstOccurrenceOf ("efforts/s reach it", false, false).trimEnd();
    const double shown = before.fromLastOccurrenceOf (" ", false, false).getDoubleValue();
    CHECK (shown > 0.0);
    CHECK (shown < 200.0);
    b.run.letGo();
}

TEST_CASE ("an event device that is away or may not be opened is said to be so", "[app][sessions][evdev]")
{
    Bench b;
    REQUIRE (b.until ([&] { return ! b.setup.events().empty(); }));
    REQUIRE (b.setup.edit ([] (DeviceSession& s) { s.bind ("stylus", { { "driver", "evdev" }, { "port", "/dev/input/event9" } }); }));
    CHECK (b.until ([&] { return b.text().contains ("join the group input"); }));
    REQUIRE (b.setup.edit ([] (DeviceSession& s) { s.bind ("stylus", { { "driver", "evdev" }, { "port", "Wheel" } }); }));
    CHECK (b.until ([&] { return b.text().contains ("Not connected."); }));
}
