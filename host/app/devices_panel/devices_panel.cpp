// SPDX-License-Identifier: GPL-3.0-or-later
#include "devices_panel.hpp"
#include "sound_words.hpp"

#include <host/app/inspector/fields.hpp>
#include <host/audio/audio_rig.hpp>
#include <host/devices/gestures.hpp>
#include <host/devices/make_device.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int card_width = 280, widest_card = 480, refreshes_apart = 6;   // five times a second

const char *const first_that_can = "the first device that can", *const sound_card = "sound card";

/// What may be set of a binding: where it stands, how it is called, and what it does.
struct Part
{
    const char *pointer, *label, *about;
};
constexpr Part parts[] {
    { "/workspace/scale", "scale", "How large the device's workspace is in the graph's: 2 makes the hand go half as far, and walls feel twice as stiff" },
    { "/workspace/offset", "offset", "Where the device's origin is in the graph: [0, 0, \"1 cm\"]" },
    { "/guard/max_force", "force at most", "As in 3 N. What the device's profile allows cannot be raised" },
    { "/guard/max_speed", "speed at most", "As in 1 m/s, of the tool in the hand: faster, and the guard stops it for good" },
    { "/guard/ramp", "ramp", "As in 0.5 s, from no force to all of it" },
};

constexpr Part parts_of_sound[] {
    { "/outputs", "outputs", "Channels of the card for the signal outputs 1, 2 ... of the role, and how much 1 is there: 3@4 N, 4@4 N. Left out: those that the graph asks for" },
    { "/inputs", "inputs", "The same for the signal inputs: 1@20 m/s2" },
    { "/guard/max_signal", "signal at most", "Of each output, in its own unit" },
    { "/guard/ramp", "ramp", "As in 0.5 s, from nothing to all of it" },
};
constexpr Part parts_of_card[] {
    { "/type", "system", "As `tactus devices` lists them: JACK, ALSA ... Left out: any" },
    { "/output", "plays on", "Name of the card, or a part of it" },
    { "/input", "hears from", "Name of the card, or a part of it" },
    { "/rate_hz", "rate", "Hz. Left out: the card's own" },
    { "/block", "block", "Frames. Small ones are late sooner, large ones add to the delay" },
    { "/reserve", "reserve", "As in 10 ms: how late a tick or a block may be without a gap; adds to the delay" },
};

std::span<const Part> partsOf (const std::string& driver)
{
    if (driver == "audio") return parts_of_sound;
    return parts;
}

juce::String asText (const std::string& s) { return juce::String::fromUTF8 (s.c_str()); }

juce::String written (const Json& v) { return asText (v.is_string() ? v.get<std::string>() : v.dump()); }

Json readText (const juce::String& t)
{
    auto value = Json::parse (t.trim().toStdString(), nullptr, false);
    return value.is_discarded() ? Json (t.trim().toStdString()) : value;
}

juce::String asText (const Message& m) { return asText (m.text + (m.remedy.empty() ? "" : ": " + m.remedy)); }

bool isListOfChannels (const std::string& pointer) { return pointer == "/outputs" || pointer == "/inputs"; }

/// A role may be bound with its workspace and guard; which device it is does not depend on them.
Json device (Json binding)
{
    for (const auto* key : { "workspace", "guard", "outputs", "inputs" })
        binding.erase (key);
    return binding;
}

/// Takes a part away, and what it leaves empty around it.
void take (Json& binding, const std::string& pointer)
{
    const Json::json_pointer at (pointer);
    if (! binding.contains (at)) return;
    auto& around = binding.at (at.parent_pointer());
    around.erase (at.back());
    if (around.empty() && ! at.parent_pointer().empty()) binding.erase (at.parent_pointer().back());
}
}   // namespace

std::vector<BindingChoice> bindingChoices (const Json* bound_now, std::span<const hid::ConnectedDevice> connected, const hid::LoadedProfiles& profiles)
{
    std::vector<BindingChoice> all { { "as the graph says", Json() }, { "simulated tool", defaultDevice() }, { sound_card, { { "driver", "audio" } } } };
    for (const auto& d : connected)
    {
        const auto fitting = hid::matching (profiles.profiles, d);
        if (fitting.empty()) continue;
        Json description { { "driver", "hid" }, { "profile", fitting.front()->id } };
        const auto alike = std::ranges::count_if (connected, [&] (const auto& other)
                                                  { return hid::fit (*fitting.front(), other) > 0; });
        if (alike > 1 && ! d.serial.empty()) description["serial"] = d.serial;
        BindingChoice choice { fitting.front()->name + (alike > 1 && ! d.serial.empty() ? ", serial " + d.serial : std::string()), std::move (description) };
        if (std::ranges::count (all, choice) == 0) all.push_back (std::move (choice));
    }
    for (const auto& g : gestures())
        all.push_back ({ "gesture " + std::string (g.id), { { "driver", "gesture" }, { "path", g.id } } });
    if (bound_now != nullptr)
    {
        const auto now = device (*bound_now);
        if (std::ranges::none_of (all, [&] (const auto& c)
                                  { return c.description == now; }))
            all.push_back ({ nameOf (now), now });
    }
    return all;
}

