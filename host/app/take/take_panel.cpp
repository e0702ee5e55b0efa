// SPDX-License-Identifier: GPL-3.0-or-later
#include "take_panel.hpp"

#include <host/app/location/scope_port.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/files/stretch_files.hpp>
#include <host/tools/stems/stem_clips.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/log/run_test.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr auto how_to = NEEDS_TRANS ("Press Record, move, and press Stop. Then mark a stretch of the curve, and make a clip, a gesture or a test from it.");

/// A time that was typed, in s; the old one if it is not a number.
double secondsIn (const juce::String& text, double before)
{
    const auto number = text.trim().upToFirstOccurrenceOf ("s", false, true).trim();
    return number.containsOnly ("0123456789.,") ? wholeNumber (number.replaceCharacter (',', '.').toStdString()).value_or (before) : before;
}

/// The user has saved the take, so nothing needs to ask about it any more. Neither must the next start after a crash: the file tells it.
void markAsSaved (Take::Recording& take)
{
    take.is_saved = true;
    if (! take.stays && ! take.file.empty()) std::ofstream (take.file.parent_path() / "used");
}

/// The gain with which signal.clip plays the recorded values again: clipOfStretch() divides by it.
double gainOf (const Stretch& stretch)
{
    double most = 1.0;
    for (const double v : stretch.values)
        if (std::isfinite (v)) most = std::max (most, std::abs (v));
    return most;
}
}   // namespace

TakePanel::TakePanel (Document& d, Playback& p, const Catalogue& c) : document (d), catalogue (c), playback (p), recording (p)
{
    setTitle (TRANS ("Take"));
    record.setColour ([] (const Theme& t) { return t.stop; });
    record.setDot();
    record.onClick = [this] { toggleRecording(); };
    clip.onClick = [this] { makeClip(); };
    gesture.onClick = [this] { makeGesture(); };
    test.onClick = [this] { makeTest(); };
    ports.setTitle (TRANS ("Port to show"));
    ports.setTooltip (TRANS ("The port that the curve shows, and that a clip plays"));
    ports.onChange = [this] {
        if (const int i = ports.getSelectedItemIndex(); i >= 0 && i < static_cast<int> (names.size())) showPort (names[static_cast<std::size_t> (i)]);
    };
    from.setTitle (TRANS ("Start of the stretch in s"));
    until.setTitle (TRANS ("End of the stretch in s"));
    from.onApply = until.onApply = [this] (const juce::String&) { applyFields(); };
    curve.onMark = [this] { showMark(); };
    curve.onHint = [this] (const juce::String& text) {
        if (onHint) onHint (text);
    };
    curve.setText (juce::translate (how_to));
    recording.onRecorded = [this] (const auto& complete, Take::End why) { recorded (complete, why); };
    list.setTitle (TRANS ("Takes"));
    list.onClick = [this] { openMenu(); };
    for (auto* child : std::initializer_list<juce::Component*> { &curve, &record, &list, &ports, &from, &until, &clip, &gesture, &test })
        addAndMakeVisible (child);
    document.add (*this);
    listPorts (document.graph());
    refresh();
}

TakePanel::~TakePanel() { document.remove (*this); }

void TakePanel::documentChanged()
{
    const bool is_recording = recording.state() == Take::State::recording;
    if (! is_recording && std::exchange (opened, document.identity()) != document.identity()) restore ({});   // the takes of the graph before are in the list
    is_stale = recording.state() == Take::State::empty;
    visibilityChanged();
}

/// A large graph has many ports, so they are listed only while somebody can see them.
void TakePanel::visibilityChanged()
{
    if (is_stale && isVisible()) listPorts (document.graph());
}

