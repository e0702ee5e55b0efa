// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/seen_text.hpp"
#include "host/app/support/wait_for.hpp"
#include "scope_bench.hpp"

#include "support/waiting.hpp"

#include <host/app/scopes/energy_plot.hpp>
#include <host/app/scopes/spectrogram_plot.hpp>
#include <host/app/scopes/time_plot.hpp>
#include <support/temporary_folder.hpp>
#include <tactus/file/csv.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::Bench;
using tactus::host::test::readTexts;
using tactus::host::test::SeenText;

namespace
{
juce::MouseEvent mouse (juce::Component& c, juce::Point<float> at, juce::Point<float> from, bool dragged, int mods = 0)
{
    const auto now = juce::Time::getCurrentTime();
    return { juce::Desktop::getInstance().getMainMouseSource(), at, juce::ModifierKeys (mods), 1.0f, 0, 0, 0, 0, &c, &c, now, from, now, 1, dragged };
}

void clickAt (juce::Component& c, juce::Point<float> at)
{
    constexpr int left = juce::ModifierKeys::leftButtonModifier;
    c.mouseDown (mouse (c, at, at, false, left));
    c.mouseUp (mouse (c, at, at, false, left));
}

/// The number of pixels of roughly this colour.
int countOf (const juce::Image& image, juce::Colour colour)
{
    int count = 0;
    for (int y = 0; y < image.getHeight(); ++y)
        for (int x = 0; x < image.getWidth(); ++x)
        {
            const auto c = image.getPixelAt (x, y);
            count += std::abs (c.getRed() - colour.getRed()) + std::abs (c.getGreen() - colour.getGreen()) + std::abs (c.getBlue() - colour.getBlue()) < 24;
        }
    return count;
}
}   // namespace

TEST_CASE ("scopes: a newly opened graph shows scopes, which request only the ports they need", "[app][scopes]")
{
    Bench b;
    REQUIRE (b.panel->shown().size() == 3);
    auto wanted = b.live_run.traces().ports();
    std::ranges::sort (wanted);
    CHECK (wanted
           == std::vector<std::string> { "board.dissipated_energy", "board.stored_energy", "drag.dissipated_energy", "drag.force", "drag.state",
                                         "drag.stored_energy", "hand.position", "motor.applied" });
}

TEST_CASE ("scopes: a graph with more energies than can be recorded shows no scope that stays empty", "[app][scopes]")
{
    const TemporaryFolder folder;
    std::string nodes = R"("hand": { "type": "device.position", "role": "stylus" }, "motor": { "type": "device.force", "role": "stylus" })", wires;
    for (int i = 0; i < 1000; ++i)
    {
        const auto name = "pad" + std::to_string (i);
        nodes += ", \"" + name + R"(": { "type": "deform.plane" })";
        wires += (i > 0 ? ", \"hand.position -> " : "\"hand.position -> ") + name + ".position\", \"" + name + ".force -> motor.force\"";
    }
    std::ofstream (folder / "big.json")
        << R"({ "format": "tactus-graph", "version": 2, "name": "Big", "devices": { "stylus": { "driver": "sim" } }, "nodes": { )" << nodes
        << R"( }, "wires": [ )" << wires << " ] }";
    Bench b ((folder / "big").string());
    REQUIRE (b.document.graph().root.nodes.size() == 1002);
    auto wanted = b.live_run.traces().ports();
    std::ranges::sort (wanted);
    CHECK (wanted == std::vector<std::string> { "hand.position", "motor.applied", "pad0.force" });
    b.run (20);
    CHECK (b.panel->warning().isEmpty());
    for (const auto& view : b.panel->shown())
        CHECK_FALSE (view->plot().shownLanes().empty());

    // On request, it shows the work of the hand, and what it does not show.
    b.panel->add (ScopeKind::energy);
    b.run (20);
    CHECK (b.panel->warning().isEmpty());
    CHECK_FALSE (b.view (ScopeKind::energy).plot().shownLanes().empty());
    const auto texts = readTexts (b.view (ScopeKind::energy));
    const auto says = [&] (const std::vector<SeenText>& all, const char* words) {
        juce::String lines;
        for (const auto& t : all)
            lines << t.text << ' ';
        return lines.contains (words);
    };
    CHECK (says (texts, "not recorded"));
    CHECK_FALSE (says (texts, "passive"));

    // Of too many ports, the rest is said to be left out, and not that nothing runs.
    auto& last = b.panel->add (ScopeKind::time);
    for (int i = 0; i < 20; ++i)
        b.panel->probe ({ "pad" + std::to_string (i) + ".force" });
    b.run (20);
    CHECK (b.panel->warning().isNotEmpty());
    for (int i = 0; i < 8; ++i)
        b.panel->probe ({ "pad" + std::to_string (i) + ".force" });
    CHECK_FALSE (says (readTexts (last), "not run yet"));
}