DevicesPanel::DevicesPanel (Document& d, Performance& p, DeviceDesk& k) : document (d), run (p), desk (k)
{
    scroll.setViewedComponent (&sheet, false);
    scroll.setScrollBarsShown (true, false);
    scroll.setScrollBarThickness (8);
    addAndMakeVisible (scroll);
}

DevicesPanel::~DevicesPanel() { desk.look (false); }

const RoleFit* DevicesPanel::fitOf (const std::string& role) const
{
    const auto at = std::ranges::find (fits, role, &RoleFit::role);
    return at == fits.end() ? nullptr : &*at;
}

void DevicesPanel::edit (const std::function<void (DeviceSession&)>& change)
{
    if (const auto wrong = desk.edit (change); wrong && onHint) onHint (asText (*wrong));
    look();
}

void DevicesPanel::bind (const std::string& role, const std::string& words)
{
    const auto at = std::ranges::find (shape.roles, role);
    if (at == shape.roles.end()) return;
    const auto& choices = shape.choices[static_cast<std::size_t> (at - shape.roles.begin())];
    const auto choice = std::ranges::find (choices, words, &BindingChoice::words);
    if (choice == choices.end()) return;
    edit ([role, to = choice->description] (DeviceSession& s)
          {
        if (to.is_null())
            s.unbind (role);
        else
            s.bind (role, boundAnew (s.binding (role), to)); });
}

void DevicesPanel::setPart (const std::string& role, const std::string& pointer, const juce::String& text)
{
    const auto* before = bindingOf (role);
    if (before == nullptr) return;
    auto binding = *before;
    if (text.trim().isEmpty())
        take (binding, pointer);
    else
    {
        const Json::json_pointer at (pointer);
        binding[at] = isListOfChannels (pointer) ? readChannelsText (text.toStdString(), binding.contains (at) ? binding.at (at) : Json()) : readText (text);
    }
    for (const auto& m : checkBinding (binding, desk.session().file.parent_path(), desk.profiles()))
        if (m.severity == Message::Severity::error)
        {
            if (onHint) onHint (asText (m));
            return;
        }
    edit ([&] (DeviceSession& s)
          { s.bind (role, binding); });
}

void DevicesPanel::refresh()
{
    if (! isVisible() || ++refreshes % refreshes_apart != 0) return;
    look();
}

void DevicesPanel::look()
{
    const auto connected = desk.connected();
    fits = fitsOf (run.needs(), document.graph(), desk.session(), desk.profiles(), connected);
    Shape now;
    for (const auto& fit : fits)
    {
        now.roles.push_back (fit.role);
        const auto* binding = bindingOf (fit.role);
        now.drivers.push_back (binding != nullptr ? binding->value ("driver", std::string()) : std::string());
        now.choices.push_back (bindingChoices (bindingOf (fit.role), connected, desk.profiles()));
    }
    now.routes = routes().size();
    if (columns.empty() || now != shape)
    {
        shape = std::move (now);
        rebuild();
    }
    for (auto& c : columns)
        c->refresh (nullptr);
}

void DevicesPanel::rebuild()
{
    retired = std::move (columns);
    columns.clear();
    for (auto& c : retired)
        sheet.removeChildComponent (c.get());
    columns.push_back (clockCard());
    for (std::size_t i = 0; i < shape.roles.size(); ++i)
        columns.push_back (roleCard (i));
    columns.push_back (soundCard());
    for (auto& c : columns)
    {
        c->onHeight = [this]
        { resized(); };
        sheet.addAndMakeVisible (*c);
        c->refresh (nullptr);
    }
    resized();
}

std::unique_ptr<Column> DevicesPanel::clockCard()
{
    auto card = std::make_unique<Column>();
    card->add ("Clock", Words::Kind::title);
    std::vector<std::string> choices { first_that_can, "timer", sound_card };
    choices.insert (choices.end(), shape.roles.begin(), shape.roles.end());
    const auto chosen = [this]
    {
        const auto now = desk.session().session.clock();
        return now.empty() ? std::string (first_that_can) : now == "audio" ? std::string (sound_card)
                                                                           : now;
    };
    if (std::ranges::count (choices, chosen()) == 0) choices.push_back (chosen());
    card->add (choiceRow (
        "ticked by", choices, chosen,
        [this] (const std::string& to)
        { edit ([&] (DeviceSession& s)
                { s.setClock (to == first_that_can ? std::string() : to == sound_card ? std::string ("audio")
                                                                                      : to); }); },
        "What ticks a run: the reports of a role's device, the blocks of the sound card, or a timer at the rate of the graph"));
    card->add (remark ([this]
                       { return ticking(); }));
    card->add ("Kept in " + asText (desk.session().file.string()) + ", not in the graph.", Words::Kind::small);
    return card;
}

