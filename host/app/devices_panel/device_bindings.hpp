// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "binding_choice.hpp"

#include <host/app/model/document.hpp>
#include <host/app/run/device_setup.hpp>
#include <host/app/run/live_run.hpp>
#include <host/devices/audio/card.hpp>
#include <host/devices/sessions/role_fits.hpp>

#include <map>

namespace tactus::host
{

/// The devices for the roles of the graph: what each role can be bound to, whether that fits, and the edits of the session. Edits change the session, not the
/// graph. Those of a device and of a workspace are steps that can be undone. [main thread]
class DeviceBindings
{
public:
    DeviceBindings (Document&, LiveRun&, DeviceSetup&);
    ~DeviceBindings() { masterReference.clear(); }

    /// Looks again at the graph, the session and what is connected. Edits call it.
    void update();

    std::function<void()> onUpdate;                     ///< called at the end of update()
    std::function<void()> onSoundCards;                 ///< called when sound cards have been listed
    std::function<void (const juce::String&)> onHint;   ///< why an edit was refused, or what stays
    /// The user has chosen another device for a role. Returns what undo and redo of this do, besides changing the device; may be empty.
    std::function<std::function<void()> (const std::string& role)> onBind;

    /// Everything that determines which rows the panel has.
    struct Shape
    {
        std::vector<std::string> roles;
        std::vector<std::string> drivers;   // by role; "" if the role is not bound
        std::vector<std::vector<BindingChoice>> choices;
        std::size_t routes = 0;

        bool operator== (const Shape&) const = default;
    };
    const Shape& shape() const noexcept { return now; }

    const RoleFit* fitOf (const std::string& role) const;             ///< null: no such role
    const BindingChoice* choiceNow (const std::string& role) const;   ///< that the role is bound to; null if there is none
    const Json* bindingOf (const std::string& role) const { return setup.session().session.binding (role); }

    /// The labels of what each role can be bound to.
    std::vector<std::pair<std::string, std::vector<std::string>>> choices();

    void bind (const std::string& role, const std::string& label);   ///< binds the role to the choice with this label
    /// Binds the role to the device at this address, as readAddress() reads it. An address that names none is refused with a hint, and is kept.
    void bindAddress (const std::string& role, const juce::String& address);
    juce::String refusedAddress (const std::string& role) const;
    void setPart (const std::string& role, const std::string& pointer, const juce::String& text);   ///< part of the binding; empty text removes it
    void moveOrigin (const std::string& role, const Vec3& origin);                                  ///< the offset of the workspace, in m

    void chooseClock (const std::string& clock);   ///< as in the session; a sound card that is missing is refused with a hint

    void listSoundCards();   ///< looks for the sound cards of this computer
    bool hasListed() const noexcept { return has_listed; }
    const std::vector<audio::ListedCard>& soundCards() const noexcept { return sound_cards; }
    Json routes() const;
    void setCard (const std::string& pointer, const juce::String& text);   ///< a setting of the sound card; empty text removes it
    void setRoute (std::size_t, const juce::String& text);                 ///< empty text removes it; an index past the end adds one

private:
    const BindingChoice* choiceOf (const std::string& role, const std::string& label) const;
    void edit (const std::function<void (DeviceSession&)>&);
    void change (const std::string& role, Json binding, const juce::String& what);
    Json boundNow (const std::string& role) const   // null if the role is not bound
    {
        const auto* bound = bindingOf (role);
        return bound != nullptr ? *bound : Json();
    }
    void bindTo (const std::string& role, const BindingChoice&);
    bool hasSoundCard() const;
    Json putDevice (const std::string& role, Json binding);
    void tellKeptLimit (const Json& binding, const hid::Profile&) const;
    void putWorkspace (const std::string& role, const Json& workspace);
    void setSound (const std::function<void (Json&)>&);
    bool complain (const Messages&) const;   // shows the first error; returns true if there is one

    Document& document;
    LiveRun& run;
    DeviceSetup& setup;
    std::vector<RoleFit> fits;
    std::vector<audio::ListedCard> sound_cards;
    bool has_listed = false;
    std::map<std::string, juce::String> refused_addresses;   // by role
    Shape now;

    JUCE_DECLARE_WEAK_REFERENCEABLE (DeviceBindings)
};

}   // namespace tactus::host
