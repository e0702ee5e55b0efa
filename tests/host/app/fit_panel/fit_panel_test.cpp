// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_rig.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/fit_panel/fit_panel.hpp>
#include <host/app/fit_panel/fit_table.hpp>

#include "support/waiting.hpp"

#include <tactus/kit/random.hpp>

#include <catch2/catch.hpp>

#include <fstream>
#include <limits>
#include <sstream>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskRig;

namespace
{
struct FitRig : DeskRig
{
    explicit FitRig (const std::string& preset = {}) : DeskRig (preset)
    {
        make<FitPanel> (fitPanel).setSize (1280, 680);
        desk.openMade = [this] (const graph::Graph& g, const std::string& step, bool, const std::function<void()>& then) {
            document.open (g, {}, step);
            then();
        };
    }

    FitPanel& panel() { return dynamic_cast<FitPanel&> (*DeskRig::panel->component); }

    std::filesystem::path write (const std::string& name, const std::string& text)
    {
        const auto file = home / name;
        std::ofstream (file) << text;
        return file;
    }

    void finish()
    {
        REQUIRE (tactus::test::eventually (std::chrono::milliseconds (5), [&] {
            panel().poll();
            return ! panel().isFitting();
        }));
    }
};

/// Strokes on a contact that stretches 0.1 mm and then slides at 0.8 N.
std::string strokedRows (bool with_load)
{
    Random random { 3 };
    std::ostringstream text;
    text << (with_load ? "position,force,load\n" : "position,force\n");
    double d = 0.0, last = 0.0;
    for (int i = 0; i < 1200; ++i)
    {
        const double phase = std::fmod (i / 400.0, 1.0), x = 1e-3 * (1.0 - std::abs (2.0 * phase - 1.0));
        d = std::clamp (d + x - last, -1e-4, 1e-4);
        last = x;
        text << x << "," << -0.8 * d / 1e-4 + 0.02 * random.normal() << (with_load ? ",2\n" : "\n");
    }
    return text.str();
}
}   // namespace

TEST_CASE ("fit panel: a recording opens with the kind that its columns suggest, and the fit opens as a graph", "[app][fit]")
{
    FitRig rig;
    rig.desk.fitRecording (rig.write ("strokes.csv", strokedRows (true)));
    REQUIRE (rig.panel().isOpen());
    CHECK (std::filesystem::equivalent (rig.settings.recordings, rig.home.path()));   // the next one is chosen there
    CHECK (rig.panel().kind() == FitKind::friction);
    const auto before = rig.document.identity();
    rig.finish();
    REQUIRE (rig.panel().fitted());
    CHECK (rig.panel().fitted()->report.is_good);
    CHECK (rig.panel().fitted()->report.at ("mu").value == Approx (0.4).epsilon (0.02));
    CHECK (rig.document.identity() == before);   // nothing changes until it is accepted

    rig.panel().acceptAsGraph();
    CHECK_FALSE (rig.panel().isOpen());
    CHECK (rig.document.identity() != before);
    const auto* drag = rig.document.graph().root.find ("drag");
    REQUIRE (drag);
    CHECK (drag->params.at ("mu").get<double>() == Approx (0.4).epsilon (0.02));
}

TEST_CASE ("fit panel: time, velocity, normal force and friction are strokes, whose position is integrated, and that is said", "[app][fit]")
{
    FitRig rig;
    Random random { 5 };
    std::ostringstream text;
    text << "Time,Velocity [mm/s],Normal,Friction\n";
    double d = 0.0, before = 0.0;
    for (int i = 0; i < 1200; ++i)
    {
        const double v = i % 400 < 200 ? 5.0 : -5.0;
        if (i > 0) d = std::clamp (d + 0.5 * (v + before) * 1e-6, -1e-4, 1e-4);
        before = v;
        text << 1e-3 * i << "," << v << ",2," << -0.8 * d / 1e-4 + 0.02 * random.normal() << "\n";
    }
    rig.desk.fitRecording (rig.write ("strokes.csv", text.str()));
    CHECK (rig.panel().kind() == FitKind::friction);
    CHECK (rig.panel().columns().choice().names.at ("position") == integrated_position);
    rig.finish();
    REQUIRE (rig.panel().fitted());
    const auto& report = rig.panel().fitted()->report;
    CHECK (report.at ("mu").value == Approx (0.4).epsilon (0.02));
    CHECK (report.at ("d_max").value == Approx (1e-4).epsilon (0.05));   // in m: the unit of the velocity counts
    CHECK (std::ranges::any_of (report.notes, [] (const std::string& n) { return n.find ("integral of the velocity") != std::string::npos; }));
    // A speed has no direction, and a recorded position is better.
    for (const auto* columns : { "t,speed,normal,friction", "t,velocity,normal,friction,x" })
    {
        const auto read = readRecording (rig.write (
            "other.csv", std::string (columns) + (std::string (columns).ends_with ("x") ? "\n0,1,1,1,1\n1,1,1,1,1\n" : "\n0,1,1,1\n1,1,1,1\n")));
        REQUIRE (read);
        CHECK_FALSE (read->column (integrated_position));
    }
}

