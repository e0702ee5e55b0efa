// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/inspector/blocks/fields.hpp>
#include <tactus/node/setting.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace tactus::host
{

/// The objects and functions that the editors of settings need in addition to the value.
struct EditorContext
{
    Assets& assets;
    std::function<std::string()> folder;   ///< folder of the graph, for file paths
    std::function<void (const juce::String&)> refused;

    /// Asks for a file of one of these patterns, beginning in a folder or at a file; see clip_patterns.
    std::function<void (const juce::String& patterns, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>)> choose {};
};

/// The files that may be clips. A dialog that shows them leaves out each .json that is not a clip, such as a graph.
inline constexpr const char* clip_patterns = "*.haptic;*.ahap;*.hjif;*.json;*.wav;*.csv";

/// The editor for a setting or one of its fields, depending on its kind: a number, a table of modes, a law with its curve, a
/// file … Structured values can also be edited as JSON.
std::unique_ptr<Block> settingEditor (const SettingSheet&, Binding, const EditorContext&);

/// A file: its path, a browse button and a description. Accepts dropped files. A clip is a table for a node.
std::unique_ptr<Block> fileRow (const juce::String& label, SettingSheet::Kind, Binding, const EditorContext&, const juce::String& about, bool is_clip = false);

/// A law: its kind, numbers and curve.
std::unique_ptr<Block> lawEditor (const SettingSheet&, Binding, const EditorContext&);

/// A curve: its points and a plot.
std::unique_ptr<Block> curveEditor (const SettingSheet&, Binding, const EditorContext&);

/// Records as table rows, with a plot if they are tones.
std::unique_ptr<Block> recordsEditor (const SettingSheet&, Binding, const EditorContext&);

/// A column that is rebuilt when the shape of its value changes.
class Stack : public Column
{
public:
    explicit Stack (int indent = 0) : Column ({ indent, 0, 0 }) {}

    void refresh (const graph::Node*) final;

protected:
    /// A key that changes when other blocks are needed.
    virtual std::string shape() const = 0;
    virtual void fill() = 0;   ///< adds the blocks

private:
    std::optional<std::string> made_for;
    std::vector<std::unique_ptr<Block>> retired;   // kept alive because one of them may have triggered the rebuild
};

}   // namespace tactus::host
