// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fields.hpp"

#include <framework/setting.hpp>

namespace tactus::host
{

/// What editors of settings need besides the value: where files are, and whom to tell why something was not taken.
struct EditorContext
{
    Assets& assets;
    std::function<std::string()> folder;   ///< of the graph
    std::function<void (const juce::String&)> refused;
};

/// What sets a value of a setting, or a field of one, by its kind: a number, a table of modes, a law with its curve, a file …
/// What is not simple can also be written as text, as in the file.
std::unique_ptr<Block> settingEditor (const SettingSheet&, Slot, const EditorContext&);

/// A row for a file: its path, a button that browses, what it holds; a file can be dropped onto it.
std::unique_ptr<Block> fileRow (const juce::String& label, SettingSheet::Kind, Slot, const EditorContext&, const juce::String& about);

/// A law: its kind, its numbers, its curve.
std::unique_ptr<Block> lawEditor (const SettingSheet&, Slot, const EditorContext&);

/// Points of a curve, one under another, and the curve.
std::unique_ptr<Block> curveEditor (const SettingSheet&, Slot, const EditorContext&);

/// Records as rows of a table, with a picture where they are tones.
std::unique_ptr<Block> recordsEditor (const SettingSheet&, Slot, const EditorContext&);

/// Blocks under one another, made anew when what they show has another shape.
class Stack : public Block
{
public:
    int heightFor (int width) override;
    void refresh (const graph::Node*) override;
    void resized() override;

protected:
    /// What decides which blocks there are.
    virtual std::string shape() const = 0;
    virtual void fill() = 0;   ///< with what `put` is given

    void put (std::unique_ptr<Block>);
    std::size_t size() const noexcept { return blocks.size(); }
    Block& at (std::size_t i) { return *blocks[i]; }
    void remake();

    int indent = 0;

private:
    std::string made_for;
    bool made = false;
    std::vector<std::unique_ptr<Block>> blocks, retired;   // retired: one of them may be what asked for others
};

}   // namespace tactus::host
