// SPDX-License-Identifier: GPL-3.0-or-later
#include "devices_panel.hpp"
#include "axes_text.hpp"
#include "sound_text.hpp"

#include <host/app/inspector/blocks/fields.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/devices/hid_link/force_feedback.hpp>
#include <host/devices/sessions/audio_settings.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int card_width = 280, widest_card = 480, refreshes_apart = 6;   // every sixth refresh updates the panel: five times a second

/// Clocks other than a role: the value in the session, and the label in English.
constexpr std::pair<const char*, const char*> clocks[] { { "", NEEDS_TRANS ("automatic") }, { "timer", NEEDS_TRANS ("timer") }, { "audio", sound_card } };

std::string labelOf (const std::string& clock)
{
    const auto known = std::ranges::find (clocks, clock, [] (const auto& c) { return std::string_view (c.first); });
    return known != std::end (clocks) ? juce::translate (known->second).toStdString() : clock;
}

std::string clockLabelled (const std::string& label)
{
    const auto known = std::ranges::find (clocks, label, [] (const auto& c) { return juce::translate (c.second).toStdString(); });
    return known != std::end (clocks) ? known->first : label;
}

constexpr const char* axes_part = "/workspace/axes";

/// A setting of a binding: its JSON pointer, and its label and tooltip in English.
struct Part
{
    const char *pointer, *label, *about;
};
constexpr Part parts_of_tool[] {
    { "/workspace/scale", NEEDS_TRANS ("scale"),
      NEEDS_TRANS ("Size of the device's workspace in the graph: at 2 the hand moves half as far, and walls feel twice as stiff") },
    { "/workspace/offset", NEEDS_TRANS ("offset"),
      NEEDS_TRANS ("Position of the device's origin in the graph, such as [0, 0, \"1 cm\"]. The arrows in the 3D scene change it, too") },
    { axes_part, NEEDS_TRANS ("axes"),
      NEEDS_TRANS ("Which axes of the device are x, y and z of the graph, such as y -x z, which turns it, or -x y z, which mirrors it. For any other "
                   "angle: three rows of numbers, such as [[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]]") },
    { "/workspace/clutch", NEEDS_TRANS ("clutch"),
      NEEDS_TRANS ("Button of the device that moves the workspace with the hand while it is held, by its name or number. The key S does it, too") },
    { "/guard/max_force", NEEDS_TRANS ("max force"), NEEDS_TRANS ("Force limit, such as 3 N. Cannot exceed the limit in the device's profile") },
    { "/guard/max_speed", NEEDS_TRANS ("max speed"),
      NEEDS_TRANS ("Speed limit of the tool in the hand, such as 1 m/s. If the tool exceeds it, the guard withholds the force until you rearm") },
    { "/guard/ramp", NEEDS_TRANS ("ramp"), NEEDS_TRANS ("Time from no force to full force, such as 0.5 s") },
};

constexpr Part parts_of_calibration[] {
    { "/calibration/full_force", NEEDS_TRANS ("full force"),
      NEEDS_TRANS ("What the device exerts at its largest magnitude, such as 4 N, or 2.5 N*m for a wheel. Measure it. Without it, a tenth is used") },
    { "/calibration/travel", NEEDS_TRANS ("travel"),
      NEEDS_TRANS ("How far each axis moves from end to end, such as {\"x\": \"12 cm\"}, or {\"steering\": \"900 deg\"} for a wheel") },
    { "/calibration/reversed", NEEDS_TRANS ("reversed"), NEEDS_TRANS ("true if a force to the right pushes to the left") },
};

constexpr Part parts_of_events[] {
    { "/max_rate", NEEDS_TRANS ("max rate"),
      NEEDS_TRANS ("How many new forces per second the device gets at most, such as 250 Hz. Default: as many as its USB port takes, or 250") },
};

