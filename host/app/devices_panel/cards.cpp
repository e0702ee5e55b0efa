// SPDX-License-Identifier: GPL-3.0-or-later
#include "cards.hpp"
#include "setting_fields.hpp"
#include "sound_text.hpp"

#include <host/app/inspector/blocks/fields.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
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

std::string anyCard() { return TRANS ("automatic").toStdString(); }
}   // namespace

std::unique_ptr<Column> DeviceCards::clock()
{
    auto card = std::make_unique<Column>();
    card->add (TRANS ("Clock"), TextBlock::Kind::title);
    std::vector<std::string> choices;
    for (const auto& [clock, label] : clocks)
        choices.push_back (juce::translate (label).toStdString());
    choices.insert (choices.end(), bindings.shape().roles.begin(), bindings.shape().roles.end());
    const auto chosen = [this] { return labelOf (setup.session().session.clock()); };
    if (std::ranges::count (choices, chosen()) == 0) choices.push_back (chosen());
    card->add (choiceRow (
        TRANS ("source"), choices, chosen,
        [this] (const std::string& to) { bindings.chooseClock (clockLabelled (to)); },
        TRANS ("What ticks the run: the reports of a role's device, the blocks of the sound card, or a timer at the rate of the graph")));
    card->add (remark ([this] { return remarks.clock(); }));
    const auto saved_in = setup.session().file.string();
    card->add (filled (TRANS ("Saved in %1, not in the graph."), saved_in), TextBlock::Kind::small, fromUtf8 (saved_in));
    return card;
}

std::unique_ptr<Column> DeviceCards::role (std::size_t i)
{
    const auto role = bindings.shape().roles[i];
    auto card = std::make_unique<Column>();
    card->add (fromUtf8 (role), TextBlock::Kind::title);
    std::vector<std::string> labels;
    for (const auto& c : bindings.shape().choices[i])
        labels.push_back (c.label);
    card->add (choiceRow (
        TRANS ("device"), labels, [this, role] {
        const auto* choice = bindings.choiceNow (role);
        return choice != nullptr ? choice->label : std::string(); },
        [this, role] (const std::string& to) { bindings.bind (role, to); },
        TRANS ("The device for this role, in every graph")));
    card->add (textRow (
        TRANS ("address"), [this, role] { return bindings.refusedAddress (role); },
        [this, role] (const juce::String& text) { bindings.bindAddress (role, text); },
        TRANS ("Binds the role to a device that the list does not show: serial:PROFILE@PORT, udp:PROFILE@ADDRESS:PORT, hid:PROFILE, or DRIVER:PORT for "
               "a driver in a plugin, such as haply:localhost:10001")));
    card->add (buttonRow (
        TRANS ("Look for devices of drivers"), [this] { setup.askDrivers(); },
        TRANS ("Loads the drivers in the folders of plugins, and lists the devices that they find, such as arms of Force Dimension. Arms that are free are "
               "opened for a moment; nothing is pushed")));
    card->add (remark ([this, role] { return remarks.fit (role); }));
    card->add (remark ([this, role] { return remarks.status (role); }));
    card->add (buttonRow (
        filled (TRANS ("Test %1"), role), [this, role] { onTry (role); },
        TRANS ("Plays one gentle pulse of 0.3 s on this device, at most a tenth of the limit of its guard. The graph must be running; it pauses during the "
               "test.")));
    if (bindings.shape().drivers[i].empty()) return card;
    for (const auto& field : fieldsOf (bindings.shape().drivers[i]))
        card->add (textRow (
            juce::translate (field.label), [this, role, pointer = std::string (field.pointer)] {
            const auto* now = bindings.bindingOf (role);
            const JsonPointer at (pointer);
            return now != nullptr && now->contains (at) ? typedSetting (pointer, now->at (at)) : juce::String(); },
            [this, role, pointer = std::string (field.pointer)] (const juce::String& text) { bindings.setPart (role, pointer, text); },
            juce::translate (field.about)));
    return card;
}

/// Makes the section for the sound card, which all runs share: the routes from ports to its channels, and its settings.
std::unique_ptr<Column> DeviceCards::sound()
{
    auto card = std::make_unique<Column>();
    card->add (TRANS ("Sound card"), TextBlock::Kind::title);
    for (std::size_t i = 0; i <= bindings.shape().routes; ++i)
        card->add (textRow (
            i < bindings.shape().routes || i == 0 ? TRANS ("route") : TRANS ("add route"), [this, i] {
            const auto all = bindings.routes();
            return i < all.size() ? fromUtf8 (textOfRoute (all[i])) : juce::String(); },
            [this, i] (const juce::String& text) { bindings.setRoute (i, text); },
            TRANS ("PORT=CHANNEL@FULLSCALE, such as mix.out=3@4 N: a port of the graph, a channel of the card, and the value at full scale")));
    card->add (remark ([this] { return remarks.sound(); }));
    for (const auto& list : listsOfCard())
        card->add (cardRow (list.pointer, list.label, list.about));
    card->add (buttonRow (
        TRANS ("Look for sound cards"), [this] { bindings.listSoundCards(); },
        TRANS ("Lists the sound cards again, including one that you have just plugged in")));
    for (const auto& field : fieldsOfCard())
        card->add (textRow (
            juce::translate (field.label), [this, at = JsonPointer (field.pointer)] {
            const auto* now = setup.session().session.audio();
            return now != nullptr && now->contains (at) ? writtenValue (now->at (at)) : juce::String(); },
            [this, pointer = std::string (field.pointer)] (const juce::String& text) { bindings.setCard (pointer, text); },
            juce::translate (field.about)));
    return card;
}

/// A setting of the sound card that is chosen from what the computer has.
std::unique_ptr<Block> DeviceCards::cardRow (const char* pointer, const char* label, const char* about)
{
    const std::string at (pointer);
    const auto isOffered = [&at] (const audio::ListedCard& c) {
        return at == "/type" || ! (at == "/output" ? c.outputs : c.inputs).empty() || ! c.trouble.empty();
    };
    const bool has_none = bindings.hasListed() && std::ranges::none_of (bindings.soundCards(), isOffered);
    const auto any = has_none ? TRANS ("automatic (none found)").toStdString() : anyCard();
    const auto now = [this, any, at = JsonPointer (pointer)] {
        const auto* sound = setup.session().session.audio();
        return sound != nullptr && sound->contains (at) ? writtenValue (sound->at (at)).toStdString() : any;
    };
    std::vector<std::string> choices { any };
    const auto offer = [&] (const std::string& choice) {
        if (std::ranges::count (choices, choice) == 0) choices.push_back (choice);
    };
    for (const auto& c : bindings.soundCards())
        if (isOffered (c)) offer (at == "/type" ? c.type : c.name);
    offer (now());   // a card that is not plugged in, or a part of a name
    return choiceRow (
        juce::translate (label), choices, now, [this, at, any] (const std::string& to) { bindings.setCard (at, to == any ? juce::String() : fromUtf8 (to)); },
        juce::translate (about));
}

}   // namespace tactus::host
