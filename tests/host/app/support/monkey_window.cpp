// SPDX-License-Identifier: GPL-3.0-or-later
// What the monkey does with keys, files, menus and dialogs.
#include "monkey.hpp"

#include <host/app/history/history_panel.hpp>

#include <algorithm>

namespace tactus::host::test
{

std::string Monkey::windowKey()
{
    static const char* const keys[] {
        "escape", "escape", "1", "2", "3", "4", "5", "ctrl + 1", "ctrl + 2", "ctrl + 3", "F1", "ctrl + n", "ctrl + o", "ctrl + s",
        "ctrl + shift + s", "ctrl + z", "ctrl + z", "ctrl + y", "c", "h", "x", "tab", "shift + tab", "return", "spacebar", "cursor up",
        "cursor down", "cursor left", "cursor right", "page up", "home", "end", "delete", "backspace", "ctrl + a", "ctrl + v", "ctrl + x", "?",
        "F5", "F6", "shift + F6", "ctrl + f", "ctrl + k",
        "ctrl + c", "ctrl + shift + v", "v"
    };
    const auto* k = oneOf (keys);
    stage->key (k);
    return std::string ("key ") + k;
}

std::string Monkey::typeSomewhere()
{
    auto* editor = dynamic_cast<juce::TextEditor*> (juce::Component::getCurrentlyFocusedComponent());
    if (editor == nullptr || upTo (3) == 0)
    {
        std::vector<juce::Component*> all;
        const auto add = [&] (auto&& self, juce::Component& c) -> void {
            if (! c.isShowing()) return;
            if (dynamic_cast<juce::TextEditor*> (&c) != nullptr || dynamic_cast<juce::Label*> (&c) != nullptr) all.push_back (&c);
            for (auto* child : c.getChildren())
                self (self, *child);
        };
        add (add, *view);
        if (all.empty()) return "nowhere to type";
        const auto at = in (*oneOf (all));
        upTo (2) == 0 ? stage->click (at) : stage->doubleClick (at);
    }
    static const juce::String texts[] {
        "0.4 mm", "3 N", "nan", "", juce::CharPointer_UTF8 ("\xc3\xa4\xe2\x82\xac \xf0\x9f\x98\x80"), "1e999", "-1", "0", "1e-320", "a", "grain",
        "x y", "12 %", "(0, 0, 1)", "[1, 2, 3]", "{\"a\": 1}", "400 N/m", "0.5", "2 2 2", "friction", "../stroke.csv", "stroke.csv", "/",
        "not.there.wav", "drag", "graph", "inf", "99999999999999999999", "#", "7:7", "\"", "\\", juce::String::repeatedString ("long ", 60)
    };
    const auto text = oneOf (texts);
    const bool replaces = upTo (4) != 0;
    if (replaces) stage->key (juce::String ("ctrl + a"));
    stage->type (text);
    static const char* const ends[] { "return", "return", "escape", "tab", "ctrl + s", "" };
    const juce::String end = oneOf (ends);
    if (end.isNotEmpty()) stage->key (end);
    auto* focus = juce::Component::getCurrentlyFocusedComponent();
    return "type '" + text.substring (0, 40).toStdString() + "' " + end.toStdString() + ", focus " + (focus != nullptr ? describe (*focus) : "none");
}

std::string Monkey::wait()
{
    const int ms = 1 + upTo (40);
    poll (ms);
    return "wait " + std::to_string (ms) + " ms";
}

std::string Monkey::resize()
{
    const bool is_small = upTo (4) == 0;   // too small for all panels side by side
    is_small ? stage->setSize (512 + upTo (170), 350 + upTo (100)) : stage->setSize (960 + upTo (1000), 600 + upTo (500));
    return "resize to " + std::to_string (stage->getWidth()) + " x " + std::to_string (stage->getHeight());
}

std::string Monkey::openFile()
{
    const auto file = someFile (false);
    view->open (file);
    return "open " + file.string();
}

std::string Monkey::preview()
{
    if (view->desk().playback.isPreviewing() || upTo (3) == 0)
    {
        view->desk().endPreview();
        return "end of the preview";
    }
    const auto file = oneOf (shipped);
    view->desk().preview (file);
    return "preview " + file.filename().string();
}

std::string Monkey::startOrStop()
{
    std::string found = "no";
    const auto look_in = [&] (auto&& self, juce::Component& c) -> void {
        const auto* button = dynamic_cast<juce::Button*> (&c);
        if (button != nullptr && (button->getButtonText() == "STOP" || button->getButtonText() == "START"))
        {
            found = button->getButtonText().toStdString();
            stage->click (stage->getLocalPoint (&c, c.getLocalBounds().getCentre()).toFloat());
            return;
        }
        for (int i = 0; i < c.getNumChildComponents() && found == "no"; ++i)
            self (self, *c.getChildComponent (i));
    };
    look_in (look_in, *view);
    return found;
}

std::string Monkey::goInHistory()
{
    std::string done = "no history";
    const auto look_in = [&] (auto&& self, juce::Component& c) -> void {
        if (auto* panel = dynamic_cast<HistoryPanel*> (&c))
        {
            const int row = upTo (static_cast<int> (view->document().history().names().size()) + 2);
            panel->goToRow (row);
            done = "history row " + std::to_string (row);
            return;
        }
        for (int i = 0; i < c.getNumChildComponents(); ++i)
            self (self, *c.getChildComponent (i));
    };
    // Mostly small jumps in the history, so that there are still nodes to edit.
    if (upTo (4) == 0)
        look_in (look_in, *view);
    else
    {
        const auto at = static_cast<int> (view->document().history().position());
        view->document().goTo (static_cast<std::size_t> (std::max (0, at - 4 + upTo (7))));
        done = "history near " + std::to_string (at);
    }
    return done;
}

std::string Monkey::chooseInMenu()
{
    auto* menu = juce::ModalComponentManager::getInstance()->getModalComponent (0);
    if (menu == nullptr) return "no menu";
    const int how = upTo (6);
    if (how < 3)
    {
        const auto at = in (*menu);
        stage->click (at);
        return "menu: click " + coordinates (at).toStdString();
    }
    if (how == 3)
    {
        stage->key (juce::String ("escape"));
        return "menu: escape";
    }
    for (int i = 1 + upTo (8); --i >= 0;)
    {
        juce::String arrow ("cursor down");
        if (upTo (4) == 0)
            arrow = "cursor up";
        else if (upTo (4) == 0)
            arrow = "cursor right";
        stage->key (arrow);
    }
    stage->key (juce::String ("return"));
    return "menu: some item";
}

std::string Monkey::answer()
{
    const auto title = view->asked().title().toStdString();
    const int n = upTo (static_cast<int> (view->asked().size()));
    view->asked().answer (static_cast<std::size_t> (n));
    return title + ": answer " + std::to_string (n);
}

}   // namespace tactus::host::test
