// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/window_rig.hpp"

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

TEST_CASE ("an edge that was dragged beyond its limit follows the next drag at once", "[app][panels]")
{
    WindowRig w ("dry_wood.json", 1600, 900);
    std::vector<Splitter*> edges;
    for (auto* child : w.view->getChildren())
        if (auto* edge = dynamic_cast<Splitter*> (child); edge != nullptr && edge->isShowing()) edges.push_back (edge);
    REQUIRE (edges.size() == 4);
    for (auto* edge : edges)
    {
        const bool is_level = edge->getWidth() > edge->getHeight();
        INFO ((is_level ? "level, y " : "upright, x ") << (is_level ? edge->getY() : edge->getX()));
        const auto place = [&] { return is_level ? edge->getBounds().getCentreY() : edge->getBounds().getCentreX(); };
        const auto drag = [&] (int way) {
            const auto from = w.middleOf (*edge);
            const auto moved = static_cast<float> (place() + way);
            const auto to = is_level ? from.withY (moved) : from.withX (moved);
            const auto before = place();
            w.stage->drag (from, to);
            WindowRig::settle();
            return place() - before;
        };
        // Away from the panel that it sizes, as far as the mouse gets.
        const int room = is_level ? w.view->getHeight() : w.view->getWidth();
        const bool grows_up = is_level || place() > w.view->getWidth() / 2;
        drag (grows_up ? 10 - place() : room - 10 - place());
        const int back = grows_up ? 40 : -40;
        CHECK (std::abs (drag (back) - back) <= 2);
        w.key ("ctrl + z");
        w.key ("ctrl + z");
    }
}