/// The ports of a graph. While there is a recording, they stay those of the recorded graph.
void TakePanel::listPorts (const graph::Graph& graph)
{
    is_stale = false;
    names.clear();
    const auto all_ports = scopePorts (graph, catalogue);
    for (const auto& p : all_ports)
        names.push_back (p.name);
    if (std::ranges::count (names, shown_port) == 0)
    {
        shown_port = motorPort (all_ports);
        if (shown_port.empty() && ! names.empty()) shown_port = names.front();
    }
    fillPorts();
}

void TakePanel::fillPorts()
{
    ports.clear (juce::dontSendNotification);
    auto& menu = *ports.getRootMenu();   // ComboBox::addItem compares each item with all others
    for (std::size_t i = 0; i < names.size(); ++i)
        menu.addItem (static_cast<int> (i) + 1, juce::String (printableName (names[i])));
    const auto at = std::ranges::find (names, shown_port);
    if (at != names.end()) ports.setSelectedItemIndex (static_cast<int> (at - names.begin()), juce::dontSendNotification);
}

void TakePanel::toggleRecording()
{
    if (recording.state() == Take::State::recording) return recording.stop();
    before = shown();
    opened = document.identity();
    recorded_graph = document.graph().name;
    listPorts (document.graph());
    curve.show ({});
    recording.record();
    refresh();
}

/// Adds what was recorded so far to the list.
void TakePanel::endRecording()
{
    while (recording.state() == Take::State::recording)
    {
        recording.stop();
        recording.poll();
    }
}

void TakePanel::restore (const Shown& to)
{
    endRecording();
    recording.restore (to.recording);
    names = to.names;
    shown_port = to.port;
    recorded_graph = to.graph;
    if (! to.recording) listPorts (document.graph());
    fillPorts();
    curve.show ({});
    if (to.recording) readPort();
    showMark();
    refresh();
}

/// The curve goes on showing the same port, if the take has it.
void TakePanel::showTake (Shown take)
{
    if (std::ranges::count (take.names, shown_port) > 0) take.port = shown_port;
    restore (take);
}

std::function<void()> TakePanel::restored (const Shown& to)
{
    return [safe = SafePointer (this), to] {
        if (safe != nullptr) safe->restore (to);
    };
}

void TakePanel::recorded (const std::shared_ptr<Take::Recording>& complete, Take::End why)
{
    const bool goes_on = why == Take::End::run_began_again;
    const auto length = juce::String (complete ? complete->length_s : 0.0, 1);
    const bool is_kept = complete && (! goes_on || complete->length_s > 0.0);
    const bool is_of_other = std::exchange (opened, document.identity()) != document.identity();
    if (is_of_other) before = {};
    if (is_kept) keep ({ complete, names, shown_port, recorded_graph }, goes_on);
    if (goes_on)
    {
        recorded_graph = document.graph().name;
        curve.show ({});
    }
    else
        complete && ! is_of_other ? readPort() : restore (std::exchange (before, {}));
    juce::String text;
    if (goes_on) text = TRANS ("The run begins again, and so does the take.");
    if (goes_on && is_kept) text << " " << filled (TRANS ("The %1 s before are in the list of takes."), length);
    if (why == Take::End::with_run && complete) text = filled (TRANS ("The take has ended with the run. It holds %1 s."), length);
    if (why == Take::End::with_run && ! complete) text = TRANS ("There is no take: the run ended before anything was recorded.");
    if (why == Take::End::asked && document.isStepping()) text = TRANS ("The take has ended. It is in the list of takes.");
    if (onNotice && text.isNotEmpty()) onNotice (text);
}

/// Undo shows again what was shown before.
void TakePanel::keep (const Shown& complete, bool goes_on)
{
    all.push_back (complete);
    resized();   // a narrow panel shows how many there are
    const auto earlier = std::exchange (before, goes_on ? complete : Shown {});
    document.addWindowStep (NEEDS_TRANS ("record a take"), restored (earlier), restored (complete));
}

