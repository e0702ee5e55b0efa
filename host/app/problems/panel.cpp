// SPDX-License-Identifier: GPL-3.0-or-later
// The list of problems in the window.
#include "problem_list.hpp"
#include "unfelt.hpp"

#include <host/app/desk/panel.hpp>
#include <host/app/inspector/settings/file_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/plan/rules/unheard.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tactus::host
{

namespace
{
/// The messages about the graph: by the compiler, by live C++, about what cannot be felt, and about the limits of its devices.
class Problems
{
public:
    Problems (Desk& d, ProblemList& l) : desk (d), list (l) {}

    void refresh()
    {
        auto all = desk.liveMessages();
        std::ranges::copy (desk.playback.run().messages(), std::back_inserter (all));
        dropRepeated (all);
        findMissing();
        std::ranges::copy (missing, std::back_inserter (all));
        is_error = hasErrors (all);
        std::ranges::copy (desk.limits.messages(), std::back_inserter (all));
        list.show (all, desk.limits.remarks(), ! desk.limits.isUpToDate());
    }

    Panel::Title title() const
    {
        const auto count = list.messages().size();
        return { count == 0 ? TRANS ("Problems") : filled (TRANS ("Problems %1"), count), is_error };
    }

    /// Asks for the file that a message misses.
    void chooseFile (const Message& m)
    {
        const auto file = missingFileOf (desk.document.graph(), m);
        if (! file) return;
        auto begin = file->expected.empty() ? std::filesystem::path (desk.document.graph().folder) : file->expected.parent_path();
        if (std::error_code failed; ! std::filesystem::is_directory (begin, failed)) begin.clear();
        desk.chooseInput (patternsOf (file->kind), begin, [this, m] (const std::filesystem::path& chosen) {
            if (const auto now = missingFileOf (desk.document.graph(), m)) desk.document.perform (useFile (desk.document.graph(), *now, chosen));
        });
    }

private:
    /// The run and its devices may each say the same of a description.
    static void dropRepeated (Messages& all)
    {
        Messages once;
        for (auto& m : all)
        {
            const auto isSame = [&m] (const Message& other) {
                return other.id == m.id && other.severity == m.severity && other.where == m.where && other.text == m.text;
            };
            if (std::ranges::none_of (once, isSame)) once.push_back (std::move (m));
        }
        all = std::move (once);
    }

    /// Looks for what the graph needs before it can be felt, and for nodes that no motor and no scope shows.
    void findMissing()
    {
        const std::pair now (desk.document.version(), desk.probed());
        if (missing_of == now) return;
        missing_of = now;
        missing = unfelt (desk.document.graph(), desk.types);
        const auto isSaid = [said = missing] (const Message& m) { return std::ranges::count (said, m.where, &Message::where) > 0; };
        std::ranges::remove_copy_if (plan::unheardNodes (desk.document.graph(), desk.types, now.second), std::back_inserter (missing), isSaid);
    }

    Desk& desk;
    ProblemList& list;
    Messages missing;
    std::optional<std::pair<std::uint64_t, Desk::Ports>> missing_of;   // the version of the document, and the ports that scopes showed
    bool is_error = false;
};
}   // namespace

Panel problemsPanel (Desk& desk)
{
    auto made = std::make_unique<ProblemList> (desk.document);
    auto* list = made.get();
    const auto problems = std::make_shared<Problems> (desk, *list);
    list->onShow = [&desk] (const ProblemLocation& at) { desk.show (at.patch, at.id); };
    list->onFix = [&desk] (graph::Command fix) { desk.canvas.commands().performPlaced (std::move (fix)); };
    list->onChooseFile = [problems] (const Message& m) { problems->chooseFile (m); };
    desk.showProblems = [&desk, list] { desk.reveal (*list); };
    return { .name = TRANS ("Problems"),
             .component = std::move (made),
             .title = [problems] { return problems->title(); },
             .refresh = [problems] { problems->refresh(); } };
}

}   // namespace tactus::host