constexpr Part parts_of_sound[] {
    { "/outputs", NEEDS_TRANS ("outputs"),
      NEEDS_TRANS ("Card channels for the signal outputs 1, 2 ... of the role, and the value at full scale, such as 3@4 N, 4@4 N. "
                   "Default: the outputs that the graph uses") },
    { "/inputs", NEEDS_TRANS ("inputs"), NEEDS_TRANS ("The same for the signal inputs, such as 1@20 m/s2") },
    { "/guard/max_signal", NEEDS_TRANS ("max signal"), NEEDS_TRANS ("Limit of each output, in that output's unit") },
    { "/guard/ramp", NEEDS_TRANS ("ramp"), NEEDS_TRANS ("Time from silence to full signal, such as 0.5 s") },
};
constexpr Part lists_of_card[] {
    { "/type", NEEDS_TRANS ("audio system"), NEEDS_TRANS ("The audio system, such as JACK (PipeWire, too) or ALSA") },
    { "/output", NEEDS_TRANS ("output"), NEEDS_TRANS ("The card for the outputs") },
    { "/input", NEEDS_TRANS ("input"), NEEDS_TRANS ("The card for the inputs") },
};
constexpr Part parts_of_card[] {
    { "/rate_hz", NEEDS_TRANS ("sample rate"), NEEDS_TRANS ("Sample rate in Hz. Default: the card's own rate") },
    { "/block", NEEDS_TRANS ("block size"), NEEDS_TRANS ("Block size in frames. Small blocks risk gaps; large ones add delay") },
    { "/reserve", NEEDS_TRANS ("reserve"), NEEDS_TRANS ("How late a tick or block may be without causing a gap, such as 10 ms. Adds to the delay") },
};

std::vector<Part> partsOf (const std::string& driver)
{
    std::vector<Part> parts;
    const auto add = [&] (std::span<const Part> more) { parts.insert (parts.end(), more.begin(), more.end()); };
    if (driver == hid::pid_profile || driver == event_driver) add (parts_of_calibration);
    if (driver == event_driver) add (parts_of_events);
    add (driver == "audio" ? std::span<const Part> (parts_of_sound) : parts_of_tool);
    return parts;
}

/// The name that decides which settings a binding has: its driver, or "pid" for a HID device that must be calibrated.
std::string driverOf (const Json& binding)
{
    const bool is_pid = hid::isHid (binding) && binding.value ("profile", Json()) == Json (hid::pid_profile);
    return is_pid ? std::string (hid::pid_profile) : binding.value ("driver", std::string());
}

std::string anyCard() { return TRANS ("automatic").toStdString(); }

juce::String written (const Json& v) { return fromUtf8 (v.is_string() ? v.get<std::string>() : v.dump()); }

Json readText (const juce::String& t)
{
    const auto text = t.trim().toStdString();
    return Json::tryParse (text).value_or (Json (text));
}

bool isListOfChannels (const std::string& pointer) { return pointer == "/outputs" || pointer == "/inputs"; }

/// A setting as it is typed.
juce::String typedPart (const std::string& pointer, const Json& value)
{
    if (pointer == axes_part) return fromUtf8 (textOfAxes (value));
    return isListOfChannels (pointer) ? fromUtf8 (textOfChannels (value)) : written (value);
}

Json readTypedPart (const std::string& pointer, const juce::String& text, const Json& before)
{
    if (pointer == axes_part) return readAxesText (text.trim().toStdString());
    if (pointer == "/workspace/clutch") return text.trim().toStdString();   // a number, too, is written as a text
    return isListOfChannels (pointer) ? readChannelsText (text.toStdString(), before) : readText (text);
}

/// Removes a setting, and the object around it if that becomes empty.
void remove (Json& binding, const std::string& pointer)
{
    const JsonPointer at (pointer);
    if (! binding.contains (at)) return;
    auto& around = binding.at (at.parent());
    around.erase (at.parts().back());
    if (around.empty() && ! at.parent().parts().empty()) binding.erase (at.parent().parts().back());
}
}   // namespace

DevicesPanel::DevicesPanel (Document& d, LiveRun& r, DeviceSetup& s) : document (d), run (r), setup (s)
{
    setTitle (TRANS ("Devices"));
    scroll.setViewedComponent (&sheet, false);
    scroll.setScrollBarsShown (true, false);
    scroll.setScrollBarThickness (8);
    scroll.setWantsKeyboardFocus (false);   // the keys are for the fields
    addAndMakeVisible (scroll);
}

DevicesPanel::~DevicesPanel() { setup.scan (false); }

const RoleFit* DevicesPanel::fitOf (const std::string& role) const
{
    const auto at = std::ranges::find (fits, role, &RoleFit::role);
    return at == fits.end() ? nullptr : &*at;
}

void DevicesPanel::edit (const std::function<void (DeviceSession&)>& change)
{
    if (const auto edited = setup.edit (change); ! edited) complain ({ edited.error() });
    update();
}