/// The name of its graph is part of it if another graph is open.
juce::String TakePanel::nameOf (std::size_t take) const
{
    const auto& r = *all[take].recording;
    auto name = filled (r.is_saved ? TRANS ("Take %1: %2 s") : TRANS ("Take %1: %2 s, not saved"), take + 1, juce::String (r.length_s, 1));
    if (r.stays) name = fromUtf8 (printableName (r.file.filename().string()));
    const auto& graph = all[take].graph;
    return graph.empty() || graph == document.graph().name ? name : filled ("%1 (%2)", name, printableName (graph));
}

void TakePanel::openMenu()
{
    juce::PopupMenu menu;
    const bool is_free = recording.state() != Take::State::recording;
    const auto add = [&menu, safe = SafePointer (this)] (const juce::String& text, bool is_on, bool is_ticked, std::function<void (TakePanel&)> act) {
        menu.addItem (text, is_on, is_ticked, [safe, act = std::move (act)] {
            if (safe != nullptr) act (*safe);
        });
    };
    for (std::size_t i = 0; i < all.size(); ++i)
        add (nameOf (i), is_free, all[i].recording == recording.recorded(), [take = all[i]] (TakePanel& p) { p.showTake (take); });
    menu.addSeparator();
    const bool has_take = is_free && recording.recorded() != nullptr;
    add (TRANS ("Save take..."), has_take, false, [] (TakePanel& p) { p.saveAs (p.recording.recorded(), {}); });
    add (TRANS ("Open take..."), is_free && onOpen, false, [] (TakePanel& p) {
        p.onOpen ([&p] (const std::filesystem::path& log) { p.open (log, false); });
    });
    const bool is_pinned = curve.hasPinned();
    const bool can_pin = has_take && recording.state() == Take::State::ready && curve.length() > 0.0;
    add (is_pinned ? TRANS ("Stop comparing") : TRANS ("Compare others with this take"), is_pinned || can_pin, false,
         [] (TakePanel& panel) { panel.togglePinned(); });
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (list));
}

/// A take is compared with others by its curve, which stays behind theirs.
void TakePanel::togglePinned()
{
    if (curve.hasPinned()) return curve.unpin();
    const auto take = static_cast<std::size_t> (std::ranges::find (all, recording.recorded(), &Shown::recording) - all.begin());
    if (take < all.size()) curve.pin (filled ("%1, %2", nameOf (take).upToFirstOccurrenceOf (":", false, false), printableName (shown_port)));
}

bool TakePanel::open (const std::filesystem::path& log, bool copies)
{
    endRecording();
    const auto graph = recording.open (log, copies);
    if (! graph)
    {
        if (onSaid)
            onSaid (filled (TRANS ("Cannot open %1"), printableName (log.filename().string())),
                    juce::String (graph.error().where + ": " + messageText (graph.error())) + ".", {});
        return false;
    }
    listPorts (*graph);
    recorded_graph = graph->name;
    const auto take = shown();
    all.push_back (take);
    resized();
    restore (take);
    return true;
}

bool TakePanel::leave()
{
    endRecording();
    const auto rest = unsaved();
    for (const auto& take : rest)
        take->stays = ! recording.home.empty();
    return ! rest.empty() && ! recording.home.empty();
}

/// The latest part of what is being recorded, as far as it is kept.
void TakePanel::showLatest()
{
    latest.want (recording.state() == Take::State::recording ? std::vector { shown_port } : std::vector<std::string> {});
    if (recording.state() != Take::State::recording || ! playback.run().isLogged()) return;   // not yet: the traces are of the run before
    const auto traces = latest.of (shown_port);
    if (traces.empty() || traces.front()->begin() == traces.front()->end()) return;
    const auto& first = *traces.front();
    Stretch now { .rate_hz = first.rate(), .from = first.begin(), .until = first.end(), .quantity = first.quantity(), .unit = first.unit() };
    for (const auto& t : traces)
    {
        now.names.push_back (t->name());
        now.from = std::max (now.from, t->begin());
        now.until = std::min (now.until, t->end());
    }
    if (now.until <= now.from) return;
    now.values.reserve (now.ticks() * traces.size());
    for (auto tick = now.from; tick < now.until; ++tick)
        for (const auto& t : traces)
            now.values.push_back (t->at (tick));
    curve.show (std::move (now));
}

