// SPDX-License-Identifier: GPL-3.0-or-later
// The layers in the window.
#include "layers_panel.hpp"

#include <host/app/desk/panel.hpp>
#include <host/app/inspector/settings/setting_editor.hpp>

namespace tactus::host
{

Panel layersPanel (Desk& desk)
{
    auto made = std::make_unique<LayersPanel> (desk.document, desk.playback.run().traces(), desk.types);
    auto* layers = made.get();
    layers->onHint = [&desk] (const juce::String& text) { desk.hint (text); };
    layers->onSelect = [&desk] (const std::string& patch, graph::Id node) { desk.show (patch, node); };
    layers->completeRemoval = [&desk] (graph::Batch removal) -> graph::Command {
        return desk.canvas.completeRemoval ? desk.canvas.completeRemoval (std::move (removal)) : graph::Command (std::move (removal));
    };
    layers->commandToMix = [&desk] (const UnmixedSignal& u) { return desk.layerOf (u.sink, u.port); };
    layers->onChooseClip = [&desk] (auto chosen) { desk.chooseInput (clip_patterns, {}, std::move (chosen)); };
    layers->onAdded = [&desk] (const std::string& patch, graph::Id node) {
        desk.canvas.show (patch, node);
        desk.canvas.endEdit();   // undoing the edit brings back the view from before
    };
    layers->onPresetDropped = [&desk] (const std::filesystem::path& file) {
        desk.canvas.onGraphDropped (file, desk.canvas.commands().pointerOrCentre());
    };
    desk.addClip = [&desk, layers] (const std::filesystem::path& file, std::optional<double> gain) {
        desk.toFront (*layers);
        layers->addClip (file, gain);
    };
    const auto fields = [&desk, layers] {
        std::vector<Panel::Action> all;
        for (std::size_t i = 0; i < layers->layers(); ++i)
            all.push_back ({ layers->layer (i).gainField().getTitle(), TRANS ("A layer of the mixer: type its gain, or level"), [&desk, layers, i] {
                                desk.toFront (*layers);
                                if (i < layers->layers()) layers->layer (i).gainField().openEditor();
                            } });
        auto* mix = layers->mix();
        for (std::size_t i = 0; mix != nullptr && i < mix->fields().size(); ++i)
            all.push_back ({ mix->fields()[i]->getTitle(), TRANS ("The mix: type a number"), [&desk, layers, i] {
                                desk.toFront (*layers);
                                if (auto* now = layers->mix()) now->fields()[i]->openEditor();
                            } });
        return all;
    };
    return { .name = TRANS ("Layers"), .component = std::move (made), .actions = fields, .refresh = [layers] { layers->refresh(); } };
}

}   // namespace tactus::host
