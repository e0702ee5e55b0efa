// SPDX-License-Identifier: GPL-3.0-or-later
#include "closing.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
juce::String waitingText (double part)
{
    return filled (TRANS ("%1 % of the film is saved. Tactus closes when it is complete."), juce::roundToInt (std::floor (99.0 * part)));
}
}   // namespace

void Closing::whenSaved (std::function<void()> close)
{
    close_after_film = nullptr;   // the questions start again
    parts.files.whenSaved (TRANS ("Save changes to '%1' before closing Tactus?"), [this, close = std::move (close)] { askPanels (0, close); });
}

/// Asks about what each panel would lose, from this one on.
void Closing::askPanels (std::size_t first, const std::function<void()>& close)
{
    if (first == parts.panels.size()) return askAboutFilm (close);
    const auto next = [this, first, close] { askPanels (first + 1, close); };
    parts.panels[first].panel.close ? parts.panels[first].panel.close (next) : next();
}

/// Another value once there is something else that panels ask about.
std::vector<const void*> Closing::work() const
{
    std::vector<const void*> all;
    for (const auto& p : parts.panels)
        if (p.panel.work) all.push_back (p.panel.work());
    return all;
}

void Closing::askAboutFilm (const std::function<void()>& close)
{
    auto& film = parts.hand.film();
    const auto end = [this, close] {
        parts.playback.run().letGo();
        parts.files.end();
        close();
    };
    if (film.isSaving())
    {
        // Once it is saved, asks again only about what was changed meanwhile.
        close_after_film = [this, close, end, version = parts.edited.version(), before = work()] {
            endTyping();
            version == parts.edited.version() && before == work() ? end() : whenSaved (close);
        };
        parts.question.ask (TRANS ("A film is being saved"), waitingText (film.progress()),
                            { { TRANS ("Close when it is saved"), [this] { parts.status.notify (TRANS ("Tactus closes when the film is saved.")); } },
                              { TRANS ("Discard the film"), end },
                              { TRANS ("Cancel"), [this] { close_after_film = nullptr; } } });
        return;
    }
    const bool is_filming = film.filmed() > 0.0;
    if (! is_filming && ! (film.unsaved() > 0.0)) return end();
    const auto save = [this, close, is_filming] {
        const auto ask_again = [this, close] { askAboutFilm (close); };
        is_filming ? parts.hand.film().end (ask_again) : parts.hand.film().saveKept (ask_again);
    };
    parts.question.ask (filled (TRANS ("Save the film of %1 s before closing Tactus?"), juce::String (is_filming ? film.filmed() : film.unsaved(), 0)),
                        is_filming ? TRANS ("It is being filmed now.") : TRANS ("It is not saved yet."),
                        { { TRANS ("Save"), save }, { TRANS ("Don't save"), end }, { TRANS ("Cancel"), {} } });
}

void Closing::poll()
{
    if (! close_after_film) return;
    const auto& film = parts.hand.film();
    const bool asks = parts.question.isOpen() && parts.question.title() == TRANS ("A film is being saved");
    if (film.isSaving())
    {
        if (asks) parts.question.say (waitingText (film.progress()));
        return;
    }
    const auto close = std::exchange (close_after_film, nullptr);
    if (asks) parts.question.cancel();
    if (film.isSaved()) close();
}

void Closing::atOnce()
{
    parts.playback.run().letGo();
    bool has_left = false;
    for (const auto& p : parts.panels)
        has_left = (p.panel.leave && p.panel.leave()) || has_left;
    parts.files.endSuddenly (has_left);
}

}   // namespace tactus::host
