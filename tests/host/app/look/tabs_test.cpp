// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/look/look.hpp>
#include <host/app/look/tabs.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus::host;

TEST_CASE ("the titles of tabs are all in the row or in its menu, whatever the width", "[app][small]")
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    {
        Tabs tabs;
        const auto widthOf = [&] (const juce::String& title) { return look.font (13.0f, true).getStringWidthFloat (title); };
        const auto underlined = [&] (Tabs& row) {
            const auto picture = row.createComponentSnapshot (row.getLocalBounds().withHeight (Tabs::row_height));
            float count = 0.0f;
            for (int x = 0; x < picture.getWidth(); ++x)
                if (picture.getPixelAt (x, Tabs::row_height - 2) == look.theme().accent) ++count;
            return count;
        };
        for (const char* name : { "Scopes", "Take", "Layers", "Devices", "Problems 12" })
            tabs.add (name, std::make_unique<juce::Component>());
        for (int width = 120; width < 600; width += 13)
            for (int current = 0; current < 5; ++current)
            {
                tabs.setSize (width, 100);
                tabs.show (current);
                float right = 0.0f;
                bool is_any_hidden = false;
                for (const auto& [name, place] : tabs.titles())
                {
                    is_any_hidden = is_any_hidden || place.isEmpty();
                    if (place.isEmpty()) continue;
                    CHECK (place.getX() >= right);
                    right = place.getRight();
                }
                INFO (width << ", tab " << current);
                CHECK (std::abs (underlined (tabs) - widthOf (tabs.titles()[static_cast<std::size_t> (current)].first)) <= 2.0f);
                CHECK_FALSE (tabs.titles()[static_cast<std::size_t> (current)].second.isEmpty());
                CHECK (right <= static_cast<float> (width) - (is_any_hidden ? 28.0f : 0.0f));
                if (width >= 420) CHECK_FALSE (is_any_hidden);
            }
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}
