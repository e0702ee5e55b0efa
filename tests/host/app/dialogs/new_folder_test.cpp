// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/environment.hpp"
#include "host/app/support/screen.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/dialogs/file_dialog_parts.hpp>

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tactus::host;
using tactus::host::test::onScreen;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

TEST_CASE ("on a screen: where a new folder is named", "[.screen]")
{
    const TemporaryFolder mine;
    const tactus::host::test::Environment own_graphs { "TACTUS_GRAPHS", mine.path() };
    {
        WindowRig w ("dry_wood.json");
        w.key ("ctrl + shift + s");
        auto* dialog = juce::Component::getCurrentlyModalComponent();
        REQUIRE (dialog != nullptr);
        w.click ("New Folder");
        const auto asked = [&] { return juce::Component::getCurrentlyModalComponent(); };
        REQUIRE (waitFor ([&] { return asked() != dialog && asked()->getParentComponent() == w.view.get(); }));
        CHECK_FALSE (asked()->isOnDesktop());
        CHECK (asked()->getBounds().getCentre().getDistanceFrom (dialog->getBounds().getCentre()) <= 1);
        CHECK (w.view->getIndexOfChildComponent (asked()) > w.view->getIndexOfChildComponent (dialog));
        REQUIRE (waitFor ([&] { return WindowRig::focused() == nameField (*asked()); }));
        w.key ("escape");
        CHECK (waitFor ([&] { return asked() == dialog; }));
        w.click ("New Folder");
        REQUIRE (waitFor ([&] { return asked() != dialog && WindowRig::focused() == nameField (*asked()); }));
        w.stage->type ("oak");
        w.key ("return");
        CHECK (waitFor ([&] { return std::filesystem::is_directory (mine / "oak"); }));
        REQUIRE (waitFor ([&] { return asked() == dialog; }));
        w.key ("escape");
        CHECK (waitFor ([&] { return asked() == nullptr; }));
    }
}

TEST_CASE ("the name of a new folder is asked for in the window, over the dialog for files", "[app][files]")
{
    onScreen ("on a screen: where a new folder is named");
}