TEST_CASE ("fit panel: the fitted node can be added to the open graph as one undo step", "[app][fit]")
{
    FitRig rig ("dry_wood.json");
    const auto nodes = rig.document.graph().root.nodes.size();
    rig.desk.fitRecording (rig.write ("strokes.csv", strokedRows (true)));
    rig.finish();
    REQUIRE (rig.panel().fitted());
    rig.panel().acceptIntoGraph();
    const auto& graph = rig.document.graph();
    REQUIRE (graph.root.nodes.size() == nodes + 1);
    CHECK (graph.root.nodes.back().type == "friction.elasto_plastic");
    CHECK (graph.root.nodes.back().name != "drag");   // the graph has one already
    CHECK (rig.canvas.selection().count (graph.root.nodes.back().id) == 1);
    rig.document.undo();
    CHECK (rig.document.graph().root.nodes.size() == nodes);
}

TEST_CASE ("fit panel: Cancel and Esc change nothing, also while a fit runs", "[app][fit]")
{
    FitRig rig;
    const auto file = rig.write ("strokes.csv", strokedRows (false));
    const auto before = rig.document.history().position();
    for (const bool waits : { false, true })
    {
        rig.desk.fitRecording (file);
        REQUIRE (rig.panel().isFitting());
        if (waits) rig.finish();
        rig.DeskRig::panel->escape();
        CHECK_FALSE (rig.panel().isOpen());
        CHECK_FALSE (rig.panel().isFitting());
    }
    CHECK (rig.document.history().position() == before);
}

TEST_CASE ("fit panel: another kind or amount starts a new fit, and the panel shows what is wrong", "[app][fit]")
{
    FitRig rig;
    rig.desk.fitRecording (rig.write ("strokes.csv", strokedRows (false)));
    rig.finish();
    REQUIRE (rig.panel().fitted());
    CHECK (rig.panel().fitted()->report.at ("mu").value == Approx (0.8).epsilon (0.02));   // of 1 N
    rig.panel().setAmount ("2 N");
    rig.finish();
    REQUIRE (rig.panel().fitted());
    CHECK (rig.panel().fitted()->report.at ("mu").value == Approx (0.4).epsilon (0.02));
    rig.panel().setAmount ("2 m");
    CHECK_FALSE (rig.panel().fitted());
    CHECK (rig.panel().problem().contains ("does not fit"));
    rig.panel().acceptAsGraph();
    CHECK (rig.panel().isOpen());   // there is nothing to accept

    rig.panel().choose (FitKind::texture);
    rig.finish();
    CHECK_FALSE (rig.panel().fitted());
    CHECK (rig.panel().problem().contains ("Choose the column of: time, acceleration"));
}

TEST_CASE ("fit panel: the panel reports a file that is not a recording, or whose columns suggest no kind", "[app][fit]")
{
    FitRig rig;
    rig.desk.fitRecording (rig.write ("text.csv", "this is\nno table\n"));
    REQUIRE (rig.panel().isOpen());
    CHECK (rig.panel().problem().isNotEmpty());
    rig.desk.fitRecording (rig.write ("letters.csv", "a,b\n1,2\n3,4\n"));
    CHECK_FALSE (rig.panel().kind());
    CHECK (rig.panel().problem().contains ("Choose"));
    rig.panel().choose (FitKind::friction);
    CHECK_FALSE (rig.panel().isFitting());
    CHECK (rig.panel().problem().contains ("position, force"));
    rig.desk.fitRecording (rig.home / "missing.csv");
    CHECK (rig.panel().problem().isNotEmpty());
}

