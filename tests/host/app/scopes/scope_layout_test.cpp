// SPDX-License-Identifier: GPL-3.0-or-later
// Scopes in panels of any size, and a panel without scopes.
#include "scope_bench.hpp"

#include "host/app/support/seen_text.hpp"

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::Bench;

TEST_CASE ("scopes in a narrow panel keep a readable width, and a new one is scrolled into view", "[app][scopes]")
{
    Bench b;
    for (const int width : { 240, 480, 640, 1600 })
    {
        b.panel->setSize (width, 180);
        b.panel->showOwn();
        while (b.panel->shown().size() < 6)
        {
            const auto& added = b.panel->add (ScopeKind::spectrum);
            const auto place = b.panel->getLocalArea (&added, added.getLocalBounds());
            INFO (width << ": " << place.toString());
            CHECK (b.panel->getLocalBounds().contains (place));
        }
        int right = 0;
        for (const auto& v : b.panel->shown())
        {
            CHECK (v->getWidth() >= 199);
            CHECK (v->getX() >= right);   // none covers another one
            right = v->getRight();
        }
        b.panel->setSize (1600, 180);
        for (const auto& v : b.panel->shown())
            CHECK (b.panel->getLocalBounds().contains (b.panel->getLocalArea (v.get(), v->getLocalBounds())));   // there is room for all
    }
}

TEST_CASE ("scopes in a low panel keep a readable height, and scroll", "[app][scopes]")
{
    Bench b;
    for (const int height : { 40, 76, 126, 166, 232, 400 })
        for (const int width : { 320, 1600 })
        {
            INFO (width << " x " << height);
            b.panel->setSize (width, height);
            for (const auto& v : b.panel->shown())
                CHECK (v->getHeight() >= 140);
            const auto* view = b.panel->shown().front()->findParentComponentOfClass<juce::Viewport>();
            if (height >= 232) CHECK (view->getViewHeight() == view->getViewedComponent()->getHeight());   // nothing to scroll
        }
}

TEST_CASE ("scopes: without a graph, the panel does not speak of wires to select", "[app][scopes]")
{
    Bench b;
    b.document.open ({}, {}, "new graph");
    b.panel->showOwn();
    REQUIRE (b.panel->shown().empty());
    juce::String all;
    for (const auto& t : tactus::host::test::readTexts (*b.panel))
        all << t.text << ' ';
    CHECK (all.contains ("Open a preset"));
    CHECK_FALSE (all.contains ("press P"));
}