TEST_CASE ("scopes: a force along x is plotted in the colour of x", "[app][scopes]")
{
    Bench b;
    auto& plot = b.view (ScopeKind::time).plot();
    const auto force = b.look.theme().axes[0];
    const auto picture = [&] { return plot.createComponentSnapshot (plot.getLocalBounds()); };
    b.panel->refresh();
    CHECK (plot.shownLanes().empty());
    CHECK (countOf (picture(), force) == 0);
    b.run (6000);
    REQUIRE (plot.shownLanes().size() == 1);
    CHECK (plot.shownLanes().front().unit == "N");
    CHECK (countOf (picture(), force) > 200);
}

TEST_CASE ("scopes: against displacement, sticking and sliding have different colours", "[app][scopes]")
{
    constexpr int in_legend = 64;
    Bench b;
    auto& plot = b.view (ScopeKind::over).plot();
    const auto count = [&] (Quantity q) { return countOf (plot.createComponentSnapshot (plot.getLocalBounds()), b.look.theme().of (q)); };
    b.run (6000);
    CHECK (count (Quantity::length) > 3 * in_legend);   // it sticks and slips

    REQUIRE (b.document.perform (graph::SetParam { "", "drag", "static_ratio", 1.0 }));
    b.live_run.stop();
    b.run (20000);
    CHECK (count (Quantity::force) > 2 * in_legend);   // it slides
}

TEST_CASE ("scopes: each unit has a lane, and all components of a vector share one", "[app][scopes]")
{
    Bench b;
    b.panel->probe ({ "board.depth" });
    b.panel->probe ({ "drag.force" });
    b.run (500);
    const auto& lanes = b.view (ScopeKind::time).plot().shownLanes();
    REQUIRE (lanes.size() == 2);
    CHECK (lanes[0].unit == "N");
    CHECK (lanes[1].unit == "m");
    CHECK (lanes[0].x.low == lanes[1].x.low);
    CHECK (lanes[0].area.getBottom() <= lanes[1].area.getY());
}

TEST_CASE ("scopes: ports that share a lane, such as those of two roles, have colours of their own, and a legend names them", "[app][scopes]")
{
    Bench b;
    const auto inLegend = [&] (const juce::String& word) {
        return std::ranges::count_if (readTexts (b.view (ScopeKind::time).plot()), [&] (const auto& seen) { return seen.text == word; });
    };
    b.run (500);
    CHECK (inLegend ("motor.applied") == 0);   // alone, it is named above the plot
    b.panel->probe ({ "drag.force" });
    b.run (500);
    CHECK (b.view (ScopeKind::time).shown().ports.size() == 2);
    CHECK (inLegend ("motor.applied") == 1);
    CHECK (inLegend ("drag.force") == 1);
    const auto colour = [] (std::size_t port) { return traceColour (Theme::dark(), Quantity::force, port, 0, 3); };
    CHECK (colour (0) != colour (1));
}

TEST_CASE ("scopes: a removed port is marked as gone, and comes back with undo", "[app][scopes]")
{
    Bench b;
    b.panel->probe ({ "grain.value" });
    b.run (100);
    auto& view = b.view (ScopeKind::time);
    REQUIRE (b.document.perform (graph::RemoveNode { "", "grain" }));
    b.live_run.stop();
    b.run (100);
    CHECK (std::ranges::count (Bench::labels (view), "grain.value no longer exists") == 1);
    b.document.undo();
    b.live_run.stop();
    b.run (100);
    CHECK (std::ranges::count (Bench::labels (view), "grain.value no longer exists") == 0);
}

