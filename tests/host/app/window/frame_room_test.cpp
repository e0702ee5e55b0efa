// SPDX-License-Identifier: GPL-3.0-or-later
// The place of a window that opens as large as the screen, with window managers that answer late, never, or otherwise.
#include <host/app/window/frame_room.hpp>

#include <catch2/catch.hpp>

using namespace tactus::host;
using Rectangle = juce::Rectangle<int>;

namespace
{
const Rectangle screen { 0, 0, 1024, 700 };
const juce::BorderSize<int> frame { 24, 1, 1, 1 };
const Rectangle inside { 1, 24, 1022, 675 };

/// A window manager that does what it is asked, until something else happens to the window.
struct Desk
{
    OpeningPlace place;
    Rectangle window = screen;
    std::optional<juce::BorderSize<int>> known;
    std::uint32_t now = 0xffffff00u;   // the counter of milliseconds starts again after 49 days
    int requests = 0;

    void wait (std::uint32_t ms, bool obeys = true)
    {
        for (const auto end = now + ms; now != end; now += 10)
            if (const auto to = place.next (window, screen, known, 1.0, now))
            {
                ++requests;
                if (obeys) window = *to;
            }
    }
};
}   // namespace

TEST_CASE ("a window goes beside its frame as soon as that is known, and then belongs to the user", "[app]")
{
    Desk desk;
    desk.wait (3000);
    CHECK (desk.requests == 0);
    desk.known = frame;
    desk.wait (20);
    CHECK (desk.window == inside);
    desk.wait (1500);
    desk.window = { 100, 100, 800, 600 };
    desk.wait (5000);
    CHECK (desk.window == Rectangle { 100, 100, 800, 600 });
    CHECK (desk.requests == 1);
}

TEST_CASE ("a window that a late window manager has resized still goes to its place", "[app]")
{
    Desk desk;
    desk.window = { 447, 273, 800, 600 };
    desk.known = frame;
    desk.wait (20);
    CHECK (desk.window == inside);
    desk.wait (500);
    desk.window = screen;   // an old request arrives
    desk.wait (500);
    CHECK (desk.window == inside);
    CHECK (desk.requests == 2);
}

TEST_CASE ("a window manager that has its own idea of a window's place keeps it", "[app]")
{
    Desk desk;
    desk.window = { 0, 0, 512, 700 };
    desk.known = frame;
    desk.wait (60'000, false);
    CHECK (desk.requests == OpeningPlace::most_requests);
}

TEST_CASE ("a window without a window manager stays as it is", "[app]")
{
    Desk desk;
    desk.wait (11'000);
    desk.window = { 0, 0, 800, 600 };
    desk.wait (1000);
    CHECK (desk.requests == 0);
}