bool DevicesPanel::complain (const Messages& messages) const
{
    const auto error = std::ranges::find (messages, Message::Severity::error, &Message::severity);
    if (error == messages.end()) return false;
    if (onHint) onHint (fromUtf8 (messageText (*error)));
    return true;
}

const BindingChoice* DevicesPanel::choiceOf (const std::string& role, const std::string& label) const
{
    const auto at = std::ranges::find (shape.roles, role);
    if (at == shape.roles.end()) return nullptr;
    const auto& choices = shape.choices[static_cast<std::size_t> (at - shape.roles.begin())];
    const auto choice = std::ranges::find (choices, label, &BindingChoice::label);
    return choice == choices.end() ? nullptr : &*choice;
}

/// The choice that a role is bound to now; null if there is none.
const BindingChoice* DevicesPanel::choiceNow (const std::string& role) const
{
    const auto at = std::ranges::find (shape.roles, role);
    if (at == shape.roles.end()) return nullptr;
    const auto* bound = bindingOf (role);
    const auto now = bound != nullptr ? deviceOfBinding (*bound) : Json();
    const auto& choices = shape.choices[static_cast<std::size_t> (at - shape.roles.begin())];
    const auto choice = std::ranges::find (choices, now, &BindingChoice::description);
    return choice == choices.end() ? nullptr : &*choice;
}

std::vector<std::pair<std::string, std::vector<std::string>>> DevicesPanel::choices()
{
    update();
    std::vector<std::pair<std::string, std::vector<std::string>>> all;
    for (std::size_t i = 0; i < shape.roles.size(); ++i)
    {
        all.emplace_back (shape.roles[i], std::vector<std::string> {});
        for (const auto& c : shape.choices[i])
            all.back().second.push_back (c.label);
    }
    return all;
}

void DevicesPanel::setPart (const std::string& role, const std::string& pointer, const juce::String& text)
{
    const auto* before = bindingOf (role);
    if (before == nullptr) return;
    auto binding = *before;
    if (text.trim().isEmpty())
        remove (binding, pointer);
    else
    {
        auto& value = binding[JsonPointer (pointer)];   // null if it is new
        value = readTypedPart (pointer, text, value);
    }
    const auto parts = partsOf (driverOf (binding));
    const auto part = std::ranges::find (parts, pointer, [] (const Part& p) { return std::string (p.pointer); });
    change (role, std::move (binding), part != parts.end() ? juce::translate (part->label) : fromUtf8 (pointer));
}

void DevicesPanel::refresh()
{
    if (! isVisible() || ++refreshes % refreshes_apart != 0) return;
    update();
}

void DevicesPanel::update()
{
    if (const auto answer = setup.takeAnswer(); answer && ! complain (answer->second) && onHint)
        onHint (filled (TRANS ("Devices that drivers have found: %1"), std::to_string (answer->first)));
    const auto connected = setup.connected(), without_profile = setup.withoutProfile();
    const auto events = setup.events();
    const auto offered = setup.offered();
    fits = fitsOf (run.needs(), document.graph(), setup.session(), setup.profiles(), connected);
    Shape now;
    for (const auto& fit : fits)
    {
        now.roles.push_back (fit.role);
        const auto* binding = bindingOf (fit.role);
        now.drivers.push_back (binding != nullptr ? driverOf (*binding) : std::string());
        now.choices.push_back (bindingChoices (bindingOf (fit.role), connected, setup.profiles(), without_profile, events, offered));
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
        c->onHeight = [this] { resized(); };
        sheet.addAndMakeVisible (*c);
        c->refresh (nullptr);
    }
    resized();
}

std::unique_ptr<Column> DevicesPanel::clockCard()
{
    auto card = std::make_unique<Column>();
    card->add (TRANS ("Clock"), TextBlock::Kind::title);
    std::vector<std::string> choices;
    for (const auto& [clock, label] : clocks)
        choices.push_back (juce::translate (label).toStdString());
    choices.insert (choices.end(), shape.roles.begin(), shape.roles.end());
    const auto chosen = [this] { return labelOf (setup.session().session.clock()); };
    if (std::ranges::count (choices, chosen()) == 0) choices.push_back (chosen());
    card->add (choiceRow (
        TRANS ("source"), choices, chosen,
        [this] (const std::string& to) { chooseClock (to); },
        TRANS ("What ticks the run: the reports of a role's device, the blocks of the sound card, or a timer at the rate of the graph")));
    card->add (remark ([this] { return clockRemark(); }));
    const auto saved_in = setup.session().file.string();
    card->add (filled (TRANS ("Saved in %1, not in the graph."), saved_in), TextBlock::Kind::small, fromUtf8 (saved_in));
    return card;
}

