// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/inspector/inspector.hpp>
#include <host/app/model/readable.hpp>

#include <tactus/file/graph_file.hpp>

#include <string>
#include <vector>

namespace tactus::test
{

/// An inspector without a window.
struct InspectorRig
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    host::Look look;
    std::unique_ptr<host::Document> document;
    std::unique_ptr<host::Inspector> inspector;
    std::vector<std::string> hints;

    explicit InspectorRig (graph::Graph g)
    {
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        document = std::make_unique<host::Document> (std::move (g));
        inspector = std::make_unique<host::Inspector> (*document, catalogue());
        inspector->onHint = [this] (const juce::String& t) { hints.push_back (t.toStdString()); };
        inspector->setBounds (0, 0, 304, 600);
        inspector->setVisible (true);
    }

    explicit InspectorRig (const std::string& preset) : InspectorRig (loadGraph (TACTUS_SOURCE_DIR "/graphs/" + preset).graph) {}

    ~InspectorRig()
    {
        inspector.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }

    const graph::Node& node (const std::string& name) const { return *document->graph().root.find (name); }
    void select (const std::string& name) { inspector->inspect ({}, { node (name).id }); }

    /// All components of a type, from top to bottom.
    template <typename T>
    std::vector<T*> all() const
    {
        std::vector<T*> found;
        collect (inspector->shown(), found);
        return found;
    }

    /// The field of type T in the row with that label.
    template <typename T>
    T* in (const std::string& label) const
    {
        for (auto* row : all<host::SetRow>())
            if (const auto shown = row->label().toStdString(); shown == label || shown == host::readable (label))
            {
                std::vector<T*> found;
                collect (*row, found);
                if (! found.empty()) return found.front();
            }
        return nullptr;
    }

    /// True if no component is wider than its parent.
    bool fits() const { return fits (inspector->shown()); }

    template <typename T>
    static void collect (juce::Component& c, std::vector<T*>& found)
    {
        if (auto* t = dynamic_cast<T*> (&c)) found.push_back (t);
        for (auto* child : c.getChildren())
            collect (*child, found);
    }

private:
    static bool fits (const juce::Component& c)
    {
        for (const auto* child : c.getChildren())
        {
            if (! child->isVisible()) continue;
            if (dynamic_cast<const juce::TextEditor*> (child) != nullptr) continue;   // a text editor scrolls
            if (child->getX() < 0 || child->getRight() > c.getWidth()) return false;
            if (! fits (*child)) return false;
        }
        return true;
    }
};

}   // namespace tactus::test
