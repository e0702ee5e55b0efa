// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are opened or dropped on the window, and clips that are saved.
#include "main_view.hpp"

#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/files/clip_io.hpp>
#include <host/base/files/preset_pack.hpp>
#include <tactus/text/quote.hpp>

#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

/// The losses of a saved clip, a line each.
juce::String lossText (const SavedClip& saved, const Messages& notes)
{
    constexpr std::size_t most = 8;
    std::vector<std::string> lines;
    for (const auto& m : notes)
        lines.push_back (messageText (m));
    std::ranges::move (lossReport (saved), std::back_inserter (lines));
    if (lines.back().starts_with ("none") || lines.back().starts_with ("nothing else")) lines.pop_back();
    if (lines.empty()) return TRANS ("The file holds the whole clip, and renders to the same signal.");
    auto text = TRANS ("What the file does not hold, or holds differently:") + "\n";
    for (std::size_t i = 0; i < std::min (most, lines.size()); ++i)
        text << "\n- " << juce::String (lines[i]) << ".";
    if (lines.size() <= most) return text;
    return text + "\n\n" + filled (TRANS ("There are %1 more. `tactus convert` lists all."), lines.size() - most);
}

bool isRecording (const fs::path& file)
{
    const auto extension = extensionOf (file);
    return extension == ".csv" || extension == ".tsv" || extension == ".txt";
}
}   // namespace

void MainView::open (const fs::path& file)
{
    if (isRecording (file)) return fitRecordingIn (file);
    // A shipped preset is opened as a copy, whichever way its path is written.
    std::error_code failed;
    const auto whole = fs::absolute (file, failed);
    const bool is_shipped = fs::equivalent (whole.parent_path(), presetFolder(), failed) && ! failed;
    is_shipped ? files.openCopy (whole, false) : files.open (file);
}

/// The window stays responsive, and the open graph goes on, until the files are there.
void MainView::loadAssets (const graph::Graph& graph, const juce::String& name, std::function<void()> show)
{
    asset_load.start (graph, catalogue);
    after_load = std::move (show);
    loading = filled (TRANS ("Opening %1"), name);
    question.ask (loading, {}, { { TRANS ("Cancel"), [this] {
                                      asset_load.cancel();
                                      after_load = {};
                                  } } });
    attendLoad();
}

void MainView::attendLoad()
{
    if (! asset_load.isRunning()) return;
    wake();
    if (! question.isOpen() || question.title() != loading) return;   // another question comes first
    const auto loaded = asset_load.take();
    if (loaded == nullptr)
        return question.say (filled (TRANS ("Its large files are being read and prepared: %1 s. Until then, the open graph stays as it is."),
                                     juce::roundToInt (asset_load.seconds())));
    run().adopt (loaded->assets);
    const auto show = std::exchange (after_load, {});
    question.cancel();
    show();
    loaded_assets = loaded;
    loaded_for = edited.identity();
}

bool MainView::isInterestedInFileDrag (const juce::StringArray& dragged)
{
    if (dragged.size() != 1 || question.isOpen()) return false;
    const fs::path file { dragged[0].toStdString() };
    return isClipExtension (file) || isRecording (file) || extensionOf (file) == ".json" || isPresetPack (file);
}

void MainView::filesDropped (const juce::StringArray& dropped, int, int)
{
    open (dropped[0].toStdString());
}

void MainView::saveClipAs (const fs::path& file)
{
    const auto read = loadClip (file);
    if (! read)
        return tell (filled (TRANS ("Cannot read %1"), printableName (file.filename().string())), messageText (read.error()) + ".");
    const auto other = extensionOf (file) == ".haptic" ? ".ahap" : ".haptic";
    chooseOwnFile (file.stem().string() + other,
                   [this, source = *read] (const fs::path& to) { static_cast<void> (writeClip (source.clip, {}, {}, to, &source)); });
}

/// Asks where to save a file of the user. The clips of presets are in a folder that may be read-only.
void MainView::chooseOwnFile (const std::string& name, std::function<void (const fs::path&)> chosen)
{
    std::error_code failed;
    fs::create_directories (ownFolder(), failed);
    chooseFile (true, ownFolder() / name, std::move (chosen));
}

bool MainView::writeClip (const Clip& clip, Messages notes, std::optional<double> gain, const fs::path& to, const readers::ClipFile* source)
{
    auto file = to;
    if (! file.has_extension()) file += ".haptic";
    const auto name = juce::String (printableName (file.filename().string()));
    const auto saved = saveClip (clip, file, 0.0, source);
    if (! saved)
    {
        tell (TRANS ("The clip was not saved"), messageText (saved.error()) + ".");
        return false;
    }
    tell (filled (TRANS ("Saved %1"), name), lossText (*saved, notes), [this, file, gain] {
        bottom.show (layers);
        layers.addClip (file, gain);
    });
    return true;
}

/// A message that the user closes. With `use`, what was saved can be used at once.
void MainView::tell (const juce::String& title, const juce::String& text, std::function<void()> use)
{
    std::vector<Question::Choice> choices { { TRANS ("Close"), {} } };
    if (use) choices.insert (choices.begin(), { TRANS ("Use now"), std::move (use) });
    question.ask (title, text, std::move (choices));
}

}   // namespace tactus::host
