// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/plain_button.hpp>
#include <host/app/presets/picture_store.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/text/filled.hpp>

#include <functional>

namespace tactus::host
{

/// The start page: presets to feel immediately, and buttons to open or create a graph.
class WelcomePage final : public juce::Component
{
public:
    explicit WelcomePage (PictureStore&);
    ~WelcomePage() override;

    /// Shows a few of the presets as cards. The list of presets beside it has the recent files.
    void show (const std::vector<Preset>& presets, bool offers_tour = false);
    void refresh (bool has_device);   ///< call many times a second; true if a device of the user moves tools

    /// A preset is chosen: by the mouse, which is then the hand, or by a key.
    std::function<void (const std::filesystem::path&, bool by_pointer)> onFeel;
    std::function<void()> onNew, onOpen, onTour;

    const std::vector<Preset>& cards() const noexcept { return chosen; }

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress&) override;

private:
    juce::String invitation() const;

    class Card;

    PictureStore& pictures;
    int pictures_done = 0;
    bool is_by_device = false;
    std::vector<Preset> chosen;
    std::vector<std::unique_ptr<Card>> all;
    juce::Rectangle<int> title;
    PlainButton create { TRANS ("New empty graph") }, open { TRANS ("Open ...") }, tour { TRANS ("Show me around") };
};

/// The presets to start with, as different from each other as possible.
std::vector<Preset> firstOnes (const std::vector<Preset>&, std::size_t most);

}   // namespace tactus::host
