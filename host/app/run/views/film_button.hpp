// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene_view.hpp"

#include <host/app/film/film_files.hpp>
#include <host/app/run/job.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

/// Saves what the scene showed as a film: an animated picture, a sound and a table of the force. A click opens a menu: save the last seconds,
/// or film from now until the next click. While a film is saved, the button shows the progress, and a click cancels the saving. [main thread]
class FilmButton final : public juce::Component
{
public:
    FilmButton (Playback&, SceneView&);

    void refresh();                                           ///< call many times a second
    int wantedWidth() const;                                  ///< the same for every label, so that what is next to the button stays in place
    int leastWidth() const { return button.wantedWidth(); }   ///< for the label that it has now

    /// Sets how many seconds are kept and saved.
    void setLength (double seconds);
    double length() const noexcept { return length_s; }
    std::function<void()> onLength;   ///< called when the user has chosen another length

    std::function<void (const juce::String&)> onHint;   ///< receives what was saved, or why nothing was

    /// Asks where to save the film, and proposes a file.
    std::function<void (const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>)> onChoose;

    // The commands of the menu.
    void saveLast();   ///< asks for a name, and saves the last seconds
    void begin();      ///< films from now on
    /// Asks for a name, and saves what was filmed. `then` is called once it is being saved; never if the user cancels.
    void end (const std::function<void()>& then = {});
    void save (std::shared_ptr<const Film>, const std::filesystem::path&);   ///< saves a film under this name

    /// The length of the film that was filmed, or was to be saved, and is not complete in its files; 0 if there is none. It is kept until it is
    /// saved, or another one begins.
    double unsaved() const { return kept && ! job ? kept->seconds() : 0.0; }
    void saveKept (const std::function<void()>& then = {});   ///< like end(), for this film

    bool isFilming() const noexcept { return first_tick.has_value(); }
    bool isSaving() const noexcept { return job != nullptr; }
    double progress() const noexcept { return job ? job->share() : 0.0; }                     ///< of the saving, 0…1
    bool isSaved() const noexcept { return is_saved; }                                        ///< the last film that was to be saved is complete
    double filmed() const { return isFilming() ? tape().secondsSince (*first_tick) : 0.0; }   ///< how much was filmed so far, in s

    void resized() override { button.setBounds (getLocalBounds()); }

private:
    void click();
    void openMenu();
    void ask (std::shared_ptr<const Film>, const std::function<void()>& then);
    void ask (std::shared_ptr<const Film>, const std::filesystem::path& begin, std::function<void()> then);
    void saveOrAskAgain (std::shared_ptr<const Film>, const std::filesystem::path&, const std::function<void()>& then);
    void label (const juce::String&);
    FilmTape& tape() const { return playback.current().film(); }
    void finish (const Result<FilmFiles>&);

    static constexpr int picture_width = 800;

    Playback& playback;
    SceneView& space;
    LabelButton button { TRANS ("Film"), TRANS ("Saves the scene as a film: pictures, sound and force") };
    double length_s = 10.0;
    std::optional<std::uint64_t> first_tick;   // while it films
    std::shared_ptr<const Film> kept;          // not saved yet
    std::filesystem::path saved_as;            // by the job
    std::optional<FilmPicture> picture;        // drawn by the job
    std::unique_ptr<Job<FilmFiles>> job;
    bool is_saved = false;
};

}   // namespace tactus::host
