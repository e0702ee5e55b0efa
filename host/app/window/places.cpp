// SPDX-License-Identifier: GPL-3.0-or-later
#include "places.hpp"

#include <host/app/look/tabs.hpp>

namespace tactus::host
{

namespace
{
Json pixel (juce::Point<float> on_screen)
{
    const auto scale = juce::Desktop::getInstance().getGlobalScaleFactor();
    return Json::array ({ juce::roundToInt (on_screen.x * scale), juce::roundToInt (on_screen.y * scale) });
}

std::string nameOf (const juce::Component& c)
{
    const auto* button = dynamic_cast<const juce::Button*> (&c);
    if (button != nullptr && button->getButtonText().isNotEmpty()) return button->getButtonText().toStdString();
    const auto* editor = dynamic_cast<const juce::TextEditor*> (&c);
    if (editor != nullptr && c.getTitle().isEmpty()) return editor->getTextToShowWhenEmpty().toStdString();
    return (c.getTitle().isNotEmpty() ? c.getTitle() : c.getName()).toStdString();
}

void addNamed (const juce::Component& c, Json& into)
{
    if (! c.isVisible()) return;
    if (const auto name = nameOf (c); ! name.empty()) into[name] = pixel (c.getScreenBounds().toFloat().getCentre());
    if (const auto* tabs = dynamic_cast<const Tabs*> (&c))
        for (const auto& [name, place] : tabs->titles())
            if (! place.isEmpty()) into[name.toStdString()] = pixel (c.localPointToGlobal (place.getCentre()));
    for (const auto* child : c.getChildren())
        addNamed (*child, into);
}
}   // namespace

Json placesOf (juce::Component& window, const Canvas& canvas)
{
    auto places = Json::object();
    const auto& scene = canvas.scene();
    const auto put = [&] (const std::string& name, juce::Point<float> at) { places[name] = pixel (canvas.localPointToGlobal (canvas.view().toPixels (at))); };
    for (const auto& n : scene.nodes())
    {
        put (n.name, n.at + juce::Point<float> (n.box.width / 2, Box::header_height / 2));
        for (const auto& s : n.box.sockets)
        {
            put (n.name + '.' + s.port->id, n.placeOf (s));
            if (s.port->role == Role::param) put (n.name + '.' + s.port->id + " value", n.at + juce::Point<float> (n.box.width - 20.0f, s.at.y));
        }
    }
    for (const auto& w : scene.wires())
    {
        const auto path = w.path();
        put (w.text, path.getPointAlongPath (path.getLength() / 2));
    }
    for (std::size_t i = 0; i < scene.notes().size(); ++i)
        put ("note " + std::to_string (i), scene.notes()[i].area.getTopLeft() + juce::Point<float> (12.0f, 10.0f));
    auto named = Json::object();
    addNamed (window, named);
    places["window"] = std::move (named);
    return places;
}

}   // namespace tactus::host
