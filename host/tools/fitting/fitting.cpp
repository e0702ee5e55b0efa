// SPDX-License-Identifier: MIT
#include "fitting.hpp"
#include "fit_presets.hpp"
#include "pressing.hpp"
#include "surface_preset.hpp"

#include <tactus/fit/curve_fit.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace tactus::host
{

namespace
{
using Columns = RecordedColumns;

Result<Columns> columnsOf (FitKind kind, const Table& table, const std::string& file, const FitSettings& settings)
{
    const auto& choice = settings.columns;
    Columns columns;
    for (const auto& wanted : infoOf (kind).columns)
    {
        if (wanted.role == "t" && settings.rate > 0.0)
        {
            if (const auto found = findColumn (table, wanted, choice))
                return Message::error ("fit/given_twice", file,
                                       "--rate gives the times of the rows, but the recording has a column for them, " + quote (table.columns[*found]),
                                       "leave out --rate, or leave out the column: --column t=");
            auto& times = columns[wanted.role];
            for (std::size_t r = 0; r < table.rows(); ++r)
                times.push_back (static_cast<double> (r) / settings.rate);
            continue;
        }
        auto values = columnOf (table, file, wanted, choice);
        if (! values) return values.error();
        columns[wanted.role] = std::move (*values);
    }
    return columns;
}

double orElse (double given, double value) { return given > 0.0 ? given : value; }

/// "`tactus fit friction` from strokes.csv: residual 5.3 %, good"
std::string sourceOf (FitKind kind, const std::string& file, const FitReport& report)
{
    return "`tactus fit " + infoOf (kind).id + "` from " + std::filesystem::path (file).filename().string() + ": residual "
           + percentText (report.residual / report.size) + " of the recording, " + verdictOf (report);
}

/// An error if an option gives what the recording contains. One of the two would be ignored.
Result<> checkGivenOnce (const Columns& c, FitKind kind, const FitSettings& s)
{
    const auto refuse = [&] (const std::string& role, double value) -> Result<> {
        if (! (value > 0.0) || c.at (role).empty()) return {};
        return Message::error ("fit/given_twice", {}, "--" + role + " gives the " + role + ", but the recording has a column for it",
                               "leave out --" + role + ", or leave out the column: --column " + role + "=");
    };
    if (kind == FitKind::friction) return refuse ("load", s.load);
    if (kind != FitKind::texture) return {};
    if (auto speed = refuse ("speed", s.speed); ! speed) return speed;
    return refuse ("force", s.force);
}

Result<FittedGraph> friction (const Columns& c, const std::string& file, const FitSettings& s, FitCourse* course)
{
    auto fit = fitFriction ({ c.at ("position"), c.at ("force"), c.at ("load"), orElse (s.load, 1.0) }, course);
    if (! fit) return fit.error();
    const auto given = s.load > 0.0 ? "as given" : "guess: the load was not recorded";
    const auto load = c.at ("load").empty() ? given : "the mean of the recorded load";
    FittedGraph made { .kind = FitKind::friction, .preset = frictionPreset (*fit, load, sourceOf (FitKind::friction, file, fit->report)), .nodes = { "drag" } };
    constexpr const char* functions[] { "stick", "dupont", "ramp", "dahl", "curve" };
    made.details.push_back (std::string ("adhesion  ") + functions[static_cast<std::size_t> (fit->adhesion)] + ", d_max at a load of "
                            + roundedText (fit->reference_load, 3) + " N");
    made.report = std::move (fit->report);
    return made;
}

Result<FittedGraph> modes (const Columns& c, const std::string& file, const FitSettings& s, FitCourse* course)
{
    RecordedRing ring { .time = c.at ("t"), .value = c.at ("value"), .from = s.from, .to = s.to, .blow = s.blow };
    if (s.most > 0) ring.most_modes = s.most;
    auto fit = fitModes (ring, course);
    if (! fit) return fit.error();

    // A recording in m/s2 of a blow of known speed gives newtons; otherwise, only the ratios of the amplitudes are known.
    double largest = 0.0;
    for (const auto& tone : fit->tones)
        largest = std::max (largest, tone.amplitude);
    const bool is_known = s.speed > 0.0 && s.mass > 0.0;
    const double scale = is_known ? s.mass / s.speed : 2.0 / largest;
    const auto how = is_known ? "recorded, in m/s2, times " + roundedText (1e3 * s.mass, 3) + " g, for a blow of " + roundedText (s.speed, 3) + " m/s"
                              : std::string ("only their ratios are fitted; the largest is a guess");
    FittedGraph made { .kind = FitKind::modes, .preset = modesPreset (*fit, scale, how, sourceOf (FitKind::modes, file, fit->report)), .nodes = { "ring" } };
    made.report = std::move (fit->report);
    return made;
}

Result<FittedGraph> texture (const Columns& c, const std::string& file, const FitSettings& s, FitCourse* course)
{
    RecordedTexture recorded { .time = c.at ("t"), .acceleration = c.at ("acceleration"), .speed = c.at ("speed"), .force = c.at ("force") };
    recorded.assumed_speed = orElse (s.speed, 0.1);
    recorded.assumed_force = orElse (s.force, 1.0);
    if (s.most > 0) recorded.most_coefficients = s.most;
    auto fit = fitTexture (recorded, course);
    if (! fit) return fit.error();
    std::string from = s.mass > 0.0 ? "the given mass" : "a guess of the mass of the tip";
    if (recorded.speed.empty()) from += "; speed: " + roundedText (recorded.assumed_speed, 3) + (s.speed > 0.0 ? " m/s, as given" : " m/s, a guess");
    if (recorded.force.empty()) from += "; normal force: " + roundedText (recorded.assumed_force, 3) + (s.force > 0.0 ? " N, as given" : " N, a guess");
    FittedGraph made { .kind = FitKind::texture,
                       .preset = texturePreset (*fit, orElse (s.mass, 0.01), from, sourceOf (FitKind::texture, file, fit->report)),
                       .nodes = { "grain" } };
    for (std::size_t i = 0; i < fit->models.size(); ++i)
        made.details.push_back ("model " + std::to_string (i + 1) + "   " + roundedText (fit->models[i].speed, 3) + " m/s, "
                                + roundedText (fit->models[i].force, 3) + " N, " + std::to_string (fit->models[i].rows) + " rows at "
                                + roundedText (fit->rate, 3) + " Hz");
    made.report = std::move (fit->report);
    if (fit->rate > made.preset.rate_hz)
        made.report.notes.push_back ("the preset runs at " + roundedText (1e-3 * made.preset.rate_hz, 3) + " kHz, so it lacks frequencies above "
                                     + roundedText (0.5e-3 * made.preset.rate_hz, 3) + " kHz");
    return made;
}

Result<FittedGraph> grating (const Columns& c, const std::string& file, const FitSettings& s, FitCourse* course)
{
    RecordedProfile profile { c.at ("position"), c.at ("height") };
    if (s.most > 0) profile.most_harmonics = s.most;
    auto fit = fitGrating (profile, course);
    if (! fit) return fit.error();
    FittedGraph made { .kind = FitKind::grating, .preset = gratingPreset (*fit, orElse (s.load, 1.0), sourceOf (FitKind::grating, file, fit->report)) };
    for (const auto& h : fit->harmonics)
        made.nodes.push_back ("ridges" + std::to_string (h.number));
    made.report = std::move (fit->report);
    return made;
}

Result<FittedGraph> blade (const Columns& c, const std::string& file, const FitSettings& s, FitCourse* course)
{
    auto fit = fitBlade ({ c.at ("depth"), c.at ("force"), orElse (s.width, 0.02) }, course);
    if (! fit) return fit.error();
    FittedGraph made { .kind = FitKind::blade, .preset = bladePreset (*fit, sourceOf (FitKind::blade, file, fit->report)), .nodes = { "blade" } };
    made.snippets.push_back ("law       " + toJson (fit->law).dump() + (fit->cracked_law ? ", with a crack " + toJson (fit->cracked_law).dump() : ""));
    made.details.push_back ("width     " + roundedText (1e3 * fit->width, 3) + " mm"
                            + (s.width > 0.0 ? "" : ", a guess: toughness is the force of cutting divided by it"));
    made.report = std::move (fit->report);
    return made;
}

Result<FittedGraph> curve (const Columns& c, const std::string& file, const FitSettings& s, FitCourse* course)
{
    auto fit = fitCurve ({ .depth = c.at ("depth"), .force = c.at ("force") }, s.points, course);
    if (! fit) return fit.error();
    const UniformBody body { .along = fit->law, .mu = s.mu, .ratio = s.ratio };
    std::string about = "A uniform body with the curve of a recorded indentation.";
    if (! fit->out.empty()) about += " The recording lost " + energyText (fit->area) + " per push; this body loses energy only by friction.";
    FittedGraph made { .kind = FitKind::curve, .preset = surfacePreset (body, {}, about, sourceOf (FitKind::curve, file, fit->report)), .nodes = { "body" } };
    if (fit->out.empty())
        made.details.push_back ("hysteresis  unknown: the way out was not recorded");
    else
        made.details.push_back ("hysteresis  " + energyText (fit->area, 6) + ", " + percentText (fit->area / fit->work)
                                + " of the work on the way in; the curve is the mean of both ways and loses nothing");
    if (fit->clicks())
        made.warnings.push_back (Message::warning (
            "fit/falls", file, "the recorded force falls by up to " + roundedText (fit->drop, 3) + " N as the depth grows; the curve is flat there",
            "for a key that clicks, use tactus fit switch; for a sample that bursts, use tactus fit blade"));
    const auto curves = curvesOf (body);
    made.snippets.push_back ("for deform.plane    \"law\": " + toJson (fit->law).dump());
    made.snippets.push_back ("for deform.surface  \"curves\": " + curves.at ("curves").dump() + ", \"mu\": " + curves.at ("mu").dump());
    made.report = std::move (fit->report);
    return made;
}

Result<FittedGraph> keySwitch (const Columns& c, const std::string& file, const FitSettings& s, FitCourse* course)
{
    auto fit = fitSwitch ({ .depth = c.at ("depth"), .force = c.at ("force") }, s.tolerance, s.backlash, course);
    if (! fit) return fit.error();
    FittedGraph made { .kind = FitKind::key_switch,
                       .preset = switchPreset (fit->loop, s.stiffness, sourceOf (FitKind::key_switch, file, fit->report)),
                       .nodes = { "key", "bound", "rub" } };
    made.details.push_back ("loop         " + std::to_string (fit->loop.travel.size()) + " points; the graph loses "
                            + energyText (lostEnergy (fit->loop), 4) + " per stroke");
    made.report = std::move (fit->report);
    return made;
}

Result<FittedGraph> shock (const Columns& c, const std::string& file, const FitSettings& s, FitCourse* course)
{
    auto fit = fitShock ({ .depth = c.at ("depth"), .force = c.at ("force"), .time = c.at ("t") }, s.mass, course);
    if (! fit) return fit.error();
    constexpr double much = 0.1, of_energy = 0.01, most_uncertain = 0.5;   // the second one is for an impact that loses almost nothing
    const double energy = 0.5 * fit->mass * fit->speed * fit->speed;
    const double of_speed = fit->speed_error > 0.0 ? 4.0 * fit->speed_error / std::abs (fit->speed) : 0.0;   // two deviations, of a square
    const bool is_free = std::abs (fit->played_area - fit->recorded_area) <= much * fit->recorded_area + of_energy * energy + of_speed * fit->played_area;
    const auto not_free = Message::warning ("fit/not_free", file, "a free impact of this mass at this speed does not lose the same energy as the recorded one",
                                            "the tool was probably pushed during the recording, or --mass is wrong: correct --mass, or record a tool that "
                                            "moves freely; the fitted force over the recorded depth still has the recorded area");
    if (of_speed > most_uncertain)
    {
        fit->report.is_good = false;
        fit->report.lacking.push_back ("noise of the depth leaves the speed at the touch uncertain by " + percentText (fit->speed_error / std::abs (fit->speed))
                                       + ", so it is not known whether the tool moved freely: smooth the depth, or use a finer sensor");
    }
    else if (! is_free)
    {
        fit->report.is_good = false;
        fit->report.lacking.push_back (not_free.text);
        fit->report.lacking.push_back (not_free.remedy);
    }
    FittedGraph made { .kind = FitKind::shock, .preset = shockPreset (*fit, sourceOf (FitKind::shock, file, fit->report)), .nodes = { "blow" } };
    made.snippets = { "stiffness  " + toJson (fit->stiffness).dump(), "damping    " + toJson (fit->damping).dump() };
    made.details = { "mass       " + roundedText (fit->mass, 3) + " kg, at " + roundedText (fit->speed, 3) + " m/s",
                     "area       " + energyText (fit->recorded_area, 6) + " recorded, " + energyText (fit->fitted_area, 6) + " fitted, "
                         + energyText (fit->played_area, 6) + " when the shock is played at this speed" };
    if (! is_free && of_speed <= most_uncertain) made.warnings.push_back (not_free);
    made.report = std::move (fit->report);
    return made;
}

Result<FittedGraph> fitted (FitKind kind, const Columns& c, const std::string& file, const FitSettings& s, FitCourse* course)
{
    switch (kind)
    {
    case FitKind::friction:
        return friction (c, file, s, course);
    case FitKind::modes:
        return modes (c, file, s, course);
    case FitKind::texture:
        return texture (c, file, s, course);
    case FitKind::grating:
        return grating (c, file, s, course);
    case FitKind::blade:
        return blade (c, file, s, course);
    case FitKind::curve:
        return curve (c, file, s, course);
    case FitKind::key_switch:
        return keySwitch (c, file, s, course);
    case FitKind::shock:
        break;
    }
    return shock (c, file, s, course);
}

/// The travel of a key is counted from the first row, wherever that is.
Touch touchFor (FitKind kind, const FitSettings& settings) { return { .is_looked_for = kind != FitKind::key_switch, .given = settings.touch }; }
}   // namespace

std::string verdictOf (const FitReport& report) { return report.is_good ? "good" : "poor"; }

Result<FittedGraph> fitRecording (FitKind kind, const Table& table, const std::string& file, const FitSettings& settings, FitCourse* course)
{
    auto columns = columnsOf (kind, table, file, settings);
    if (! columns) return columns.error();
    const auto pressing = orient (infoOf (kind).columns, *columns, settings.columns, touchFor (kind, settings));
    if (auto once = checkGivenOnce (*columns, kind, settings); ! once) return Message::error (once.error().id, file, once.error().text, once.error().remedy);
    auto made = fitted (kind, *columns, file, settings, course);
    if (! made) return Message::error (made.error().id, file, made.error().text, made.error().remedy);
    made->preset.name = std::filesystem::path (file).stem().string();
    const auto along = findColumn (table, infoOf (kind).columns.front(), settings.columns);
    if (along && table.columns[*along] == integrated_position)
        made->report.notes.emplace_back ("the position was not recorded: it is the integral of the velocity over the time");
    made->report.notes.insert (made->report.notes.end(), pressing.notes.begin(), pressing.notes.end());
    return made;
}

RecordedPicture pictureOf (FitKind kind, const Table& table, const FitSettings& settings)
{
    const auto& columns = infoOf (kind).columns;
    auto recorded = columnsOf (kind, table, {}, settings);
    if (! recorded) return {};
    auto turned = orient (columns, *recorded, settings.columns, touchFor (kind, settings)).turned;
    const auto nameOf = [] (const FitColumn& column) { return column.role == "t" ? std::string ("time") : column.role; };
    FitCurve curve { "recorded", (*recorded)[columns[0].role], (*recorded)[columns[1].role], true };
    return { { nameOf (columns[0]), columns[0].unit, nameOf (columns[1]), columns[1].unit, { std::move (curve) } }, std::move (turned) };
}

Result<> checkFitted (const FittedGraph& made, const std::string& recording, Assets& assets)
{
    const auto compiled = compile (made.preset, catalogue(), { .assets = &assets });
    const auto error = std::ranges::find (compiled.messages, Message::Severity::error, &Message::severity);
    if (error == compiled.messages.end()) return {};
    return Message::error ("fit/preset", recording, "the fitted values cannot be played: " + error->text,
                           "the recording does not look like one of this kind: check the columns and their units");
}

}   // namespace tactus::host