void TakePanel::showPort (const std::string& port)
{
    if (port == shown_port || port.empty()) return;
    shown_port = port;
    readPort();
}

void TakePanel::readPort()
{
    if (shown_port.empty()) return;
    recording.read ({ .records = { shown_port } }, [this] (Result<Stretch> read) {
        if (! read) return refuse (read.error());
        curve.show (std::move (*read));
        showMark();
    });
}

StretchReader::Options TakePanel::marked() const { return { .from_s = curve.from(), .until_s = curve.until() }; }

void TakePanel::refuse (const Message& m)
{
    if (onSaid) onSaid (TRANS ("This did not work"), juce::String (messageText (m)) + ".", {});
}

void TakePanel::makeClip()
{
    auto options = marked();
    options.records = { shown_port };
    recording.read (std::move (options), [this] (Result<Stretch> read) {
        if (! read) return refuse (read.error());
        Messages notes;
        const auto played = playableStretch (std::move (*read), notes);
        const auto made = clipOfStretch (played, notes);
        const auto gain = played.unit == "N" ? std::optional (gainOf (played)) : std::nullopt;
        if (! onChoose || ! onClip) return;
        onChoose ("take.wav", [this, made, notes, gain, of = recording.recorded()] (const std::filesystem::path& to) {
            if (onClip (made, notes, gain, to)) of->is_used = true;
        });
    });
}

void TakePanel::makeGesture()
{
    auto options = marked();
    options.role = recording.role();
    recording.read (std::move (options), [this] (Result<Stretch> read) {
        if (! read) return refuse (read.error());
        if (! onChoose) return;
        onChoose ("gesture.csv", [this, stretch = std::make_shared<Stretch> (std::move (*read)), of = recording.recorded()] (const std::filesystem::path& to) {
            if (const auto saved = saveMovement (*stretch, to); ! saved) return refuse (saved.error());
            of->is_used = true;
            if (onSaid)
                onSaid (filled (TRANS ("Saved %1"), printableName (to.filename().string())),
                        TRANS ("To feel it again, drop the file on the panel of the hand at the lower left. The tool then goes where it was recorded, whatever "
                               "the force."),
                        [this, to] { useGesture (to); });
        });
    });
}

/// The hand that moved the tool before comes back by undo, which starts nothing that a person has stopped.
void TakePanel::useGesture (const std::filesystem::path& file)
{
    const auto change = [safe = SafePointer (this)] (const LiveRun::Hand& hand) {
        return [safe, hand] {
            if (safe != nullptr) safe->playback.changeHand (hand);
        };
    };
    const LiveRun::Hand earlier = playback.run().hand(), now { LiveRun::Hand::Kind::path, file.string() };
    playback.moveBy (now);
    document.addWindowStep (filled (TRANS ("move the hand by %1"), printableName (file.filename().string())).toStdString(), change (earlier), change (now));
}

void TakePanel::makeTest()
{
    recording.read (marked(), [this] (Result<Stretch> read) {
        if (! read) return refuse (read.error());
        if (! onChoose) return;
        onChoose ("test.jsonl", [this, stretch = std::make_shared<Stretch> (std::move (*read)), of = recording.recorded()] (const std::filesystem::path& to) {
            if (const auto saved = writeRunTest (of->file.string(), to, *stretch, {}, recording.program); ! saved) return refuse (saved.error());
            of->is_used = true;
            const auto name = juce::String (printableName (to.filename().string()));
            auto text = filled (TRANS ("`tactus test %1` plays the run again and compares %2 ticks, bit for bit."), name, stretch->ticks());
            if (stretch->from > 0)
                text << " "
                     << filled (TRANS ("The test begins at the start of the run, because the state of the nodes is known there; it compares from %1 s on."),
                                juce::String (curve.from(), 3));
            if (onSaid) onSaid (filled (TRANS ("Saved %1"), name), text, [this, to] { runTest (to); });
        });
    });
}

