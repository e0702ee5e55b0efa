// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/plain_button.hpp>
#include <host/app/presets/preset_list.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace tactus::host
{

/// The graphs to begin an own effect with, in the order in which they are offered. They are in the folder `templates` of the presets.
std::vector<Preset> templatesIn (const std::filesystem::path& presets, const Catalogue&);

/// A row of buttons on an empty canvas, one for each template.
class TemplateRow final : public juce::Component
{
public:
    TemplateRow() { setInterceptsMouseClicks (false, true); }

    int heightFor (int width) const;   ///< with as many lines of buttons as they need

    void show (const std::vector<Preset>&);
    const std::vector<Preset>& all() const noexcept { return templates; }

    std::function<void (const Preset&)> onChoose;

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    std::vector<std::vector<PlainButton*>> linesFor (int width) const;

    std::vector<Preset> templates;
    std::vector<std::unique_ptr<PlainButton>> buttons;
};

}   // namespace tactus::host
