// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph_commands.hpp"

#include <host/app/canvas/picture/save_picture.hpp>
#include <host/app/compose/variation.hpp>
#include <host/app/layers/mixer_parts.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/storage/share.hpp>
#include <host/app/text/filled.hpp>
#include <host/app/welcome/example.hpp>

namespace tactus::host
{

namespace
{
void tellSaved (const Desk& desk, const std::filesystem::path& file, const Result<>& saved)
{
    desk.notify (saved ? filled (TRANS ("Saved %1"), file.string()) : fromUtf8 (messageText (saved.error())));
}
}   // namespace

void savePictureAs (const Desk& desk)
{
    const auto& name = desk.document.graph().name;
    const auto legal = juce::File::createLegalFileName (name.empty() ? "canvas" : fromUtf8 (name)).toStdString();
    desk.chooseOwnFile (legal + ".svg", [&desk] (const std::filesystem::path& file) { tellSaved (desk, file, savePicture (desk.canvas, file)); });
}

void shareAs (const Desk& desk)
{
    const auto share = [&desk] (const std::vector<std::filesystem::path>& agreed) {
        const auto& name = desk.document.graph().name;
        const auto legal = juce::File::createLegalFileName (name.empty() ? "preset" : fromUtf8 (name)).replaceCharacter ('.', '_').toStdString();
        desk.chooseOwnFile (legal + ".tactus", [&desk, agreed] (const std::filesystem::path& file) {
            const auto shared = sharePreset (desk.document.graph(), file, agreed);
            if (shared) return tellSaved (desk, file, shared);
            desk.tell (TRANS ("The graph was not shared"), fromUtf8 (messageText (shared.error())));
        });
    };
    const auto others = filesElsewhere (desk.document.graph());
    if (others.empty()) return share ({});
    if (others.size() > Question::most_listed)   // nobody agrees to what is not shown
        return desk.tell (TRANS ("The graph was not shared"),
                          filled (TRANS ("It uses %1 files of other folders. Copy them to the folder of the graph, and choose them there."), others.size()));
    desk.question.ask (TRANS ("Share these files, too?"),
                       Question::listOf (others) + TRANS ("The graph uses them. They are in other folders. Everyone who gets the shared file can read them."),
                       { { TRANS ("Share them"), [share, others] { share (others); } }, { TRANS ("Cancel"), {} } });
}

void randomise (const Desk& desk)
{
    std::vector<graph::Id> nodes;
    const auto& selected = desk.canvas.selection();
    for (const auto& n : desk.canvas.scene().nodes())
        if (selected.empty() ? ! mixing::isMixer (n.type) : selected.contains (n.id)) nodes.push_back (n.id);   // levels and ceilings are for the hand
    const auto seed = static_cast<std::uint64_t> (1 + juce::Random::getSystemRandom().nextInt (9999));
    auto batch = randomised (desk.document.graph(), desk.canvas.patch(), nodes, desk.types, seed);
    if (batch.commands.empty()) return desk.notify (TRANS ("Nothing here has a number with a usual range."));
    const auto count = batch.commands.size();
    if (desk.document.perform (std::move (batch)))
        desk.notify (filled (TRANS ("%1 new values, with the seed %2. Ctrl+Z restores the old ones."), count, juce::String (seed)));
}

void openExample (const Desk& desk, const std::string& type)
{
    const auto shipped = desk.presets();
    const Preset* smallest = nullptr;
    for (const auto& p : shipped)
        if (p.problem.empty() && p.types.contains (type) && (smallest == nullptr || p.types.size() < smallest->types.size())) smallest = &p;
    if (smallest != nullptr) return desk.openGraph (smallest->file);
    const auto* known = desk.types.find (type);
    if (known != nullptr) desk.openMade (exampleOf (*known, desk.types), filled (TRANS ("example of %1"), type).toStdString(), false, {});
}

}   // namespace tactus::host