std::vector<std::shared_ptr<Take::Recording>> TakePanel::unsaved() const
{
    std::vector<std::shared_ptr<Take::Recording>> found;
    for (const auto& take : all)
        if (! take.recording->is_saved && ! take.recording->is_used) found.push_back (take.recording);
    if (recording.state() == Take::State::recording) found.push_back (recording.recorded());
    return found;
}

void TakePanel::save (const std::function<void()>& then)
{
    endRecording();
    const auto rest = unsaved();
    if (rest.empty()) return then();
    saveAs (rest.front(), [this, then] { save (then); });
}

void TakePanel::saveAs (const std::shared_ptr<Take::Recording>& take, const std::function<void()>& then)
{
    if (! onChoose) return;
    const auto number = std::ranges::find (all, take, &Shown::recording) - all.begin() + 1;
    const auto name = number == 1 ? std::string ("take.jsonl") : "take_" + std::to_string (number) + ".jsonl";
    onChoose (name, [this, then, of = take] (const std::filesystem::path& to) {
        if (const auto saved = copyRunLog (of->file.string(), to); ! saved) return refuse (saved.error());
        markAsSaved (*of);
        if (then) then();
    });
}

void TakePanel::runTest (const std::filesystem::path& file)
{
    FileAssets assets;
    const auto played = playRunTest (file.string(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes }, .program = recording.program });
    if (! played) return refuse (played.error());
    const auto name = juce::String (printableName (file.filename().string()));
    if (onSaid)
        onSaid (filled (played->isSame() ? TRANS ("%1 passes") : TRANS ("%1 fails"), name),
                played->isSame() ? filled (TRANS ("All bits of %1 ticks are the same."), played->ticks)
                                 : filled (TRANS ("Some bits differ. `tactus test %1` says which."), name),
                {});
}

void TakePanel::applyFields()
{
    curve.mark (secondsIn (from.getText(), curve.from()), secondsIn (until.getText(), curve.until()));
}

void TakePanel::showMark()
{
    from.show (juce::String (curve.from(), 3));
    until.show (juce::String (curve.until(), 3));
    repaint();
}

std::array<juce::String, 2> TakePanel::statusTexts() const
{
    switch (recording.state())
    {
    case Take::State::recording:
        return { filled (TRANS ("Recording: %1 s of at most %2 s"), juce::String (recording.seconds(), 1), juce::roundToInt (Take::longest_s)),
                 juce::String (recording.seconds(), 1) + " s" };
    case Take::State::reading:
        return { TRANS ("Playing the recording again ..."), "..." };
    case Take::State::ready:
        return { filled (TRANS ("%1 s marked"), juce::String (curve.until() - curve.from(), 3)), juce::String (curve.until() - curve.from(), 3) + " s" };
    default:
        return {};
    }
}

