// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/dialogs/question.hpp>
#include <host/app/model/document.hpp>
#include <host/app/storage/autosaver.hpp>
#include <host/app/storage/recovery.hpp>
#include <host/app/storage/settings.hpp>

#include <functional>
#include <map>

namespace tactus::host
{

/// New, open, save, autosave and crash recovery. Asks before unsaved changes are lost. [main thread]
class Files final : private Document::Listener
{
public:
    struct Callbacks
    {
        std::function<void (const juce::String&)> notify;
        std::function<void()> stop;                  ///< called before another graph is opened
        std::function<void (bool by_pointer)> run;   ///< called after a graph was opened
        std::function<bool()> isRunning;
        std::function<bool()> isStopped;     ///< true unless it runs, and no stop holds its forces at zero
        std::function<bool()> isByPointer;   ///< true if the mouse moves the tool
        std::function<void()> usePointer;    ///< from the next run on, the mouse moves the tool, unless a device does
        /// Loads the large files of a graph with this name on another thread, and then shows it; a user who cancels keeps the open graph.
        std::function<void (const graph::Graph&, const juce::String& name, std::function<void()> show)> prepare;
        std::function<bool (const std::filesystem::path& take)> openTake;   ///< recovers a take; false if it cannot be opened
        std::function<void()> onSettings;                                   ///< called when the settings have changed and must be saved
        std::function<void (graph::Graph&)> onWrite;                        ///< called with what is about to be written; may change its `ui`

        /// Asks for a file to open or save, and calls back with it unless the user cancels.
        std::function<void (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>)> choose;
    };

    Files (Document&, Question&, Settings&, Callbacks);
    ~Files() override;

    std::function<double()> clock;   ///< the time in s since 1970

    void beginSession (const std::filesystem::path& home);
    std::filesystem::path sessionFolder() const;   ///< what a crash leaves; empty if it leaves nothing

    void create();
    void open();                                ///< asks the user for the file
    void open (const std::filesystem::path&);   ///< opens a graph, or makes a graph that plays a clip
    void openCopy (const std::filesystem::path& preset, bool by_pointer);
    /// Opens a graph that has no file; `then` is called once it is open. A graph that is work of the user, such as a fit, is an unsaved change.
    void openGraph (graph::Graph, const std::string& step, bool is_work, std::function<void()> then = {});
    void save (std::function<void()> then = {});
    void saveAs (std::function<void()> then = {});
    void reload();   ///< opens the file of the graph again; undo brings back what was not saved; runs only if the graph was running, by the same hand

    /// Calls the function once unsaved changes are saved or discarded.
    void whenSaved (const juce::String& why, std::function<void()>);

    void setSafe (bool s) noexcept { safe = s; }   ///< safe mode: opened graphs do not run until START
    bool isSafe() const noexcept { return safe; }

    /// Offers to recover crashed sessions, the latest first. Returns true if there are any.
    bool recover();

    void beforeRun();   ///< call before each run

    /// Call many times a second: an edit that came too soon after an autosave, or while one was being written, is handed over here.
    void poll();

    bool isWriting() const { return session && ! autosaver->isIdle(); }   ///< an autosave is being written
    void finishAutosave();                                                ///< waits until the autosave matches the document
    void end();                                                           ///< removes the autosave; call it when the program closes normally

    /// Autosaves unsaved changes; call it when the program must close now. The folder of the session stays if there are takes in it.
    void endSuddenly (bool has_takes = false);

private:
    void documentChanged() override;
    void documentLeft() override { document.keepUi (uiToWrite()); }
    std::string knownHash() const;
    AutosavedDocument autosaved (bool is_changed, std::string text) const;   ///< the document as it is now
    Json uiToWrite() const;
    void autosaveSoon();
    void handToAutosaver();
    bool autosave();
    void load (const std::filesystem::path&, const Document::Source&, bool by_pointer, bool runs = true);
    void loadClipGraph (const std::filesystem::path&, bool by_pointer);   ///< opens a graph that plays a clip file
    void show (graph::Graph, Document::Source, const std::string& step, bool runs, bool by_pointer);
    void refuse (const std::filesystem::path&, const Messages&);   ///< a dialog that says why the file cannot be opened
    void saveElsewhere (const juce::String& why, const std::function<void()>& then);
    /// Saves the graph there. Asks before it copies files of the graph; `agreed` are those that the user has agreed to.
    void saveTo (const std::filesystem::path&, const std::function<void()>& then, const std::optional<std::vector<std::filesystem::path>>& agreed = {});
    std::string nameIn (const std::filesystem::path&) const;
    bool wasChangedElsewhere (const std::filesystem::path&) const;
    void askAboutNext();
    void restoreNext (bool runs);
    std::string name() const;

    static constexpr double trial_s = 10.0;

    Document& document;
    Question& question;
    Settings& settings;
    Callbacks callbacks;
    std::optional<RecoverySession> session;
    std::filesystem::path home;
    std::vector<CrashedSession> crashed;
    std::optional<Autosaver> autosaver;                         // declared after the session, which it uses
    std::map<std::filesystem::path, std::string> known_files;   // hashes of files, as they were last read or written here
    std::size_t handed_step = 0;                                // the position in the history when the autosaver last got the document
    double handed_at = -1e9;                                    // by `clock`
    bool is_dirty = false;                                      // the document has changed since it was handed to the autosaver
    double trial_until = 0.0;
    bool safe = false, was_by_pointer = false, was_stopped = true;
};

}   // namespace tactus::host
