// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "binding_choice.hpp"

#include <host/app/inspector/describe.hpp>
#include <host/app/run/device_setup.hpp>
#include <host/app/run/live_run.hpp>
#include <host/devices/audio/card.hpp>
#include <host/devices/sessions/role_fits.hpp>

#include <map>

namespace tactus::host
{

/// The devices for the roles of the graph. For each role: what it needs, what it is bound to and whether that fits, its status, its
/// workspace, and the limits of its guard. Also the clock of the run, and what the sound card plays. Edits change the session, not the
/// graph. Those of a device and of a workspace are steps that can be undone.
class DevicesPanel final : public juce::Component
{
public:
    DevicesPanel (Document&, LiveRun&, DeviceSetup&);
    ~DevicesPanel() override;

    void refresh();   ///< call many times a second; does nothing while hidden

    std::function<void (const juce::String&)> onHint;
    std::function<Result<> (const std::string& role)> onTry;   ///< plays a gentle pulse on the device of a role
    /// The user has chosen another device for a role. Returns what undo and redo of this do, besides changing the device; may be empty.
    std::function<std::function<void()> (const std::string& role)> onBind;
    void tryDevice (const std::string& role);

    void listSoundCards();   ///< looks for the sound cards of this computer

    std::size_t cards() const noexcept { return columns.size(); }   ///< one for the clock, one for each role, and one for the sound card
    Column& card (std::size_t i) { return *columns[i]; }

    void bind (const std::string& role, const std::string& label);   ///< binds the role to the choice with this label
    /// Binds the role to the device at this address, as readAddress() reads it. An address that names none is refused with a hint, and stays in its field.
    void bindAddress (const std::string& role, const juce::String& address);
    void chooseClock (const std::string& label);   ///< a sound card that is missing is refused with a hint
    /// The labels of what each role can be bound to.
    std::vector<std::pair<std::string, std::vector<std::string>>> choices();
    void setPart (const std::string& role, const std::string& pointer, const juce::String& text);   ///< part of the binding; empty text removes it
    void moveOrigin (const std::string& role, const Vec3& origin);                                  ///< the offset of the workspace, in m

    void setCard (const std::string& pointer, const juce::String& text);   ///< a setting of the sound card; empty text removes it
    void setRoute (std::size_t, const juce::String& text);                 ///< empty text removes it; an index past the end adds one

    void paint (juce::Graphics&) override;
    void resized() override;
    void visibilityChanged() override;

private:
    /// Everything that determines which rows there are.
    struct Shape
    {
        std::vector<std::string> roles;
        std::vector<std::string> drivers;   // by role; "" if the role is not bound
        std::vector<std::vector<BindingChoice>> choices;
        std::size_t routes = 0;

        bool operator== (const Shape&) const = default;
    };

    const RoleFit* fitOf (const std::string& role) const;
    const BindingChoice* choiceOf (const std::string& role, const std::string& label) const;
    const BindingChoice* choiceNow (const std::string& role) const;
    const Json* bindingOf (const std::string& role) const { return setup.session().session.binding (role); }
    void edit (const std::function<void (DeviceSession&)>&);
    void change (const std::string& role, Json binding, const juce::String& what);
    Json boundNow (const std::string& role) const   // null if the role is not bound
    {
        const auto* now = bindingOf (role);
        return now != nullptr ? *now : Json();
    }
    void bindTo (const std::string& role, const BindingChoice&);
    bool hasSoundCard() const;
    Json putDevice (const std::string& role, Json binding);
    void putWorkspace (const std::string& role, const Json& workspace);
    void update();
    bool complain (const Messages&) const;   // shows the first error; returns true if there is one
    void rebuild();
    std::unique_ptr<Column> clockCard();
    std::unique_ptr<Column> roleCard (std::size_t);
    std::unique_ptr<Column> soundCard();
    std::unique_ptr<Block> cardRow (const char* pointer, const char* label, const char* about);
    Json routes() const;
    void setSound (const std::function<void (Json&)>&);
    // In remarks.cpp
    Remark fitRemark (const std::string& role) const;
    Remark statusRemark (const std::string& role) const;
    Remark eventRemark (const Json& description) const;
    Remark clockRemark() const;
    Remark tickRemark() const;
    Remark soundRemark() const;

    Document& document;
    LiveRun& run;
    DeviceSetup& setup;
    std::vector<RoleFit> fits;
    std::vector<audio::ListedCard> sound_cards;
    bool has_listed = false;
    std::map<std::string, juce::String> refused_addresses;   // by role
    Shape shape;
    std::vector<std::unique_ptr<Column>> columns, retired;   // retired: kept alive, because a row may rebuild the card that contains it
    juce::Viewport scroll;
    juce::Component sheet;
    int refreshes = 0;
};

}   // namespace tactus::host
