// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "question.hpp"

#include <host/app/keep/session.hpp>
#include <host/app/keep/settings.hpp>
#include <host/app/model/document.hpp>

#include <functional>

namespace tactus::host
{

/// New, open, save, and what is kept for a crash. Nothing that was changed goes without a question. [main thread]
class Files final : private Document::Listener
{
public:
    /// What happens around it.
    struct Ways
    {
        std::function<void (const juce::String&)> say;
        std::function<void()> stop;                  ///< what runs, before another graph comes
        std::function<void (bool by_pointer)> run;   ///< the graph that came
        std::function<bool()> isRunning;
        std::function<void()> onSettings;   ///< they changed, and are to be saved

        /// Asks for a file to open, or to save in; calls back with it, or not at all.
        std::function<void (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>)> choose;
    };

    Files (Document&, Question&, Settings&, Ways);
    ~Files() override;

    std::function<double()> clock;   ///< s since 1970

    void beginSession (const std::filesystem::path& home);

    void create();
    void open();   ///< asks which
    void open (const std::filesystem::path&);
    void openCopy (const std::filesystem::path& preset, bool by_pointer);
    void openGraph (graph::Graph, const std::string& step);   ///< one without a file
    void save (std::function<void()> then = {});
    void saveAs (std::function<void()> then = {});

    /// Does it, once what is not saved is saved or was given up.
    void whenSaved (const juce::String& why, std::function<void()>);

    void setSafe (bool s) noexcept { safe = s; }   ///< nothing that is opened runs by itself
    bool isSafe() const noexcept { return safe; }

    /// Asks about what other runs left behind, the latest first. Returns whether there is anything.
    bool recover();

    void beforeRun();     ///< to be called before each
    void attend();        ///< many times a second
    void end();           ///< the program ends as it was asked to: nothing is left to recover
    void endSuddenly();   ///< it has to end now: what is not saved is kept

private:
    void documentChanged() override;
    bool keepNow();
    void load (const std::filesystem::path&, Document::Source, bool by_pointer);
    void show (graph::Graph, Document::Source, const std::string& step, bool runs, bool by_pointer);
    void saveTo (const std::filesystem::path&, const std::function<void()>& then);
    void askAboutNext();
    void restoreNext (bool runs);
    std::string name() const;

    static constexpr double keep_after_s = 1.0, trial_s = 10.0;

    Document& document;
    Question& question;
    Settings& settings;
    Ways ways;
    std::optional<Session> session;
    std::filesystem::path home;
    std::vector<Leftover> leftovers;
    std::optional<double> unkept_since;
    double trial_until = 0.0;
    bool safe = false;
};

}   // namespace tactus::host