std::unique_ptr<Column> DevicesPanel::roleCard (std::size_t i)
{
    const auto role = shape.roles[i];
    auto card = std::make_unique<Column>();
    card->add (fromUtf8 (role), TextBlock::Kind::title);
    std::vector<std::string> labels;
    for (const auto& c : shape.choices[i])
        labels.push_back (c.label);
    card->add (choiceRow (
        TRANS ("device"), labels, [this, role] {
        const auto* choice = choiceNow (role);
        return choice != nullptr ? choice->label : std::string(); },
        [this, role] (const std::string& to) { bind (role, to); },
        TRANS ("The device for this role, in every graph")));
    card->add (textRow (
        TRANS ("address"), [this, role] {
        const auto refused = refused_addresses.find (role);
        return refused != refused_addresses.end() ? refused->second : juce::String(); },
        [this, role] (const juce::String& text) { bindAddress (role, text); },
        TRANS ("Binds the role to a device that the list does not show: serial:PROFILE@PORT, udp:PROFILE@ADDRESS:PORT, hid:PROFILE, or DRIVER:PORT for "
               "a driver in a plugin, such as haply:localhost:10001")));
    card->add (buttonRow (
        TRANS ("Look for devices of drivers"), [this] { setup.askDrivers(); },
        TRANS ("Loads the drivers in the folders of plugins, and lists the devices that they find, such as arms of Force Dimension. Arms that are free are "
               "opened for a moment; nothing is pushed")));
    card->add (remark ([this, role] { return fitRemark (role); }));
    card->add (remark ([this, role] { return statusRemark (role); }));
    card->add (buttonRow (
        filled (TRANS ("Test %1"), role), [this, role] { tryDevice (role); },
        TRANS ("Plays one gentle pulse of 0.3 s on this device, at most a tenth of the limit of its guard. The graph must be running; it pauses during the "
               "test.")));
    if (shape.drivers[i].empty()) return card;
    for (const auto& part : partsOf (shape.drivers[i]))
        card->add (textRow (
            juce::translate (part.label), [this, role, pointer = std::string (part.pointer)] {
            const auto* now = bindingOf (role);
            const JsonPointer at (pointer);
            return now != nullptr && now->contains (at) ? typedPart (pointer, now->at (at)) : juce::String(); },
            [this, role, pointer = std::string (part.pointer)] (const juce::String& text) { setPart (role, pointer, text); },
            juce::translate (part.about)));
    return card;
}

Json DevicesPanel::routes() const
{
    const auto* sound = setup.session().session.audio();
    return sound != nullptr ? sound->value ("routes", Json::array()) : Json::array();
}

void DevicesPanel::setSound (const std::function<void (Json&)>& change)
{
    const auto* before = setup.session().session.audio();
    Json sound = before != nullptr ? *before : Json::object();
    change (sound);
    Messages messages;
    audio::readAudioSettings (sound, "", messages);
    if (complain (messages)) return;
    edit ([&] (DeviceSession& s) { s.setAudio (sound); });
}

void DevicesPanel::setCard (const std::string& pointer, const juce::String& text)
{
    setSound ([&] (Json& sound) {
        if (text.trim().isEmpty())
            remove (sound, pointer);
        else
            sound[JsonPointer (pointer)] = readText (text);
    });
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
        if (! route)
        {
            complain ({ route.error() });
            return;
        }
        if (is_new)
            all.push_back (*std::move (route));
        else
            all[i] = *std::move (route);
    }
    setSound ([&] (Json& sound) { sound["routes"] = all; });
}