void TakePanel::refresh()
{
    const auto before = recording.state();
    recording.poll();
    const auto now = recording.state();
    const bool records = now == Take::State::recording, is_ready = now == Take::State::ready && curve.until() > curve.from();
    record.setToggleState (records, juce::dontSendNotification);
    record.setButtonText (records ? TRANS ("Stop") : TRANS ("Record"));
    record.setTooltip (records ? TRANS ("End the recording, which becomes the take; the run goes on as it is")
                               : TRANS ("Start the run again and record it, from its first tick on"));
    for (auto* b : { &clip, &test })
        b->setEnabled (is_ready);
    gesture.setEnabled (is_ready && ! recording.role().empty());
    for (auto* f : { &from, &until })
        f->setEnabled (! records && curve.length() > 0.0);
    showLatest();
    if (records)   // the curve shows only the last seconds
    {
        from.show (juce::String (0.0, 3));
        until.show (juce::String (recording.seconds(), 3));
    }
    const bool has_curve = curve.length() > 0.0;
    const auto waiting = ! records                   ? juce::translate (how_to)
                         : playback.run().isWanted() ? TRANS ("Recording. Move, and press Stop when you are done.")
                                                     : TRANS ("Recording begins with START.");
    if (! has_curve) curve.setText (now == Take::State::reading ? TRANS ("Playing the recording again ...") : waiting);
    if (records || now != before) repaint();
}

void TakePanel::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    g.setColour (look.theme().dim);
    g.setFont (look.font (12.0f));
    const auto place = juce::Rectangle<int>::leftTopRightBottom (list.getRight() + 12, record.getY(), ports.getX() - 8, record.getBottom());
    const auto fits = [&] (const juce::String& text) { return g.getCurrentFont().getStringWidthFloat (text) <= static_cast<float> (place.getWidth()); };
    const auto texts = statusTexts();
    if (const auto text = std::ranges::find_if (texts, fits); text != texts.end()) g.drawText (*text, place, juce::Justification::centredLeft, false);
    const auto label = [&] (const juce::String& text, const juce::Component& field) {
        g.drawText (text, field.getX() - 44, field.getY(), 40, field.getHeight(), juce::Justification::centredRight, false);
    };
    label (TRANS ("from"), from);
    label (TRANS ("until"), until);
    g.drawText ("s", until.getRight() + 4, until.getY(), 12, until.getHeight(), juce::Justification::centredLeft, false);
}

void TakePanel::nameButtons (bool briefly)
{
    clip.setButtonText (briefly ? TRANS ("Clip...") : TRANS ("Make a clip..."));
    gesture.setButtonText (briefly ? TRANS ("Gesture...") : TRANS ("Make a gesture..."));
    test.setButtonText (briefly ? TRANS ("Test...") : TRANS ("Make a test..."));
}

void TakePanel::resized()
{
    auto rest = getLocalBounds().reduced (12, 6);
    auto head = rest.removeFromTop (26);
    record.setBounds (head.removeFromLeft (84));
    list.setButtonText (head.getWidth() < 300 ? juce::String (all.size()) : TRANS ("Takes"));
    list.setBounds (head.removeFromLeft (6 + list.bestWidth()).withTrimmedLeft (6));
    constexpr int least_port = 132;
    ports.setBounds (head.removeFromRight (std::min (220, std::max (head.getWidth() / 2, std::min (least_port, head.getWidth() - 8)))));
    auto foot = rest.removeFromBottom (28).withTrimmedTop (2);
    foot.removeFromLeft (36);
    from.setBounds (foot.removeFromLeft (60));
    foot.removeFromLeft (44);
    until.setBounds (foot.removeFromLeft (60));
    foot.removeFromLeft (20);   // the unit
    constexpr int gap = 6;
    const auto wanted = [this] { return test.bestWidth() + gesture.bestWidth() + clip.bestWidth(); };
    nameButtons (false);
    if (wanted() + 2 * gap > foot.getWidth()) foot = rest.removeFromBottom (28).withTrimmedTop (2);   // in a narrow panel, a line of their own
    const int room = std::max (0, foot.getWidth() - 2 * gap);
    if (wanted() > room) nameButtons (true);
    for (const int all = wanted(); auto* b : { &test, &gesture, &clip })
    {
        b->setBounds (foot.removeFromRight (b->bestWidth() * std::min (all, room) / std::max (1, all)));
        foot.removeFromRight (gap);
    }
    curve.setBounds (rest.withTrimmedTop (6).withTrimmedBottom (4));
}

}   // namespace tactus::host