TEST_CASE ("scopes: the cross of a port removes it, its name does not", "[app][scopes]")
{
    Bench b;
    b.panel->probe ({ "board.depth" });
    b.run (100);
    auto& view = b.view (ScopeKind::time);
    const auto chip = [&]() -> FlatButton& {
        for (auto* child : view.getChildren())
            if (auto* button = dynamic_cast<FlatButton*> (child); button != nullptr && button->getButtonText() == "board.depth") return *button;
        throw std::runtime_error ("no chip");
    };
    const auto at = [&] (float x) {
        clickAt (chip(), { x, 12.0f });
        host::test::settle();
    };
    at (20.0f);
    CHECK (b.panel->isProbed ("board.depth"));
    at (static_cast<float> (chip().getWidth()) - 8.0f);
    CHECK_FALSE (b.panel->isProbed ("board.depth"));
    CHECK (std::ranges::count (b.live_run.traces().ports(), "board.depth") == 0);
}

TEST_CASE ("scopes: a frozen scope does not change while the run continues", "[app][scopes]")
{
    Bench b;
    b.run (3000);
    auto& view = b.view (ScopeKind::time);
    auto& plot = dynamic_cast<TimePlot&> (view.plot());
    CHECK (b.panel->keyPressed (juce::KeyPress ('x', juce::ModifierKeys(), 'x')));
    CHECK (b.panel->isFrozen());
    const auto end = plot.window().to;
    b.run (1000);
    CHECK (plot.window().to == end);

    // A drag to the right shows earlier ticks.
    const juce::Point<float> from { 100.0f, 60.0f };
    plot.mouseDown (mouse (plot, from, from, false));
    plot.mouseDrag (mouse (plot, from.translated (50.0f, 0.0f), from, true));
    plot.mouseUp (mouse (plot, from.translated (50.0f, 0.0f), from, true));
    b.panel->refresh();
    CHECK (plot.window().to < end);
    CHECK (view.shown().cursors.empty());   // no click

    b.panel->freezeAll (false);
    b.panel->refresh();
    CHECK (plot.window().to == 4000.0);
}

TEST_CASE ("scopes: a cursor stays on its curve while the curve moves", "[app][scopes]")
{
    Bench b;
    b.run (6000);
    auto& view = b.view (ScopeKind::time);
    auto& plot = view.plot();
    const auto lane = plot.shownLanes().front();
    const auto trace = b.live_run.traces().of (view.shown().ports.front()).front();   // x, along which the tool strokes
    clickAt (plot, lane.toPixels (-0.5, trace->at (trace->end() - static_cast<std::uint64_t> (0.5 * trace->rate()))));
    REQUIRE (view.shown().cursors.size() == 1);
    const auto before = view.shown().cursors.front();
    REQUIRE (before.curve);
    std::vector<double> read;
    for (int i = 0; i < 8; ++i)
    {
        b.run (400);
        b.panel->refresh();
        const auto& now = view.shown().cursors.front();
        CHECK (now.x == before.x);
        CHECK (now.curve == before.curve);
        read.push_back (now.y);
    }
    CHECK (*std::ranges::max_element (read) > *std::ranges::min_element (read));
}

