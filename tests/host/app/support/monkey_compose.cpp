// SPDX-License-Identifier: GPL-3.0-or-later
// How the monkey composes: presets as layers, modulators, snapshots, stems.
#include "monkey.hpp"

#include <host/app/inspector/blocks/depth_ring.hpp>
#include <host/app/layers/fader.hpp>
#include <host/app/problems/fixes.hpp>
#include <host/app/problems/unfelt.hpp>

namespace tactus::host::test
{

std::string Monkey::compose()
{
    const auto say = [&] (const juce::String& key, const std::string& text) {
        stage->key (key);
        stage->type (text);
        stage->key (juce::String ("return"));
        return key.toStdString() + ": " + text;
    };
    const auto preset = [&] {
        auto name = juce::String (oneOf (shipped).stem().string()).replaceCharacter ('_', ' ');
        return name.substring (0, 1).toUpperCase().toStdString() + name.substring (1).toStdString();
    };
    const bool is_large = view->document().graph().root.nodes.size() + view->document().graph().graphs.size() > 60;
    switch (upTo (8))
    {
    case 0:
    case 1:
        if (is_large) return "enough";
        return say ("ctrl + k", "Add " + preset() + (upTo (2) == 0 ? "" : ": all but its walls"));
    case 2:
        if (is_large) return "enough";
        focusCanvas();
        return say ("spacebar", preset());
    case 3:
        if (is_large) return "enough";
        focusCanvas();
        for (const auto* key : { "ctrl + a", "ctrl + c", "ctrl + shift + v" })
            stage->key (juce::String (key));
        return "copy all, paste as a layer";
    case 4:
    {
        std::vector<std::pair<const SceneNode*, const FacePort*>> params;
        const SceneNode* source = nullptr;
        for (const auto& n : view->canvas().scene().nodes())
        {
            if (n.type == "signal.lfo" || n.type == "signal.envelope") source = &n;
            for (const auto& p : n.face->params)
                params.emplace_back (&n, &p);
        }
        if (source == nullptr)
        {
            view->canvas().commands().addNodeAt ("signal.lfo", NodeRequest { { part() * 800.0f, part() * 600.0f } });
            return "add an oscillator";
        }
        if (params.empty()) return "nothing to modulate";
        const auto& [node, port] = oneOf (params);
        const auto from = view->canvas().scene().findPort ({ source->id, Role::output, "out" });
        const auto to = view->canvas().scene().findPort ({ node->id, Role::param, port->id });
        if (! from || ! to) return "no such port";
        const auto text = "modulate " + node->name + "." + port->id;
        view->canvas().select ({ node->id });
        view->canvas().commands().join (from, to);
        return text;
    }
    case 5:
        for (const auto& m : unfelt (view->document().graph(), catalogue()))
            if (m.id.starts_with ("mixer/"))
                if (auto fix = fixOf (view->document().graph(), m))
                {
                    view->document().perform (std::move (fix->command));
                    return fix->label;
                }
        return "all is mixed";
    case 6:
        return say ("ctrl + k", upTo (2) == 0 ? "Randomise" : "Morph");
    default:
        if (upTo (4) != 0) return "no stems";
        return say ("ctrl + k", "Export stems");
    }
}

std::string Monkey::turnDepth()
{
    std::vector<juce::Component*> all;
    const auto look_in = [&] (auto&& self, juce::Component& c) -> void {
        if (! c.isShowing()) return;
        const bool is_knob = c.getParentComponent() == &view->part<Inspector>().knobs();
        if (is_knob || dynamic_cast<DepthRing*> (&c) != nullptr || dynamic_cast<Fader*> (&c) != nullptr) all.push_back (&c);
        for (auto* child : c.getChildren())
            self (self, *child);
    };
    look_in (look_in, *view);
    if (all.empty()) return "no dial";
    auto& dial = *oneOf (all);
    const auto name = dial.getTitle().toStdString();
    const auto at = in (dial);
    return "dial " + name + ": " + dragFromTo (at, at.translated (part() * 20.0f - 10.0f, part() * 200.0f - 100.0f));
}

}   // namespace tactus::host::test
