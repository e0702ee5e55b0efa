// SPDX-License-Identifier: GPL-3.0-or-later
// Takes in the window.
#include "take_panel.hpp"

#include <host/app/desk/panel.hpp>
#include <host/app/desk/save_clip.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

namespace
{
void askToSave (const Desk& desk, TakePanel& takes, const std::function<void()>& then)
{
    const auto unsaved = takes.unsaved();
    if (unsaved.empty()) return then();
    const auto length = juce::String (unsaved.front()->length_s, 1);
    desk.question.ask (unsaved.size() == 1 ? filled (TRANS ("Save the take of %1 s before closing Tactus?"), length)
                                           : filled (TRANS ("Save %1 takes before closing Tactus?"), unsaved.size()),
                       TRANS ("Takes that you have not used are kept only while Tactus is open. `tactus capture` makes clips, gestures and tests from a "
                              "saved take."),
                       { { TRANS ("Save"), [&takes, then] { takes.save (then); } }, { TRANS ("Don't save"), then }, { TRANS ("Cancel"), {} } });
}
}   // namespace

Panel takesPanel (Desk& desk)
{
    auto made = std::make_unique<TakePanel> (desk.document, desk.playback, desk.types);
    auto* takes = made.get();
    takes->onHint = [&desk] (const juce::String& text) { desk.hint (text); };
    takes->onNotice = [&desk] (const juce::String& text) { desk.refuse (text); };
    takes->onOpen = [&desk] (auto chosen) { desk.chooseFile (false, ownFolder() / "take.jsonl", std::move (chosen)); };
    takes->onChoose = [&desk] (const std::string& name, auto chosen) { desk.chooseOwnFile (name, std::move (chosen)); };
    takes->onClip = [&desk] (const Clip& clip, Messages notes, std::optional<double> gain, const std::filesystem::path& to) {
        return saveClip (desk, clip, std::move (notes), gain, to);
    };
    takes->onSaid = [&desk] (const juce::String& title, const juce::String& text, std::function<void()> use) { desk.tell (title, text, std::move (use)); };
    desk.recoverTake = [takes] (const std::filesystem::path& take) { return takes->open (take, true); };
    return { .name = TRANS ("Take"),
             .component = std::move (made),
             .reload = [&desk, takes] {
                 takes->take().program = desk.program;
                 takes->take().home = desk.session; },
             .refresh = [takes] { takes->refresh(); },
             .close = [&desk, takes] (const std::function<void()>& then) { askToSave (desk, *takes, then); },
             .work = [takes] { return static_cast<const void*> (takes->take().recorded().get()); },
             .leave = [takes] { return takes->leave(); } };
}

}   // namespace tactus::host