TEST_CASE ("fit panel: columns and units can be chosen, and a wrong unit is said", "[app][fit]")
{
    FitRig rig;
    auto text = strokedRows (true);
    text.replace (0, text.find ('\n'), "a,b,c");
    rig.desk.fitRecording (rig.write ("letters.csv", text));
    auto& panel = rig.panel();
    panel.choose (FitKind::friction);
    panel.columns().chooseColumn ("position", "a");
    CHECK_FALSE (panel.isFitting());
    panel.columns().chooseColumn ("force", "b");
    rig.finish();
    REQUIRE (panel.fitted());
    CHECK (panel.fitted()->report.at ("mu").value == Approx (0.8).epsilon (0.02));   // of 1 N
    panel.columns().chooseColumn ("load", "c");
    rig.finish();
    REQUIRE (panel.fitted());
    CHECK (panel.fitted()->report.at ("mu").value == Approx (0.4).epsilon (0.02));
    panel.columns().setUnit ("position", "mm");
    rig.finish();
    REQUIRE (panel.fitted());
    CHECK (panel.fitted()->report.at ("d_max").value == Approx (1e-7).epsilon (0.02));
    panel.columns().setUnit ("position", "N");
    CHECK_FALSE (panel.isFitting());
    CHECK_FALSE (panel.fitted());
    CHECK (panel.problem().contains ("\"N\" does not fit"));
    panel.columns().setUnit ("position", "1 m");
    panel.columns().chooseColumn ("load", {});
    rig.finish();
    REQUIRE (panel.fitted());
    CHECK (panel.fitted()->report.at ("mu").value == Approx (0.8).epsilon (0.02));
}

namespace
{
/// The description of the table, which a screen reader reads, begins with the verdict. Checks that the texts about the fit agree with it.
bool saysPoor (FitRig& rig)
{
    const auto& made = *rig.panel().fitted();
    juce::String table;
    const auto look_in = [&] (auto&& self, juce::Component& c) -> void {
        if (c.getTitle() == "Fitted parameters") table = c.getDescription();
        for (auto* child : c.getChildren())
            self (self, *child);
    };
    look_in (look_in, rig.panel());
    const bool is_poor = table.startsWith ("Poor fit");
    CHECK (is_poor != table.startsWith ("Good fit"));
    CHECK (is_poor == (verdictOf (made.report) == "poor"));
    CHECK (is_poor != made.report.lacking.empty());
    CHECK ((is_poor || made.warnings.empty()));
    for (const auto& [place, source] : made.preset.extra.at ("ui").at ("sources").items())
        if (const auto text = source.get<std::string>(); text.find ("residual") != std::string::npos)
            CHECK (text.ends_with (is_poor ? "poor" : "good"));
    return is_poor;
}

/// A key that travels 4 mm and back. At 1.5 mm, it snaps by `snap` of its force.
std::string keyRows (double snap, const char* header, bool has_contact)
{
    std::ostringstream text;
    text << header << "\n";
    for (int i = 0; i < 1600; ++i)
    {
        const double depth = 0.005 * std::min (i, 1600 - i), back = i < 800 ? 0.0 : 3.0;
        const double force = 60.0 * std::min (1.0, depth) - 60.0 * snap * std::clamp ((depth - 1.5) / 0.4, 0.0, 1.0) + 60.0 * std::max (0.0, depth - 3.0);
        text << 1000.0 * depth << "," << std::max (0.0, force - std::min (force, back)) << (has_contact ? (depth > 2.0 ? ",1\n" : ",0\n") : "\n");
    }
    return text.str();
}
}   // namespace

TEST_CASE ("fit panel: a key is guessed by its snap or by the column of its contact, and a soft body is none", "[app][fit]")
{
    FitRig rig;
    const auto kindOf = [&] (const std::string& rows) {
        rig.desk.fitRecording (rig.write ("recording.csv", rows));
        return rig.panel().kind();
    };
    CHECK (kindOf (keyRows (0.3, "x_um,force_gf,actuated", true)) == FitKind::key_switch);
    rig.finish();
    REQUIRE (rig.panel().fitted());
    CHECK_FALSE (saysPoor (rig));
    CHECK (kindOf (keyRows (0.0, "x_um,force_gf,actuated", true)) == FitKind::key_switch);   // a linear key
    CHECK (kindOf (keyRows (0.3, "x_um,force_gf", false)) == FitKind::key_switch);
    CHECK (kindOf (keyRows (0.0, "x_um,force_gf", false)) == FitKind::curve);
    CHECK (kindOf (keyRows (0.3, "x_mm,force_N", false)) == FitKind::curve);   // no key travels 4 m
}

