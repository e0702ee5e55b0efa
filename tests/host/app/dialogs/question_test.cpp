// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/dialogs/question.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;

TEST_CASE ("the answers of a question are readable, in a row or, if they are long, one below the other", "[app][question]")
{
    DeskStage w;
    int answered = -1;
    const auto ask = [&] (const std::vector<juce::String>& labels) {
        std::vector<Question::Choice> choices;
        for (int i = 0; const auto& l : labels)
            choices.push_back ({ l, [&answered, i = i++] { answered = i; } });
        w.question.ask ("Where do you feel 'Two fingers'?", "Choose a device of this graph for each of its tools.", std::move (choices));
        OnStage::settle();
        std::vector<juce::Rectangle<int>> seen;
        for (auto* child : w.question.getChildren())
            if (auto* b = dynamic_cast<PlainButton*> (child))
            {
                CHECK (b->getWidth() >= b->widthFor());
                CHECK (w.question.getLocalBounds().contains (b->getBounds()));
                CHECK (std::ranges::none_of (seen, [&] (const auto& other) { return other.intersects (b->getBounds()); }));
                seen.push_back (b->getBounds());
            }
        REQUIRE (seen.size() == labels.size());
        return seen;
    };
    const auto row = ask ({ "Save", "Discard", "Cancel" });
    CHECK (row[0].getY() == row[2].getY());
    CHECK (row[0].getRight() < row[1].getX());
    w.question.cancel();
    CHECK (answered == 2);

    const auto list = ask ({ "thumb on stylus, index on its own device", "index on stylus, thumb on its own device", "Cancel" });
    CHECK (list[0].getBottom() < list[1].getY());
    w.key ("cursor down");
    w.key ("return");
    CHECK (answered == 1);
}

TEST_CASE ("a double click, or a key that is held, does not answer the next question, which appears at the same place", "[app][question]")
{
    DeskStage w;
    int first = 0, second = 0;
    const auto ask = [&] (const juce::String& title, std::function<void()> act) {
        w.question.ask (title, "It holds unsaved work.", { { "Discard", std::move (act) }, { "Later", {} } });
    };
    ask ("Discard the first?", [&] {
        ++first;
        ask ("Discard the second?", [&] { ++second; });
    });
    SECTION ("a double click")
    {
        auto* button = DeskStage::buttonIn (w.question, "Discard");
        REQUIRE (button != nullptr);
        const auto at = w.middleOf (*button);
        w.stage->doubleClick (at);
        CHECK (first == 1);
        CHECK (second == 0);
        CHECK (w.question.title() == "Discard the second?");
        CHECK (w.question.isOpen());
        w.stage->click (at);
    }
    SECTION ("a key")
    {
        const auto key = GENERATE (as<std::string> {}, "return", "spacebar");
        w.key (key);
        w.key (key);
        w.key (key);
        CHECK (first == 1);
        CHECK (second == 0);
        CHECK (w.question.isOpen());
        w.stage->keyUp();
        w.key (key);
    }
    CHECK (second == 1);
    CHECK_FALSE (w.question.isOpen());
}

TEST_CASE ("the title of a question is shown to its end, however long the name of a file in it is", "[app][question]")
{
    DeskStage w;
    const juce::String name = "a board of dry oak that was planed by hand and measured at three speeds in the winter.json";
    w.question.ask ("Replace " + name + "?", "It is in ~/Tactus already.", { { "Replace", {} }, { "Cancel", {} } });
    OnStage::settle();
    juce::String seen;
    for (const auto& t : tactus::host::test::readTexts (w.question))
        seen << t.text << " ";
    CHECK (seen.contains ("in the winter.json?"));
    CHECK (seen.contains ("It is in"));
}
