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
    files.whenSaved (TRANS ("Save changes to '%1' before closing Tactus?"), [this, close = std::move (close)] { closeWithTake (close); });
}

void MainView::closeWithTake (const std::function<void()>& close)
{
    const auto unsaved = takes.unsaved();
    if (unsaved.empty()) return closeWithFilm (close);
    const auto length = juce::String (unsaved.front()->length_s, 1);
    question.ask (unsaved.size() == 1 ? filled (TRANS ("Save the take of %1 s before closing Tactus?"), length)
                                      : filled (TRANS ("Save %1 takes before closing Tactus?"), unsaved.size()),
                  TRANS ("Takes that you have not used are kept only while Tactus is open. `tactus capture` makes clips, gestures and tests from a "
                         "saved take."),
                  { { TRANS ("Save"), [this, close] { takes.save ([this, close] { closeWithFilm (close); }); } },
                    { TRANS ("Don't save"), [this, close] { closeWithFilm (close); } },
                    { TRANS ("Cancel"), {} } });
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
        close_after_film = [this, close, end, version = edited.version(), take = takes.take().recorded()] {
            endTyping();
            version == edited.version() && take == takes.take().recorded() ? end() : closeWhenSaved (close);
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
    files.endSuddenly (takes.leave());
}

}   // namespace tactus::host