TEST_CASE ("scopes: two clicks measure, the wheel zooms time, and Shift+wheel zooms values around the pointer", "[app][scopes]")
{
    Bench b;
    b.run (6000);
    auto& view = b.view (ScopeKind::time);
    auto& plot = view.plot();
    const auto lane = plot.shownLanes().front();
    const auto a = lane.toPixels (-0.5, 0.0), c = lane.toPixels (-0.25, 0.1);   // off the curve: a cursor reads the curve
    clickAt (plot, a);
    clickAt (plot, c);
    REQUIRE (view.shown().cursors.size() == 2);
    CHECK (view.shown().cursors[1].x - view.shown().cursors[0].x == Approx (0.25).margin (1e-4));
    for (const auto& cursor : view.shown().cursors)
    {
        bool is_on_curve = false;
        for (const auto& port : view.shown().ports)
            for (const auto& trace : b.live_run.traces().of (port))
            {
                const auto tick = static_cast<std::uint64_t> (std::lround (static_cast<double> (trace->end()) + cursor.x * trace->rate()));
                const auto pixel = static_cast<std::uint64_t> (std::ceil (trace->rate() * view.shown().seconds / static_cast<double> (lane.area.getWidth())));
                Extent near;
                for (auto k = tick - 2 * pixel; k <= tick + 2 * pixel; ++k)
                    near.include (trace->at (k));
                is_on_curve = is_on_curve || (trace->unit() == lane.unit && cursor.y >= near.low && cursor.y <= near.high);
            }
        CAPTURE (cursor.x, cursor.y);
        CHECK (is_on_curve);
    }

    const double before = view.shown().seconds;
    plot.mouseWheelMove (mouse (plot, a, a, false), { 0.0f, 0.5f, false, false, false });
    CHECK (view.shown().seconds < before);
    const double pointed = plot.shownLanes().front().yAt (a.y), size = plot.shownLanes().front().y.size();
    plot.mouseWheelMove (mouse (plot, a, a, false, juce::ModifierKeys::shiftModifier), { 0.0f, 0.5f, false, false, false });
    CHECK (plot.shownLanes().front().y.size() < size);
    CHECK (plot.shownLanes().front().yAt (a.y) == Approx (pointed).margin (1e-9));
    plot.mouseDoubleClick (mouse (plot, a, a, false));
    CHECK (view.shown().zoomed.empty());
}

TEST_CASE ("scopes: the trigger level can be dragged by its marker", "[app][scopes]")
{
    Bench b;
    b.run (6000);
    auto& view = b.view (ScopeKind::time);
    auto& plot = view.plot();
    auto actions = plot.actions();
    actions[1].onClick (plot);   // rising
    CHECK (view.shown().trigger.edge == ScopeTrigger::Edge::rising);
    b.panel->refresh();
    const auto lane = plot.shownLanes().front();
    const juce::Point<float> marker { lane.area.getRight(), lane.toPixels (0.0, view.shown().trigger.level).y }, to { marker.x, lane.toPixels (0.0, 0.25).y };
    plot.mouseDown (mouse (plot, marker, marker, false));
    plot.mouseDrag (mouse (plot, to, marker, true));
    plot.mouseUp (mouse (plot, to, marker, true));
    CHECK (view.shown().trigger.level == Approx (0.25).margin (1e-6));
    b.panel->refresh();
    CHECK (dynamic_cast<TimePlot&> (plot).window().trigger);
}

TEST_CASE ("scopes: a scope is saved as an image of twice its size, and as data of its traces", "[app][scopes]")
{
    Bench b;
    b.run (4000);
    auto& view = b.view (ScopeKind::over);
    const TemporaryFolder folder;
    REQUIRE (view.saveImage (folder / "scope.png"));
    const auto image = juce::ImageFileFormat::loadFrom (juce::File ((folder / "scope.png").string()));
    CHECK (image.getWidth() == 2 * view.getWidth());
    CHECK (image.getHeight() == 2 * view.getHeight());
    CHECK (countOf (image, b.look.theme().of (Quantity::force)) > 400);

    REQUIRE (view.saveData (folder / "scope.csv"));
    const auto table = readTable (folder / "scope.csv");
    REQUIRE (table);
    CHECK (table->columns
           == std::vector<std::string> { "t", "hand.position.x", "hand.position.y", "hand.position.z", "drag.force.x", "drag.force.y", "drag.force.z",
                                         "drag.state" });
    CHECK (table->rows() == 4000);
    CHECK (table->at (4, 0) == 0.001);
    CHECK_FALSE (view.saveData (folder / "no such folder/a.csv"));
}

TEST_CASE ("scopes: the warning names the components that exceed the recording limit", "[app][scopes]")
{
    Bench b;
    b.run (10);
    CHECK (b.panel->warning().isEmpty());
    for (const char* port : { "motor.force", "drag.deflection", "board.force", "grain.force", "grain_felt.out", "hand.rotation", "grain.value" })
        b.panel->probe ({ port });
    b.run (10);
    CHECK (b.panel->warning().startsWith ("At most 32 components are recorded; not shown: "));
    CHECK (b.live_run.traces().leftOut().size() == 1);
    b.panel->probe ({ "hand.rotation" });
    b.run (10);
    CHECK (b.panel->warning().isEmpty());
}