TEST_CASE ("fit panel: a doubt about a fit is a reason for a poor verdict, which all texts give", "[app][fit]")
{
    FitRig rig;
    std::ostringstream text;
    text << "depth,force,t\n";
    for (int i = 0; i <= 60; ++i)
    {
        const double phase = 3.14159265358979 * i / 60.0, depth = 1e-3 * std::max (0.0, std::sin (phase));
        text << depth << "," << 5000.0 * depth * (1.0 + 0.2 * std::cos (phase)) << "," << i * 1e-4 << "\n";
    }
    rig.desk.fitRecording (rig.write ("impact.csv", text.str()));
    REQUIRE (rig.panel().kind() == FitKind::shock);
    bool is_doubted = false;
    for (const char* mass : { "", "20 kg", "0.1 g" })
    {
        rig.panel().setAmount (mass);
        rig.finish();
        INFO (mass << rig.panel().problem());
        if (! rig.panel().fitted()) continue;
        const bool has_doubt = ! rig.panel().fitted()->warnings.empty();
        is_doubted = is_doubted || has_doubt;
        const bool is_poor = saysPoor (rig);
        if (has_doubt) CHECK (is_poor);
    }
    CHECK (is_doubted);
}

TEST_CASE ("fit panel: a press that snaps is said, and the depth of the touch can be given", "[app][fit]")
{
    FitRig rig;
    std::ostringstream text;
    text << "depth_mm,force\n";
    for (int i = 0; i < 800; ++i)
    {
        const double depth = 0.005 * std::min (i, 800 - i);
        text << depth << "," << (depth > 1.2 && depth < 1.5 ? 0.4 : 1.0) * std::max (0.0, depth - 0.5) << "\n";
    }
    rig.desk.fitRecording (rig.write ("key.csv", text.str()));
    CHECK (rig.panel().kind() == FitKind::key_switch);   // it snaps on its way to the stop, and comes back
    rig.panel().choose (FitKind::curve);
    rig.finish();
    REQUIRE (rig.panel().fitted());
    REQUIRE (rig.panel().fitted()->warnings.size() == 1);
    CHECK (rig.panel().fitted()->warnings[0].id == "fit/falls");
    CHECK (saysPoor (rig));
    const double whole = rig.panel().fitted()->report.picture.curves.front().x.back();
    rig.panel().setAmount ("0.5 mm");
    rig.finish();
    REQUIRE (rig.panel().fitted());
    CHECK (rig.panel().fitted()->report.picture.curves.front().x.back() == Approx (whole - 5e-4));
}

TEST_CASE ("fit panel: a height and the force on the sensor are guessed, fitted and drawn as depth and force, and that is said", "[app][fit]")
{
    FitRig rig;
    std::ostringstream text;
    text << "time_s,z_mm,Fz_mN\n";
    for (int i = 0; i < 800; ++i)
    {
        const double depth = 0.005 * std::min (i, 800 - i);   // mm
        text << i * 1e-3 << "," << -depth << "," << -400.0 * depth - 50.0 * depth * depth << "\n";
    }
    rig.desk.fitRecording (rig.write ("press.csv", text.str()));
    CHECK (rig.panel().kind() == FitKind::curve);
    rig.finish();
    INFO (rig.panel().problem());
    REQUIRE (rig.panel().fitted());
    const auto& report = rig.panel().fitted()->report;
    CHECK (report.is_good);
    for (const char* role : { "depth", "force" })
        CHECK (std::ranges::count (report.notes, "the " + std::string (role) + " is negative in the recording; its sign was turned") == 1);
    const auto& recorded = report.picture.curves.front();
    CHECK (*std::ranges::max_element (recorded.x) == Approx (2e-3));
    CHECK (*std::ranges::max_element (recorded.y) == Approx (1.0));
    const auto texts = tactus::host::test::readTexts (rig.panel());
    CHECK (std::ranges::any_of (texts, [] (const auto& t) { return t.text.contains ("sign was turned"); }));
}

