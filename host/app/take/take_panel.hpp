// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "take.hpp"
#include "take_plot.hpp"

#include <host/app/inspector/blocks/fields.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/kit/signal/clip.hpp>

#include <array>

namespace tactus::host
{

/// Records a run, shows one of its ports, and makes a clip, a gesture or a test from a stretch of it. All takes stay in a list until the window closes,
/// so none is lost because another one is shown.
class TakePanel final : public juce::Component, private Document::Listener
{
public:
    TakePanel (Document&, Playback&, const Catalogue&);
    ~TakePanel() override;

    void refresh();   ///< call many times a second

    Take& take() noexcept { return recording; }
    TakePlot& plot() noexcept { return curve; }

    void showPort (const std::string& port);   ///< shows another port of the recording
    const std::string& port() const noexcept { return shown_port; }
    void toggleRecording();
    void togglePinned();   ///< see TakePlot::pin()

    // The commands of the buttons. They ask for a file.
    void makeClip();
    void makeGesture();
    void makeTest();

    juce::String nameOf (std::size_t take) const;   ///< in the list

    /// The takes, complete or not, of which nothing was saved.
    std::vector<std::shared_ptr<Take::Recording>> unsaved() const;
    /// Ends the recording if there is one, asks for a file for each unsaved take, and saves the whole take there, as a log. `then` is called once all
    /// are saved.
    void save (const std::function<void()>& then);

    /// Shows a take from a log, see Take::open(). Says why, and returns false, if the log cannot be played.
    bool open (const std::filesystem::path& log, bool copies);

    /// The program must close now: this ends the recording, and leaves the unsaved takes for the next start. True if there are any.
    bool leave();

    /// Asks for a take to open.
    std::function<void (std::function<void (const std::filesystem::path&)>)> onOpen;

    /// Asks for a file to write; `name` is the suggested name.
    std::function<void (const std::string& name, std::function<void (const std::filesystem::path&)>)> onChoose;

    /// Writes a clip, and reports what was lost. A recorded force has the gain in N with which it is played as strongly again. Returns false if the
    /// clip was not written.
    std::function<bool (const Clip&, Messages, std::optional<double> gain, const std::filesystem::path&)> onClip;

    /// Shows a result or a problem. `use`, unless it is null, uses at once what was saved.
    std::function<void (const juce::String& title, const juce::String& text, std::function<void()> use)> onSaid;
    std::function<void (const juce::String&)> onHint;
    std::function<void (const juce::String&)> onNotice;   ///< what became of a take that the user has not ended

    void paint (juce::Graphics&) override;
    void resized() override;
    void visibilityChanged() override;

private:
    void documentChanged() override;
    /// The recording that the panel shows, the names of its ports, the port that is shown, and the name of its graph.
    struct Shown
    {
        std::shared_ptr<Take::Recording> recording;
        std::vector<std::string> names;
        std::string port, graph;
    };
    Shown shown() const { return { recording.recorded(), names, shown_port, recorded_graph }; }
    void endRecording();
    void restore (const Shown&);
    void showTake (Shown);
    std::function<void()> restored (const Shown&);   ///< for a step of the history
    void recorded (const std::shared_ptr<Take::Recording>&, Take::End);
    void keep (const Shown&, bool goes_on);
    void saveAs (const std::shared_ptr<Take::Recording>&, const std::function<void()>& then);
    void openMenu();
    void readPort();
    void fillPorts();
    void showLatest();
    void runTest (const std::filesystem::path&);
    void useGesture (const std::filesystem::path&);
    void listPorts (const graph::Graph&);
    void showMark();
    void applyFields();
    void refuse (const Message&);
    std::array<juce::String, 2> statusTexts() const;   ///< the same in short, for a narrow panel
    void nameButtons (bool briefly);
    StretchReader::Options marked() const;

    Document& document;
    const Catalogue& catalogue;
    Playback& playback;
    Traces::Client latest { playback.run().traces() };   // what the curve shows while it is recorded
    Take recording;
    TakePlot curve;
    ToolButton record { TRANS ("Record"), ToolButton::Kind::toggle };
    ToolButton list { TRANS ("Takes"), ToolButton::Kind::framed, TRANS ("All takes since the window was opened: show, save or open one") };
    ToolButton clip { TRANS ("Make a clip..."), ToolButton::Kind::framed, TRANS ("Save the marked stretch of this port as a clip that signal.clip plays") };
    ToolButton gesture { TRANS ("Make a gesture..."), ToolButton::Kind::framed,
                         TRANS ("Save the movement of the hand in the marked stretch as a path along which a simulated tool can go again") };
    ToolButton test { TRANS ("Make a test..."), ToolButton::Kind::framed,
                      TRANS ("Save a test that plays this run again and compares the marked stretch, bit for bit. It begins at the start of the run, "
                             "because the state of the nodes is known there.") };
    juce::ComboBox ports;
    TextField from, until;
    std::vector<std::string> names;   // of the ports to choose from
    std::string shown_port, recorded_graph;
    const void* opened = document.identity();   // the graph for which the panel shows takes
    bool is_stale = false;                      // there were edits since the ports were listed
    Shown before;                               // the recording that is being made
    std::vector<Shown> all;                     // the complete takes, in the order in which they were recorded
};

}   // namespace tactus::host