TEST_CASE ("scopes: all scopes can be closed, and an empty panel suggests a port", "[app][scopes]")
{
    Bench b;
    while (! b.panel->shown().empty())
    {
        const auto left = b.panel->shown().size();
        for (auto* child : b.panel->shown().front()->getChildren())
            if (child->getName() == "Close this scope") dynamic_cast<juce::Button&> (*child).onClick();
        host::test::settle();
        REQUIRE (b.panel->shown().size() == left - 1);
    }
    CHECK (b.live_run.traces().ports().empty());
    const auto all = Bench::labels (*b.panel);
    REQUIRE (std::ranges::count (all, "board.force") == 1);
    for (auto* child : b.panel->getChildren())
        if (child->getName() == "board.force")
        {
            CHECK (child->isVisible());
            dynamic_cast<juce::Button&> (*child).onClick();
        }
    CHECK (b.panel->isProbed ("board.force"));
    CHECK (b.panel->shown().size() == 1);
}

TEST_CASE ("scopes: every kind of scope can be added to presets, run, and painted in both themes", "[app][scopes]")
{
    for (const char* name : { "dry_wood", "scissors_cloth", "two_fingers", "squealing_rubber", "granite_wall" })
    {
        INFO (name);
        Bench b (name);
        for (const auto kind : { ScopeKind::spectrum, ScopeKind::spectrogram, ScopeKind::tool })
            b.panel->add (kind);
        b.run (300);
        for (const auto* theme : { &Theme::light(), &Theme::dark() })
        {
            b.look.setTheme (*theme);
            b.panel->refresh();
            CHECK (countOf (b.panel->createComponentSnapshot (b.panel->getLocalBounds()), theme->canvas) > 10000);
        }
    }
}

TEST_CASE ("scopes: a real-time run is shown, and stays shown when a port is added", "[app][scopes]")
{
    Bench b;
    b.live_run.start (LiveRun::Hand {});
    REQUIRE (b.live_run.isRunning());
    Traces::Client client (b.live_run.traces());
    const auto ticksOf = [&] (const std::string& port) {
        const auto traces = client.of (port);
        return traces.empty() ? std::uint64_t { 0 } : traces.front()->end() - traces.front()->begin();
    };
    const auto waitFor = [&] (const std::string& port, std::uint64_t ticks) {
        return tactus::test::eventually (std::chrono::milliseconds (10), [&] {
            b.live_run.poll();
            b.panel->refresh();
            return ticksOf (port) >= ticks;
        });
    };
    REQUIRE (waitFor ("motor.applied", 400));
    const auto first = client.of ("motor.applied").front()->begin();
    b.panel->probe ({ "board.depth" });
    REQUIRE (waitFor ("board.depth", 400));
    CHECK (client.of ("motor.applied").front()->begin() == first);   // the same trace, possibly with a gap
    CHECK (b.view (ScopeKind::time).plot().shownLanes().size() == 2);
    b.live_run.stop();
}

TEST_CASE ("scopes: a spectrogram scrolls while it runs, stays while it is frozen, and says what is loudest", "[app][scopes][spectrogram]")
{
    Bench b;
    auto& view = b.panel->add (ScopeKind::spectrogram);
    const auto& plot = dynamic_cast<SpectrogramPlot&> (view.plot());
    CHECK (plot.picture().columns() == 0);
    b.run (8000);
    REQUIRE (plot.shownLanes().size() == 1);
    CHECK (plot.shownLanes().front().unit == "Hz");
    CHECK (plot.shownLanes().front().y.high == 1000.0);
    for (int i = 0; i < 40 && plot.picture().isBehind(); ++i)
        b.panel->refresh();
    const auto columns = plot.picture().columns();
    CHECK (columns > 50);
    CHECK_FALSE (plot.picture().decibels().isEmpty());
    CHECK (plot.getDescription().contains ("Hz"));
    CHECK (plot.getTitle() == "Spectrogram");
    view.freeze (true);
    b.run (4000);
    CHECK (plot.picture().columns() == columns);
    view.freeze (false);
    b.run (400);
    CHECK (plot.picture().columns() > columns);
}

