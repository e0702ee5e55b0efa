// SPDX-License-Identifier: GPL-3.0-or-later
// What happens before the window closes: it asks about each thing that would be lost, one after the other.
#include "main_view.hpp"

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

void MainView::closeWhenSaved (std::function<void()> close)
{
    close_after_film = nullptr;   // the questions start again
    files.whenSaved (TRANS ("Save changes to '%1' before closing Tactus?"), [this, close = std::move (close)] { closePanels (0, close); });
}

/// Asks about what each panel would lose, from this one on.
void MainView::closePanels (std::size_t first, const std::function<void()>& close)
{
    if (first == panels.size()) return closeWithFilm (close);
    const auto next = [this, first, close] { closePanels (first + 1, close); };
    panels[first].panel.close ? panels[first].panel.close (next) : next();
}

std::vector<const void*> MainView::work() const
{
    std::vector<const void*> all;
    for (const auto& p : panels)
        if (p.panel.work) all.push_back (p.panel.work());
    return all;
}

void MainView::closeWithFilm (const std::function<void()>& close)
{
    auto& film = hand.film();
    const auto end = [this, close] {
        run().letGo();
        files.end();
        close();
    };
    if (film.isSaving())
    {
        // Once it is saved, asks again only about what was changed meanwhile.
        close_after_film = [this, close, end, version = edited.version(), before = work()] {
            endTyping();
            version == edited.version() && before == work() ? end() : closeWhenSaved (close);
        };
        question.ask (TRANS ("A film is being saved"), waitingText (film.progress()),
                      { { TRANS ("Close when it is saved"), [this] { status.notify (TRANS ("Tactus closes when the film is saved.")); } },
                        { TRANS ("Discard the film"), end },
                        { TRANS ("Cancel"), [this] { close_after_film = nullptr; } } });
    }
    else if (film.filmed() > 0.0)
        question.ask (filled (TRANS ("Save the film of %1 s before closing Tactus?"), juce::String (film.filmed(), 0)), TRANS ("It is being filmed now."),
                      { { TRANS ("Save"), [this, close] { hand.film().end ([this, close] { closeWithFilm (close); }); } },
                        { TRANS ("Don't save"), end },
                        { TRANS ("Cancel"), {} } });
    else if (film.unsaved() > 0.0)
        question.ask (filled (TRANS ("Save the film of %1 s before closing Tactus?"), juce::String (film.unsaved(), 0)), TRANS ("It is not saved yet."),
                      { { TRANS ("Save"), [this, close] { hand.film().saveKept ([this, close] { closeWithFilm (close); }); } },
                        { TRANS ("Don't save"), end },
                        { TRANS ("Cancel"), {} } });
    else
        end();
}

/// Shows how much of the film is saved, and closes when it is. If that fails, the window stays open and says why.
void MainView::attendFilm()
{
    if (! close_after_film) return;
    const auto& film = hand.film();
    const bool asks = question.isOpen() && question.title() == TRANS ("A film is being saved");
    if (film.isSaving())
    {
        if (asks) question.say (waitingText (film.progress()));
        return;
    }
    const auto close = std::exchange (close_after_film, nullptr);
    if (asks) question.cancel();
    if (film.isSaved()) close();
}

void MainView::closeSuddenly()
{
    run().letGo();
    bool has_left = false;
    for (const auto& p : panels)
        has_left = (p.panel.leave && p.panel.leave()) || has_left;
    files.endSuddenly (has_left);
}

}   // namespace tactus::host
