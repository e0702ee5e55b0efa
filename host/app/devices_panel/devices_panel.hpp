// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "device_desk.hpp"

#include <host/app/inspector/describe.hpp>
#include <host/app/run/performance.hpp>
#include <host/sessions/role_fits.hpp>

namespace tactus::host
{

/// What a role can be bound to, and how that is called in a list.
struct BindingChoice
{
    std::string words;
    Json description;   ///< null: what the graph says

    bool operator== (const BindingChoice&) const = default;
};

/// What the graph says, a simulated tool, the gestures, each device that is connected and has a profile, and what the role is
/// bound to now, if it is none of these.
std::vector<BindingChoice> bindingChoices (const Json* bound_now, std::span<const hid::ConnectedDevice>, const hid::LoadedProfiles&);

/// The devices behind the roles of the graph: what each role needs, what it is bound to and whether that fits, how it is doing,
/// its workspace and the limits of its guard; who ticks the run; and what the sound card plays. What is edited here goes into the session, not into the
/// graph.
class DevicesPanel final : public juce::Component
{
public:
    DevicesPanel (Document&, Performance&, DeviceDesk&);
    ~DevicesPanel() override;

    void refresh();   ///< to be called many times a second; of no effect while it is not to be seen

    std::function<void (const juce::String&)> onHint;

    std::size_t cards() const noexcept { return columns.size(); }   ///< the clock's, one for each role, and the sound card's
    Column& card (std::size_t i) { return *columns[i]; }

    void bind (const std::string& role, const std::string& words);                                  ///< by one of the choices
    void setPart (const std::string& role, const std::string& pointer, const juce::String& text);   ///< of the binding; empty: takes it away

    void setCard (const std::string& pointer, const juce::String& text);   ///< of the sound card; empty: takes it away
    void setRoute (std::size_t, const juce::String& text);                 ///< empty: takes it away; one more than there are: adds it

    void paint (juce::Graphics&) override;
    void resized() override;
    void visibilityChanged() override;

private:
    /// What decides which rows there are.
    struct Shape
    {
        std::vector<std::string> roles;
        std::vector<std::string> drivers;   // of those that are bound; "": not bound
        std::vector<std::vector<BindingChoice>> choices;
        std::size_t routes = 0;

        bool operator== (const Shape&) const = default;
    };

    const RoleFit* fitOf (const std::string& role) const;
    const Json* bindingOf (const std::string& role) const { return desk.session().session.binding (role); }
    void edit (const std::function<void (DeviceSession&)>&);
    void look();
    void rebuild();
    std::unique_ptr<Column> clockCard();
    std::unique_ptr<Column> roleCard (std::size_t);
    std::unique_ptr<Column> soundCard();
    Json routes() const;
    void setSound (const std::function<void (Json&)>&);
    Remark fitting (const std::string& role) const;
    Remark doing (const std::string& role) const;
    Remark ticking() const;
    Remark sounding() const;

    Document& document;
    Performance& run;
    DeviceDesk& desk;
    std::vector<RoleFit> fits;
    Shape shape;
    std::vector<std::unique_ptr<Column>> columns, retired;   // a card may be changed by one of its own rows
    juce::Viewport scroll;
    juce::Component sheet;
    int refreshes = 0;
};

}   // namespace tactus::host
