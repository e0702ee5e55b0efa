// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/presets/picture_store.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/window/plain_button.hpp>

#include <functional>

namespace tactus::host
{

/// What one sees while nothing is open: presets to feel at once, and the ways to begin.
class WelcomePage final : public juce::Component
{
public:
    explicit WelcomePage (PictureStore&);
    ~WelcomePage() override;

    /// A few of these become cards; `recent` are files.
    void show (const std::vector<Preset>& presets, const std::vector<std::filesystem::path>& recent);
    void refresh();   ///< many times a second

    std::function<void (const std::filesystem::path&)> onFeel, onOpenFile;
    std::function<void()> onNew, onOpen;

    const std::vector<Preset>& cards() const noexcept { return chosen; }

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    class Card;
    class RecentFile;

    PictureStore& pictures;
    int pictures_done = 0;
    std::vector<Preset> chosen;
    std::vector<std::unique_ptr<Card>> all;
    std::vector<std::unique_ptr<RecentFile>> files;
    juce::Rectangle<int> title, recent_title;
    PlainButton create { "New empty graph" }, open { "Open a file" };
};

/// Those to begin with, of what there is: as different from each other as can be.
std::vector<Preset> firstOnes (const std::vector<Preset>&, std::size_t most);

}   // namespace tactus::host
