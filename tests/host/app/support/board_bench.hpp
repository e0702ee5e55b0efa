// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wait_for.hpp"

#include <host/app/devices_panel/devices_panel.hpp>
#include <host/app/film/film_tape.hpp>

#include <catch2/catch.hpp>

#include <string>
#include <utility>

namespace tactus::host::test
{

/// A rig with a board, whose stylus the session binds to a simulated PHANTOM 1.0 in a hand that strokes 1 mm above where the board is.
template <typename Rig>
struct BoardBench : Rig
{
    BoardBench (const char* preset, std::string of) : Rig (preset, 1600, 1000), role (std::move (of)) {}
    virtual ~BoardBench() = default;
    BoardBench (const BoardBench&) = delete;
    BoardBench& operator= (const BoardBench&) = delete;

    const std::string role;

    virtual DevicesPanel& panel() = 0;
    virtual LiveRun& run() = 0;
    virtual void showPanel() {}   // brings it to the front

    void bind()
    {
        panel().bindings().bind (role, "simulated PHANTOM 1.0");
        set ("/hand", R"({"stiffness": 400, "damping": 4, "path": "circle"})");
        set ("/guard", R"({"max_force": "4 N", "ramp": "50 ms"})");
        REQUIRE (binding().contains ("hand"));
        this->click ("3D");
        run().film().keep (FilmTape::longest_s);
    }

    void set (const char* pointer, const char* text) { panel().bindings().setPart (role, pointer, text); }
    Json saved() const { return Json::parse (this->home.textOf ("session.json")); }
    Json binding() const { return saved()["roles"][role]; }
    Json workspace() const { return binding().value ("workspace", Json()); }

    template <typename F>
    bool until (F&& isSo)
    {
        return waitFor (isSo, 5);
    }
    bool isPushing()
    {
        return until ([&] { return run().tool() && force() > 0.0 && ticks() > 0; });
    }
    double force() { return run().tool() ? run().tool()->force.norm() : 0.0; }
    Vec3 origin() { return run().workspaceOf (role)->offset; }
    std::uint64_t ticks() { return run().film().end(); }

    /// The field in the panel with this label, scrolled to where the mouse can reach it.
    juce::TextEditor& field (const juce::String& label)
    {
        showPanel();
        auto* found = dynamic_cast<juce::TextEditor*> (Rig::titledIn (panel(), label));
        REQUIRE (found != nullptr);
        const auto isReached = [&] {
            const auto* at = this->stage->getComponentAt (this->middleOf (*found).roundToInt());
            return at != nullptr && (at == found || found->isParentOf (at));
        };
        for (int i = 0; i < 100 && ! isReached(); ++i)   // from the top downwards
        {
            this->stage->wheel (this->stage->getLocalPoint (&panel(), juce::Point<float> (40.0f, 60.0f)), i == 0 ? 100.0f : -0.1f, true);
            Rig::settle (2);
        }
        REQUIRE (isReached());
        return *found;
    }
};

}   // namespace tactus::host::test