TEST_CASE ("scopes: the cost of scopes over ten seconds", "[.][bench]")
{
    Bench b;
    b.panel->add (ScopeKind::spectrum);
    b.panel->add (ScopeKind::spectrogram);
    b.panel->add (ScopeKind::tool);
    b.run (44000);
    for (const bool is_long : { false, true })
        for (const auto& v : b.panel->shown())
        {
            if (is_long)
                for (const auto& s : b.panel->scopes().scopes)
                    s->seconds = 10.0;
            juce::Image image (juce::Image::ARGB, v->getWidth(), v->getHeight(), true);
            double reading = 0.0, painting = 0.0;
            constexpr int times = 30;
            for (int i = 0; i < times; ++i)
            {
                const tactus::test::Stopwatch watch;
                v->refresh();
                const double read_s = watch.s();
                juce::Graphics g (image);
                v->paintEntireComponent (g, false);
                reading += 1e3 * read_s / times;
                painting += 1e3 * (watch.s() - read_s) / times;
            }
            std::cout << titleOf (v->shown().kind) << " over " << v->shown().seconds << " s: refresh " << reading << " ms, paint " << painting << " ms\n";
        }
}

TEST_CASE ("scopes: for a slow stroke over a preset, the nodes account for all work of the hand", "[app][scopes]")
{
    for (const char* name : { "dry_wood", "squealing_rubber", "soft_pad", "bare_skin" })
    {
        INFO (name);
        Bench b (name);
        b.speed = 0.25;
        b.run (36000);
        const auto& balance = dynamic_cast<EnergyPlot&> (b.view (ScopeKind::energy).plot()).balance();
        INFO (describe (balance));
        CHECK (balance.isPassive());
        CHECK (balance.work > 1e-5);
        CHECK (balance.gaps == 0);
        CHECK (std::abs (balance.elsewhere()) < 0.05 * balance.work);
    }
}

TEST_CASE ("scopes: what is said about the energy does not cover the legend, and no word of a legend is cut, however narrow the scope is", "[app][scopes]")
{
    Bench b ("bronze_bell");
    b.run (4000);
    auto& view = b.view (ScopeKind::energy);
    auto& over = b.view (ScopeKind::over).plot();
    int legends = 0;
    for (int width = 1600; width >= 660; width -= 20)
    {
        INFO (width);
        b.panel->setSize (width, 260);
        b.panel->refresh();
        const auto texts = readTexts (view);
        CHECK (tactus::host::test::cutOff (readTexts (over), over.getLocalBounds().toFloat()).joinIntoString (", ") == "");
        const auto legend = std::ranges::find (texts, "hand", &SeenText::text);
        if (legend == texts.end()) continue;   // there is no room for it
        ++legends;
        for (const auto& t : texts)
            if (&t != &*legend) CHECK_FALSE (t.place.reduced (1.0f).intersects (legend->place.reduced (1.0f)));
    }
    CHECK (legends > 10);
}

TEST_CASE ("scopes: what does not change is not drawn again", "[app][scopes]")
{
    Bench b;
    b.run (500);
    const auto refresh = [&] (int times) {
        for (int i = 0; i < times; ++i)
            b.panel->refresh();
    };
    const auto redraws = [&] {
        std::size_t all = 0;
        for (const auto& v : b.panel->shown())
            all += v->redraws();
        return all;
    };
    const auto drawnBy = [&] (auto&& change) {
        refresh (200);
        const auto before = redraws();
        refresh (50);
        CHECK (redraws() == before);
        change();
        refresh (1);
        return redraws() - before;
    };
    const auto scopes = b.panel->shown().size();
    CHECK (drawnBy ([&] { b.run (1); }) >= scopes);
    CHECK (drawnBy ([&] { b.panel->setSize (1000, 240); }) == scopes);
    CHECK (drawnBy ([&] { REQUIRE (b.document.perform (graph::RemoveNode { "", "grain" })); }) >= scopes);
    CHECK (drawnBy ([&] { b.panel->freezeAll (true); }) >= scopes);
    CHECK (drawnBy ([&] { b.run (100); }) == 0);   // all are frozen
    auto& plot = b.view (ScopeKind::time).plot();
    CHECK (drawnBy ([&] { clickAt (plot, { 200.0f, 60.0f }); }) == 1);   // a cursor
    CHECK (plot.shownLanes().size() == 1);
}