TEST_CASE ("fit panel: the time of the blow can be given for a ring, and a time that cannot be is refused with the times that can", "[app][fit]")
{
    FitRig rig;
    std::ostringstream text;
    text << "t,value\n";
    for (int i = 0; i < 1600; ++i)
    {
        const double t = i / 8000.0 - 0.01;
        text << t + 0.01 << "," << (t < 0.0 ? 0.0 : std::exp (-30.0 * t) * std::sin (2.0 * 3.14159265358979 * 220.0 * t)) << "\n";
    }
    rig.desk.fitRecording (rig.write ("ring.csv", text.str()));
    rig.finish();
    auto& panel = rig.panel();
    REQUIRE (panel.kind() == FitKind::modes);
    REQUIRE (panel.fitted());
    const double found = panel.fitted()->report.at ("mode 1 amplitude").value;
    CHECK (found == Approx (1.0).epsilon (0.02));
    panel.setAmount ("5 ms");   // 5 ms before the blow, the ring would have been larger
    rig.finish();
    REQUIRE (panel.fitted());
    CHECK (panel.fitted()->report.at ("mode 1 amplitude").value == Approx (found * std::exp (30.0 * 0.005)).epsilon (0.02));
    for (const char* wrong : { "1 s", "-1 s", "2 mm", "soon" })
    {
        INFO (wrong);
        panel.setAmount (wrong);
        rig.finish();
        CHECK_FALSE (panel.fitted());
        CHECK (panel.problem().contains (juce::String (wrong).endsWith (" s") ? "give a time from" : "Time of the blow"));
    }
    panel.setAmount ({});
    rig.finish();
    REQUIRE (panel.fitted());
    CHECK (panel.fitted()->report.at ("mode 1 amplitude").value == Approx (found));
}

TEST_CASE ("fit panel: it is drawn in both themes at each size", "[app][fit]")
{
    FitRig rig;
    rig.desk.fitRecording (rig.write ("strokes.csv", strokedRows (true)));
    rig.finish();
    for (const auto* theme : { &Theme::dark(), &Theme::light() })
        for (const auto& [width, height] : { std::pair { 1280, 720 }, std::pair { 1024, 700 }, std::pair { 640, 480 } })
        {
            rig.look.setTheme (*theme);
            rig.panel().setSize (width, height);
            const auto picture = rig.panel().createComponentSnapshot (rig.panel().getLocalBounds());
            CHECK (picture.getPixelAt (picture.getWidth() / 2, picture.getHeight() / 2) != picture.getPixelAt (2, 2));
        }
}

TEST_CASE ("fit panel: a recording of numbers near the smallest is fitted or refused with a reason, and the window goes on", "[app][fit]")
{
    FitRig rig;
    std::string rows = "t,x,force\n";
    for (int i = 0; i < 4000; ++i)
    {
        const double t = i * 1e-3, x = 5e-3 * std::sin (3.14159 * t);
        std::ostringstream line;
        line << t << "," << x << "," << 1e-310 * std::tanh (1e4 * x) << "\n";
        rows += line.str();
    }
    rig.desk.fitRecording (rig.write ("tiny.csv", rows));
    rig.finish();
    CHECK ((rig.panel().fitted().has_value() || rig.panel().problem().isNotEmpty()));
}

TEST_CASE ("fit panel: a bound that is not known is called unknown, with and without a prefix", "[app][fit]")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    {
        constexpr double none = std::numeric_limits<double>::infinity();
        FittedGraph made;
        made.report.values = { { "d_max", "m", 402e-6, 398e-6, none }, { "mu", "", 0.4, -none, 0.5 }, { "load", "N", 2.0, -none, none } };
        made.report.residual = made.report.size = 1.0;
        FitTable table;
        table.setSize (400, 300);
        table.show (made);
        juce::StringArray texts;
        for (const auto& t : tactus::host::test::readTexts (table))
            texts.add (t.text);
        const auto all = texts.joinIntoString ("|");
        INFO (all);
        CHECK (all.contains (juce::String::fromUTF8 ("402 \xc2\xb5m")));
        CHECK (all.contains (juce::String::fromUTF8 ("398 \xe2\x80\xa6 unknown")));
        CHECK_FALSE (all.contains (juce::String::fromUTF8 ("\xc2\xb5nknown")));
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}
