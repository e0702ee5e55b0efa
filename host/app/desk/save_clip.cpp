// SPDX-License-Identifier: GPL-3.0-or-later
#include "save_clip.hpp"

#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/files/clip_io.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
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
}   // namespace

bool saveClip (const Desk& desk, const Clip& clip, Messages notes, std::optional<double> gain, const std::filesystem::path& to, const readers::ClipFile* source)
{
    auto file = to;
    if (! file.has_extension()) file += ".haptic";
    const auto saved = saveClip (clip, file, 0.0, source);
    if (! saved)
    {
        desk.tell (TRANS ("The clip was not saved"), messageText (saved.error()) + ".");
        return false;
    }
    const auto name = juce::String (printableName (file.filename().string()));
    desk.tell (filled (TRANS ("Saved %1"), name), lossText (*saved, notes), [&desk, file, gain] { desk.addClip (file, gain); });
    return true;
}

void saveClipAs (const Desk& desk, const std::filesystem::path& file)
{
    const auto read = loadClip (file);
    if (! read) return desk.tell (filled (TRANS ("Cannot read %1"), printableName (file.filename().string())), messageText (read.error()) + ".");
    const auto other = extensionOf (file) == ".haptic" ? ".ahap" : ".haptic";
    desk.chooseOwnFile (file.stem().string() + other,
                        [&desk, source = *read] (const auto& to) { static_cast<void> (saveClip (desk, source.clip, {}, {}, to, &source)); });
}

}   // namespace tactus::host