std::unique_ptr<Column> DevicesPanel::roleCard (std::size_t i)
{
    const auto role = shape.roles[i];
    auto card = std::make_unique<Column>();
    card->add (asText (role), Words::Kind::title);
    std::vector<std::string> words;
    for (const auto& c : shape.choices[i])
        words.push_back (c.words);
    card->add (choiceRow (
        "device", words, [this, role, choices = shape.choices[i]]
        {
        const auto* now = bindingOf (role);
        const auto at = std::ranges::find_if (choices, [&] (const auto& c)
                                              { return now == nullptr ? c.description.is_null() : c.description == device (*now); });
        return at == choices.end() ? std::string() : at->words; },
        [this, role] (const std::string& to)
        { bind (role, to); },
        "What stands behind this role here, whatever the graph"));
    card->add (remark ([this, role]
                       { return fitting (role); }));
    card->add (remark ([this, role]
                       { return doing (role); }));
    if (shape.drivers[i].empty()) return card;
    for (const auto& part : partsOf (shape.drivers[i]))
        card->add (textRow (
            part.label, [this, role, at = Json::json_pointer (part.pointer)]
            {
            const auto* now = bindingOf (role);
            if (now == nullptr || ! now->contains (at)) return juce::String();
            return isListOfChannels (at.to_string()) ? asText (textOfChannels (now->at (at))) : written (now->at (at)); },
            [this, role, pointer = std::string (part.pointer)] (const juce::String& text)
            { setPart (role, pointer, text); },
            part.about));
    return card;
}

Json DevicesPanel::routes() const
{
    const auto* sound = desk.session().session.audio();
    return sound != nullptr ? sound->value ("routes", Json::array()) : Json::array();
}

void DevicesPanel::setSound (const std::function<void (Json&)>& change)
{
    const auto* before = desk.session().session.audio();
    Json sound = before != nullptr ? *before : Json::object();
    change (sound);
    Messages messages;
    audio::readAudioSettings (sound, "", messages);
    for (const auto& m : messages)
        if (m.severity == Message::Severity::error)
        {
            if (onHint) onHint (asText (m));
            return;
        }
    edit ([&] (DeviceSession& s)
          { s.setAudio (sound); });
}

void DevicesPanel::setCard (const std::string& pointer, const juce::String& text)
{
    setSound ([&] (Json& sound)
              {
        if (text.trim().isEmpty())
            take (sound, pointer);
        else
            sound[Json::json_pointer (pointer)] = readText (text); });
}

void DevicesPanel::setRoute (std::size_t i, const juce::String& text)
{
    auto all = routes();
    const bool is_new = i >= all.size();
    if (text.trim().isEmpty())
    {
        if (! is_new) all.erase (i);
    }
    else
    {
        auto route = readRouteText (text.trim().toStdString(), is_new ? Json::object() : all[i]);
        if (const auto* problem = std::get_if<Message> (&route))
        {
            if (onHint) onHint (asText (*problem));
            return;
        }
        if (is_new)
            all.push_back (std::get<Json> (route));
        else
            all[i] = std::get<Json> (route);
    }
    setSound ([&] (Json& sound)
              { sound["routes"] = all; });
}

/// The card that all runs play on, and the ports that they play.
std::unique_ptr<Column> DevicesPanel::soundCard()
{
    auto card = std::make_unique<Column>();
    card->add ("Sound card", Words::Kind::title);
    for (std::size_t i = 0; i <= shape.routes; ++i)
        card->add (textRow (
            i < shape.routes || i == 0 ? "plays" : "plays also", [this, i]
            {
            const auto all = routes();
            return i < all.size() ? asText (textOfRoute (all[i])) : juce::String(); },
            [this, i] (const juce::String& text)
            { setRoute (i, text); },
            "PORT=CHANNEL@FULLSCALE, as in mix.out=3@4 N: a port of the graph on a channel of the card, and how much of it is the loudest"));
    card->add (remark ([this]
                       { return sounding(); }));
    for (const auto& part : parts_of_card)
        card->add (textRow (
            part.label, [this, at = Json::json_pointer (part.pointer)]
            {
            const auto* now = desk.session().session.audio();
            return now != nullptr && now->contains (at) ? written (now->at (at)) : juce::String(); },
            [this, pointer = std::string (part.pointer)] (const juce::String& text)
            { setCard (pointer, text); },
            part.about));
    return card;
}

