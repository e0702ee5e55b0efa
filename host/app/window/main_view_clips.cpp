// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are opened or dropped on the window.
#include "main_view.hpp"

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

}   // namespace tactus::host
