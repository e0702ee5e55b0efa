// SPDX-License-Identifier: GPL-3.0-or-later
// What happens before the window closes: it asks about each thing that would be lost, one after the other.
#include "main_view.hpp"

#include <host/app/text/filled.hpp>

namespace tactus::host
{

void MainView::closeWhenSaved (std::function<void()> close)
{
    files.whenSaved (TRANS ("Save changes to '%1' before closing Tactus?"), [this, close = std::move (close)] { closeWithTake (close); });
}

void MainView::closeWithTake (const std::function<void()>& close)
{
    const auto end = [this, close] {
        run().letGo();
        files.end();
        close();
    };
    if (! takes.isUnsaved()) return end();
    const auto length = juce::String (takes.take().seconds(), 1);
    question.ask (filled (TRANS ("Save the take of %1 s before closing Tactus?"), length),
                  TRANS ("Nothing has been made of it, and it is kept only while Tactus is open. `tactus capture` makes clips, gestures and tests of a saved take."),
                  { { TRANS ("Save"), [this, end] { takes.save (end); } },
                    { TRANS ("Don't save"), end },
                    { TRANS ("Cancel"), {} } });
}

void MainView::closeSuddenly()
{
    run().letGo();
    files.endSuddenly();
}

}   // namespace tactus::host