Remark DevicesPanel::sounding() const
{
    const auto now = run.isRunning() ? run.audioStatus() : std::nullopt;
    if (! now) return { routes().empty() ? "Plays no port: write one, as in mix.out=1@4 N." : "Nothing runs.", false };
    if (now->card.type.empty()) return { now->trouble.empty() ? "No sound card." : asText (now->trouble), true };
    const auto sound = asText (audio::statusOf (*now)).trim();
    if (! now->is_open) return { sound + (now->trouble.empty() ? juce::String() : ": " + asText (now->trouble)), true };
    return { asText (now->card.type + ": " + now->card.name + ", ") + juce::String (now->card.rate_hz) + " Hz, blocks of " + juce::String (now->card.block) + "\n" + sound, now->clipped > 0 };
}

/// What the role needs, and what of it is not there.
Remark DevicesPanel::fitting (const std::string& role) const
{
    const auto* fit = fitOf (role);
    if (fit == nullptr) return {};
    Remark r { asText ("Needs " + describe (fit->needs) + "."), false };
    const auto complain = [&] (const std::string& what)
    {
        r.text << "\n"
               << asText (what);
        r.is_wrong = true;
    };
    for (const auto& m : fit->messages)
        complain (m.text);
    if (! fit->lacking.empty()) complain ("It does not fit:");
    for (const auto& l : fit->lacking)
        complain (l);
    if (fit->from == RoleFit::From::graph) r.text << "\n"
                                                  << asText ("The graph says: " + nameOf (fit->description) + ".");
    if (fit->from == RoleFit::From::nobody) r.text << "\nNobody says which device it is: a simulated tool at rest.";
    return r;
}

/// How its device is doing.
Remark DevicesPanel::doing (const std::string& role) const
{
    Remark r;
    const auto* fit = fitOf (role);
    const auto health = std::ranges::find (run.health(), role, &DeviceHealth::role);
    if (health != run.health().end())
    {
        r.text = asText (describe (*health));
        r.is_wrong = ! health->connected;
    }
    else if (fit != nullptr && fit->connected && ! run.isRunning())
        r = *fit->connected ? Remark { "Connected.", false } : Remark { "Not connected. A run waits for it, and nothing pushes meanwhile.", true };
    const auto status = run.status();
    if (! status || ! run.isRunning()) return r;
    for (const auto& now : status->shown())
        if (now.name == role && now.stop != Guard::Stop::none)
        {
            r.text << (r.text.isEmpty() ? "" : "\n") << "Its guard holds the force back: " << asText (describe (now.latestEvent())) << ".";
            r.is_wrong = true;
        }
    return r;
}

Remark DevicesPanel::ticking() const
{
    const auto status = run.status();
    if (! status || ! run.isRunning()) return { "Nothing runs.", false };
    if (const auto sound = run.audioStatus(); sound && desk.session().session.clock() == "audio")
    {
        if (status->clock_replaced) return { "The sound card gives no blocks: a timer ticks in its place, and all forces are held at zero.", true };
        return { "The blocks of the sound card tick, at " + juce::String (run.rate()) + " Hz.", false };
    }
    const auto& role = run.clockRole();
    if (const auto wanted = desk.session().session.clock(); role.empty() && ! wanted.empty() && wanted != "timer")
        return { "A timer ticks, at " + juce::String (run.rate()) + " Hz: " + (fitOf (wanted) == nullptr ? "this graph has no role " + asText (wanted) : asText (wanted) + " has no clock now") + ".", false };
    if (role.empty()) return { "A timer ticks, at " + juce::String (run.rate()) + " Hz.", false };
    if (status->clock_replaced) return { asText (role) + " is away: a timer ticks in its place, and all forces are held at zero.", true };
    return { asText (role) + " ticks, at " + juce::String (run.rate()) + " Hz.", false };
}

void DevicesPanel::paint (juce::Graphics& g) { g.fillAll (lookOf (*this).theme().panel); }

/// Cards side by side, as many as there is room for.
void DevicesPanel::resized()
{
    scroll.setBounds (getLocalBounds());
    const int width = getWidth() - scroll.getScrollBarThickness();
    const int across = std::clamp (width / card_width, 1, std::max (1, static_cast<int> (columns.size())));
    int x = 0, y = 0, highest = 0;
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        if (i > 0 && static_cast<int> (i) % across == 0)
        {
            y += highest;
            x = highest = 0;
        }
        columns[i]->layOut (std::min (width / across, widest_card));
        columns[i]->setTopLeftPosition (x, y);
        x += columns[i]->getWidth();
        highest = std::max (highest, columns[i]->getHeight());
    }
    sheet.setSize (width, y + highest);
}

void DevicesPanel::visibilityChanged()
{
    desk.look (isVisible());
    if (isVisible()) look();
}

}   // namespace tactus::host
