// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_text.hpp"
#include "setting_editor.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

namespace
{
juce::Image thumbnail (const Grid& grid, int most)
{
    const double scale = static_cast<double> (most) / std::max (1, std::max (grid.columns, grid.rows));
    const int width = std::max (1, static_cast<int> (grid.columns * scale));
    const int height = std::max (1, static_cast<int> (grid.rows * scale));
    juce::Image image (juce::Image::RGB, width, height, false);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
        {
            const int row = std::min (grid.rows - 1, y * grid.rows / height), column = std::min (grid.columns - 1, x * grid.columns / width);
            image.setPixelAt (x, y, juce::Colour::greyLevel (static_cast<float> (grid (row, column))));
        }
    return image;
}

class FileRow final : public Block, public juce::FileDragAndDropTarget
{
public:
    FileRow (juce::String l, SettingSheet::Kind k, Binding s, const EditorContext& c, juce::String about_it, bool clip)
        : label (std::move (l)), about (std::move (about_it)), is_clip (clip), kind (k), binding (std::move (s)), context (c)
    {
        field.setTitle (label);
        field.onApply = [this] (const juce::String& text) {
            const auto path = text.trim();
            binding.set (path.isEmpty() ? std::nullopt : std::optional<Json> (path.toStdString()), false);
        };
        browse.onClick = [this] { openChooser(); };
        addAndMakeVisible (field);
        addAndMakeVisible (browse);
    }

    int heightFor (int width) override
    {
        return 20 + 28 + std::max (static_cast<int> (std::ceil (layout (width).getHeight())) + 6, picture.isValid() ? 64 : 0) + 6;
    }

    void refresh (const graph::Node*) override
    {
        const auto now = binding.get();
        const auto written = now.is_string() ? now.get<std::string>() : std::string();
        field.show (written);
        showEnd();
        // Called after every edit of the graph: read the file again only if it is a different one or was modified.
        std::error_code problem;
        const auto path = resolved (written, context.folder());
        field.setTooltip (about + (written.empty() ? juce::String() : "\n" + fromUtf8 (path)));
        const auto as_of = std::make_pair (path, std::filesystem::last_write_time (path, problem));
        if (as_of == read_as_of && ! info.text.empty()) return;
        read_as_of = as_of;
        info = describeFile (written, kind, context.folder(), context.assets);
        picture = info.picture ? thumbnail (*info.picture, 56) : juce::Image();
        repaint();
    }

    bool isInterestedInFileDrag (const juce::StringArray& files) override { return files.size() == 1; }
    void fileDragEnter (const juce::StringArray&, int, int) override { hover (true); }
    void fileDragExit (const juce::StringArray&) override { hover (false); }
    void filesDropped (const juce::StringArray& files, int, int) override
    {
        hover (false);
        setFile (files[0]);
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        auto area = getLocalBounds();
        g.setFont (look.font (12.0f, field.getText().isNotEmpty()));
        g.setColour (field.getText().isEmpty() ? look.theme().dim : look.theme().text);
        g.drawText (label, area.removeFromTop (20), juce::Justification::centredLeft, true);
        area.removeFromTop (30);
        if (picture.isValid())
        {
            g.drawImageAt (picture, 0, area.getY() + 2);
            g.setColour (look.theme().hairline);
            g.drawRect (0, area.getY() + 2, picture.getWidth(), picture.getHeight());
        }
        layout (getWidth()).draw (g, area.withTrimmedLeft (picture.isValid() ? 64 : 0).toFloat());
        if (! over) return;
        g.setColour (look.theme().accent);
        g.drawRoundedRectangle (getLocalBounds().toFloat().reduced (0.5f), 4.0f, 1.5f);
    }

    void resized() override
    {
        auto line = getLocalBounds().withTrimmedTop (20).removeFromTop (28).reduced (0, 2);
        browse.setBounds (line.removeFromRight (76));
        field.setBounds (line.withTrimmedRight (4));
        showEnd();
    }

private:
    juce::TextLayout layout (int width) const
    {
        const auto& look = lookOf (*this);
        const auto colour = info.is_problem ? look.theme().warning : look.theme().dim;
        return wrapText (fromUtf8 (info.text), look.font (11.0f), colour, static_cast<float> (width - (picture.isValid() ? 64 : 0)));
    }

    /// Of a long path, the end says more than the beginning.
    void showEnd()
    {
        if (! field.hasKeyboardFocus (true)) field.setCaretPosition (field.getText().length());
    }

    void hover (bool now)
    {
        over = now;
        repaint();
    }

    void setFile (const juce::String& file) { binding.set (Json (pathFrom (file.toStdString(), context.folder())), false); }

    /// Begins at the file that is set, or else in the folder of the graph.
    void openChooser()
    {
        if (! context.choose) return;
        const auto written = field.getText().toStdString(), folder = context.folder();
        const std::filesystem::path begin = written.empty() ? folder : resolved (written, folder);
        context.choose (is_clip ? clip_patterns : patternsOf (kind), begin,
                        [safe = juce::Component::SafePointer (this)] (const std::filesystem::path& chosen) {
                            if (safe != nullptr) safe->setFile (fromUtf8 (chosen.string()));
                        });
    }

    juce::String label, about;
    bool is_clip;
    SettingSheet::Kind kind;
    Binding binding;
    EditorContext context;
    TextField field;
    ToolButton browse { TRANS ("Browse..."), ToolButton::Kind::framed, TRANS ("Choose a file, or drop one here") };
    FileText info;
    std::pair<std::string, std::filesystem::file_time_type> read_as_of;
    juce::Image picture;
    bool over = false;
};
}   // namespace

std::unique_ptr<Block> fileRow (const juce::String& label, SettingSheet::Kind kind, Binding binding, const EditorContext& context, const juce::String& about,
                                bool is_clip)
{
    return std::make_unique<FileRow> (label, kind, std::move (binding), context, about, is_clip);
}

}   // namespace tactus::host