/// Makes the section for the sound card, which all runs share: the routes from ports to its channels, and its settings.
std::unique_ptr<Column> DevicesPanel::soundCard()
{
    auto card = std::make_unique<Column>();
    card->add (TRANS ("Sound card"), TextBlock::Kind::title);
    for (std::size_t i = 0; i <= shape.routes; ++i)
        card->add (textRow (
            i < shape.routes || i == 0 ? TRANS ("route") : TRANS ("add route"), [this, i] {
            const auto all = routes();
            return i < all.size() ? fromUtf8 (textOfRoute (all[i])) : juce::String(); },
            [this, i] (const juce::String& text) { setRoute (i, text); },
            TRANS ("PORT=CHANNEL@FULLSCALE, such as mix.out=3@4 N: a port of the graph, a channel of the card, and the value at full scale")));
    card->add (remark ([this] { return soundRemark(); }));
    for (const auto& list : lists_of_card)
        card->add (cardRow (list.pointer, list.label, list.about));
    card->add (buttonRow (
        TRANS ("Look for sound cards"), [this] { listSoundCards(); }, TRANS ("Lists the sound cards again, including one that you have just plugged in")));
    for (const auto& part : parts_of_card)
        card->add (textRow (
            juce::translate (part.label), [this, at = JsonPointer (part.pointer)] {
            const auto* now = setup.session().session.audio();
            return now != nullptr && now->contains (at) ? written (now->at (at)) : juce::String(); },
            [this, pointer = std::string (part.pointer)] (const juce::String& text) { setCard (pointer, text); },
            juce::translate (part.about)));
    return card;
}

/// A setting of the sound card that is chosen from what the computer has.
std::unique_ptr<Block> DevicesPanel::cardRow (const char* pointer, const char* label, const char* about)
{
    const std::string at (pointer);
    const auto isOffered = [&at] (const audio::ListedCard& c) {
        return at == "/type" || ! (at == "/output" ? c.outputs : c.inputs).empty() || ! c.trouble.empty();
    };
    const bool has_none = has_listed && std::ranges::none_of (sound_cards, isOffered);
    const auto any = has_none ? TRANS ("automatic (none found)").toStdString() : anyCard();
    const auto now = [this, any, at = JsonPointer (pointer)] {
        const auto* sound = setup.session().session.audio();
        return sound != nullptr && sound->contains (at) ? written (sound->at (at)).toStdString() : any;
    };
    std::vector<std::string> choices { any };
    const auto offer = [&] (const std::string& choice) {
        if (std::ranges::count (choices, choice) == 0) choices.push_back (choice);
    };
    for (const auto& c : sound_cards)
        if (isOffered (c)) offer (at == "/type" ? c.type : c.name);
    offer (now());   // a card that is not plugged in, or a part of a name
    return choiceRow (
        juce::translate (label), choices, now, [this, at, any] (const std::string& to) { setCard (at, to == any ? juce::String() : fromUtf8 (to)); },
        juce::translate (about));
}

/// True if the card that the session names, or any, is among those that were found.
bool DevicesPanel::hasSoundCard() const
{
    const auto* sound = setup.session().session.audio();
    const auto wanted = [sound] (const char* key) {
        const auto value = sound != nullptr ? sound->value (key, Json()) : Json();
        return value.is_string() ? value.asString() : std::string();
    };
    const auto type = wanted ("type"), output = wanted ("output");
    return std::ranges::any_of (sound_cards, [&] (const audio::ListedCard& c) {
        return c.trouble.empty() && ! c.outputs.empty() && (type.empty() || c.type == type) && c.name.find (output) != std::string::npos;
    });
}

void DevicesPanel::chooseClock (const std::string& label)
{
    const auto clock = clockLabelled (label);
    if (clock == "audio")
    {
        listSoundCards();
        if (! hasSoundCard())
        {
            if (onHint) onHint (TRANS ("The sound card cannot be the clock, because none was found that fits the settings under Sound card."));
            return update();
        }
    }
    edit ([&] (DeviceSession& s) { s.setClock (clock); });
}

void DevicesPanel::listSoundCards()
{
    sound_cards = audio::soundCards().list();
    has_listed = true;
    if (! columns.empty()) rebuild();
}

void DevicesPanel::tryDevice (const std::string& role)
{
    if (! onTry) return;
    const auto tried = onTry (role);
    if (! onHint) return;
    onHint (tried ? filled (TRANS ("Testing %1: a gentle pulse, at most a tenth of the limit of its guard."), role) : fromUtf8 (messageText (tried.error())));
}

void DevicesPanel::paint (juce::Graphics& g) { g.fillAll (lookOf (*this).theme().panel); }

/// Lays out the cards in rows, as many side by side as there is room for.
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
    setup.scan (isVisible());
    if (isShowing() && ! has_listed) listSoundCards();
    if (isVisible()) update();
}

}   // namespace tactus::host
