// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "panel_layout.hpp"
#include "status_line.hpp"

#include <host/app/desk/panel.hpp>
#include <host/app/dialogs/file_dialogs.hpp>
#include <host/app/dialogs/shade.hpp>
#include <host/app/files/files.hpp>
#include <host/app/inspector/inspector.hpp>
#include <host/app/palette/palette.hpp>
#include <host/app/run/views/live_feed.hpp>
#include <host/app/run/views/safety_strip.hpp>
#include <host/app/stems/stem_export.hpp>
#include <host/app/storage/settings_saver.hpp>
#include <host/app/top_bar/top_bar.hpp>
#include <host/app/welcome/help_panel.hpp>
#include <host/app/welcome/template_row.hpp>
#include <host/app/welcome/tour.hpp>
#include <host/app/welcome/welcome_page.hpp>

#include <vector>

namespace tactus::host
{

/// The area in which menus open: below the strip, so that STOP stays within reach. An open menu gives it its keys first, see Look. [main thread]
class MenuArea final : public juce::Component, public juce::KeyListener
{
public:
    std::function<bool (const juce::KeyPress&)> onKey;   ///< must be set; true if the menu must not get the key

    using juce::Component::keyPressed;
    bool keyPressed (const juce::KeyPress& key, juce::Component*) override { return onKey (key); }
};

/// A panel of the list, and where it is.
struct AttachedPanel
{
    Panel panel;
    juce::Component& component;
    bool covers;   ///< it covers the window while it is visible; else it is a tab
};

/// The parts of a window: first what they show, then the components around the canvas, and the pages that may lie over it. The classes of this folder work
/// on them. [main thread]
struct WindowParts
{
    WindowParts (const Catalogue&, juce::Component& window, Files::Callbacks);

    /// Makes the panels of the list, and adds all parts to the window.
    void add();

    /// The panel that covers the window; null: none.
    const AttachedPanel* openCover() const;

    /// Brings a part into view: in a small window, its page.
    void turnTo (const juce::Component& part) { layout.turnTo (part); }

    /// Shows the datasheet of the selected node, or the list of keys.
    void showHelp();

    void applyTheme();
    void applyFusion();

    /// True if the session binds a role of the graph to a device that moves a tool.
    bool hasBoundRole() const;

    const Catalogue& catalogue;
    juce::Component& window;
    Settings settings;
    SettingsSaver saver { settings };
    bool light = false;   // the current theme; settings.light applies at the next start
    PictureStore pictures { catalogue };
    Question question;
    StatusLine status;
    Document edited { graph::Graph {} };
    Sound sound;
    DeviceSetup device_setup;
    Files files;         // declared before the run, so that an edit is autosaved before it runs
    Playback playback;   // declared before the panels that show it
    LimitWatch limits { edited, device_setup, playback.run(), catalogue };
    SafetyStrip strip { playback };
    HandPanel hand { playback, sound };
    Canvas patching { edited, catalogue };
    Desk desk { catalogue, edited, patching, playback, device_setup, limits, settings, pictures, question };
    StemExport stems { desk };
    TopBar top { desk };
    Inspector inspector { edited, catalogue };
    PanelLayout layout { window, desk, hand, inspector };
    LiveFeed live { patching, playback.run() };
    std::vector<AttachedPanel> panels;
    TemplateRow templates;
    Palette palette;
    WelcomePage welcome { pictures };
    HelpPanel help { catalogue };
    Tour tour;
    Shade shade;
    MenuArea menus;
    FileDialogs dialogs { window, SafetyStrip::height, patching, question, settings.folders };
};

}   // namespace tactus::host
