// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_bindings.hpp"
#include "setting_fields.hpp"
#include "sound_text.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>
#include <host/devices/hid/physics.hpp>
#include <host/devices/sessions/audio_settings.hpp>
#include <tactus/run/device/guard_limits.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace tactus::host
{

DeviceBindings::DeviceBindings (Document& d, LiveRun& r, DeviceSetup& s) : document (d), run (r), setup (s) {}

void DeviceBindings::update()
{
    if (const auto answer = setup.takeAnswer(); answer && ! complain (answer->second) && onHint)
        onHint (filled (TRANS ("Devices that drivers have found: %1"), std::to_string (answer->first)));
    const auto connected = setup.connected(), without_profile = setup.withoutProfile();
    const auto events = setup.events();
    const auto offered = setup.offered();
    fits = fitsOf (run.needs(), document.graph(), setup.session(), setup.profiles(), connected);
    now = {};
    for (const auto& fit : fits)
    {
        now.roles.push_back (fit.role);
        const auto* binding = bindingOf (fit.role);
        now.drivers.push_back (binding != nullptr ? driverOf (*binding) : std::string());
        now.choices.push_back (bindingChoices (binding, connected, setup.profiles(), without_profile, events, offered));
    }
    now.routes = routes().size();
    if (onUpdate) onUpdate();
}

const RoleFit* DeviceBindings::fitOf (const std::string& role) const
{
    const auto at = std::ranges::find (fits, role, &RoleFit::role);
    return at == fits.end() ? nullptr : &*at;
}

void DeviceBindings::edit (const std::function<void (DeviceSession&)>& change)
{
    if (const auto edited = setup.edit (change); ! edited) complain ({ edited.error() });
    update();
}

bool DeviceBindings::complain (const Messages& messages) const
{
    const auto error = std::ranges::find (messages, Message::Severity::error, &Message::severity);
    if (error == messages.end()) return false;
    if (onHint) onHint (fromUtf8 (messageText (*error)));
    return true;
}

const BindingChoice* DeviceBindings::choiceOf (const std::string& role, const std::string& label) const
{
    const auto at = std::ranges::find (now.roles, role);
    if (at == now.roles.end()) return nullptr;
    const auto& choices = now.choices[static_cast<std::size_t> (at - now.roles.begin())];
    const auto choice = std::ranges::find (choices, label, &BindingChoice::label);
    return choice == choices.end() ? nullptr : &*choice;
}

/// The choice that a role is bound to now; null if there is none.
const BindingChoice* DeviceBindings::choiceNow (const std::string& role) const
{
    const auto at = std::ranges::find (now.roles, role);
    if (at == now.roles.end()) return nullptr;
    const auto* bound = bindingOf (role);
    const auto device = bound != nullptr ? deviceOfBinding (*bound) : Json();
    const auto& choices = now.choices[static_cast<std::size_t> (at - now.roles.begin())];
    const auto choice = std::ranges::find (choices, device, &BindingChoice::description);
    return choice == choices.end() ? nullptr : &*choice;
}

std::vector<std::pair<std::string, std::vector<std::string>>> DeviceBindings::choices()
{
    update();
    std::vector<std::pair<std::string, std::vector<std::string>>> all;
    for (std::size_t i = 0; i < now.roles.size(); ++i)
    {
        all.emplace_back (now.roles[i], std::vector<std::string> {});
        for (const auto& c : now.choices[i])
            all.back().second.push_back (c.label);
    }
    return all;
}

void DeviceBindings::bind (const std::string& role, const std::string& label)
{
    if (const auto* choice = choiceOf (role, label)) bindTo (role, BindingChoice (*choice));   // a copy, because the choices are rebuilt
}

void DeviceBindings::bindAddress (const std::string& role, const juce::String& address)
{
    refused_addresses.erase (role);
    const auto text = address.trim();
    if (text.isEmpty()) return;
    auto device = readAddress (text.toStdString(), setup.profiles());
    const auto wrong = device ? checkBinding (*device, setup.session().file.parent_path(), setup.profiles()) : Messages { device.error() };
    if (complain (wrong))
        refused_addresses[role] = text;
    else
        bindTo (role, { text.toStdString(), *std::move (device) });
}

juce::String DeviceBindings::refusedAddress (const std::string& role) const
{
    const auto refused = refused_addresses.find (role);
    return refused != refused_addresses.end() ? refused->second : juce::String();
}

/// Binds a role in a step that can be undone. Redo brings back the binding that undo has left, so a limit that was changed in between stays.
void DeviceBindings::bindTo (const std::string& role, const BindingChoice& choice)
{
    refused_addresses.erase (role);
    const auto profile = choice.numbers.empty() ? nullptr : hid::profileNamed (setup.profiles(), choice.numbers);
    const auto before = boundNow (role);
    edit ([role, to = choice.description, profile] (DeviceSession& s) {
        const auto* now = s.binding (role);
        if (to.is_null())
            s.unbind (role);
        else
            s.bind (role, rebound (now, profile ? simulationOf (*profile, now) : to));
    });
    if (profile) tellKeptLimit (boundNow (role), *profile);
    if (boundNow (role) == before) return;
    const auto along = std::make_shared<std::function<void()>>();
    const auto exchange = [safe = juce::WeakReference<DeviceBindings> (this), role, along, other = std::make_shared<Json> (before)] {
        if (safe == nullptr) return;
        *other = safe->putDevice (role, *other);
        if (*along) (*along)();
    };
    document.addWindowStep (filled (TRANS ("device of %1"), role).toStdString(), exchange, exchange);
    if (onBind) *along = onBind (role);
}

/// A limit of the device before stays, also if that was the peak force of another simulation.
void DeviceBindings::tellKeptLimit (const Json& binding, const hid::Profile& profile) const
{
    const auto peak = hid::numbersOf (profile).peak_force;
    Messages told_elsewhere;
    const double limit = readGuardLimits (binding.value ("guard", Json::object()), "", told_elsewhere).max_force;
    if (onHint && peak && limit < peak->value)
        onHint (filled (TRANS ("The limit of before, %1, stays: %2 could give %3. \"max force\" changes it"), withPrefix (limit, "N"), profile.name,
                        withPrefix (peak->value, "N")));
}

/// Gives a role an earlier device; null: that of the graph. Returns the binding before. Its guard stays, unless one of the two is of another kind.
Json DeviceBindings::putDevice (const std::string& role, Json binding)
{
    refused_addresses.erase (role);
    const auto before = boundNow (role);
    edit ([&] (DeviceSession& s) {
        if (binding.is_null()) return s.unbind (role);
        const bool is_same_kind = before.is_object() && ! audio::isAudio (before) && ! audio::isAudio (binding);
        if (is_same_kind) binding.erase ("guard");
        s.bind (role, rebound (is_same_kind ? &before : nullptr, std::move (binding)));
    });
    return before;
}

void DeviceBindings::moveOrigin (const std::string& role, const Vec3& origin)
{
    const auto* before = bindingOf (role);
    if (before == nullptr) return;
    auto binding = *before;
    constexpr double steps_per_metre = 1e4;   // a drag is not finer
    Json offset = Json::array();
    for (const double metres : { origin.x(), origin.y(), origin.z() })
        offset.push_back (std::round (metres * steps_per_metre) / steps_per_metre);
    binding[JsonPointer ("/workspace/offset")] = offset;
    change (role, std::move (binding), TRANS ("offset"));
}

/// Changes a binding if it has no errors. A change of the workspace is a step that can be undone. That of a limit is not: undo takes back no limit.
void DeviceBindings::change (const std::string& role, Json binding, const juce::String& what)
{
    if (complain (checkBinding (binding, setup.session().file.parent_path(), setup.profiles()))) return;
    const auto workspaceIn = [] (const Json* b) { return b != nullptr ? b->value ("workspace", Json()) : Json(); };
    const auto before = workspaceIn (bindingOf (role));
    edit ([&] (DeviceSession& s) { s.bind (role, binding); });
    const auto after = workspaceIn (bindingOf (role));
    if (after == before) return;
    const auto to = [&, safe = juce::WeakReference<DeviceBindings> (this)] (const Json& workspace) {
        return [safe, role, workspace] {
            if (safe != nullptr) safe->putWorkspace (role, workspace);
        };
    };
    document.addWindowStep (filled (TRANS ("%1 of %2"), what, role).toStdString(), to (before), to (after));
}

/// Gives a role an earlier workspace; null: none. What else is set for the role stays, and a role that is no longer bound, too.
void DeviceBindings::putWorkspace (const std::string& role, const Json& workspace)
{
    edit ([&] (DeviceSession& s) {
        const auto* now = s.binding (role);
        if (now == nullptr) return;
        auto binding = *now;
        if (workspace.is_null())
            binding.erase ("workspace");
        else
            binding["workspace"] = workspace;
        s.bind (role, std::move (binding));
    });
}

void DeviceBindings::setPart (const std::string& role, const std::string& pointer, const juce::String& text)
{
    const auto* before = bindingOf (role);
    if (before == nullptr) return;
    auto binding = *before;
    if (text.trim().isEmpty())
        removeSetting (binding, pointer);
    else
    {
        auto& value = binding[JsonPointer (pointer)];   // null if it is new
        value = readTypedSetting (pointer, text, value);
    }
    const auto fields = fieldsOf (driverOf (binding));
    const auto field = std::ranges::find (fields, pointer, [] (const SettingField& f) { return std::string (f.pointer); });
    change (role, std::move (binding), field != fields.end() ? juce::translate (field->label) : fromUtf8 (pointer));
}

Json DeviceBindings::routes() const
{
    const auto* sound = setup.session().session.audio();
    return sound != nullptr ? sound->value ("routes", Json::array()) : Json::array();
}

void DeviceBindings::setSound (const std::function<void (Json&)>& change)
{
    const auto* before = setup.session().session.audio();
    Json sound = before != nullptr ? *before : Json::object();
    change (sound);
    Messages messages;
    audio::readAudioSettings (sound, "", messages);
    if (complain (messages)) return;
    edit ([&] (DeviceSession& s) { s.setAudio (sound); });
}

void DeviceBindings::setCard (const std::string& pointer, const juce::String& text)
{
    setSound ([&] (Json& sound) {
        if (text.trim().isEmpty())
            removeSetting (sound, pointer);
        else
            sound[JsonPointer (pointer)] = readValue (text);
    });
}

void DeviceBindings::setRoute (std::size_t i, const juce::String& text)
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

/// True if the card that the session names, or any, is among those that were found.
bool DeviceBindings::hasSoundCard() const
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

void DeviceBindings::chooseClock (const std::string& clock)
{
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

void DeviceBindings::listSoundCards()
{
    sound_cards = audio::soundCards().list();
    has_listed = true;
    if (onSoundCards) onSoundCards();
}

}   // namespace tactus::host
