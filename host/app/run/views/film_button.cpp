// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_button.hpp"

#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

namespace
{
juce::String savingText (int percent) { return filled (TRANS ("Saving %1 %"), percent); }
juce::String stopText (int seconds) { return filled (TRANS ("Stop %1 s"), seconds); }
}   // namespace

FilmButton::FilmButton (Playback& p, SceneView& s) : playback (p), space (s)
{
    button.setTitle (TRANS ("Film"));
    button.onClick = [this] { click(); };
    addAndMakeVisible (button);
    setLength (length_s);
}

int FilmButton::wantedWidth() const
{
    const auto width = [font = lookOf (*this).font (12.0f)] (const juce::String& text) { return font.getStringWidthFloat (text); };
    return static_cast<int> (std::ceil (std::max (width (TRANS ("Film")), std::max (width (savingText (99)), width (stopText (119)))))) + 14;
}

void FilmButton::setLength (double seconds)
{
    length_s = std::clamp (seconds, 1.0, FilmTape::longest_s);
    if (! isFilming()) tape().keep (length_s);
}

void FilmButton::label (const juce::String& text)
{
    if (text == button.getButtonText()) return;
    button.setButtonText (text);
    button.setTitle (text);
}

void FilmButton::refresh()
{
    tape().keep (isFilming() ? FilmTape::longest_s : length_s);   // a preview has its own tape
    if (job)
    {
        label (savingText (juce::roundToInt (std::floor (99.0 * job->share()))));
        if (const auto result = job->take()) finish (*result);
    }
    else if (isFilming())
    {
        const double seconds = tape().secondsSince (*first_tick);
        label (stopText (juce::roundToInt (std::floor (seconds))));
        if (seconds >= FilmTape::longest_s - 0.5 || tape().end() < *first_tick) end();   // the tape is full, or another run has begun
    }
    else
        label (TRANS ("Film"));
    button.setToggleState (isFilming() || job, juce::dontSendNotification);
}

void FilmButton::click()
{
    if (job) return job->stop();
    isFilming() ? end() : openMenu();
}

void FilmButton::openMenu()
{
    juce::PopupMenu menu, lengths;
    const auto safe = juce::Component::SafePointer (this);
    const auto add = [&safe] (juce::PopupMenu& to, const juce::String& text, bool is_on, bool is_ticked, std::function<void (FilmButton&)> act) {
        to.addItem (text, is_on, is_ticked, [safe, act = std::move (act)] {
            if (safe != nullptr) act (*safe);
        });
    };
    if (kept) add (menu, filled (TRANS ("Save the film of %1 s..."), juce::String (kept->seconds(), 1)), true, false, [] (FilmButton& b) { b.saveKept(); });
    const bool has_something = tape().end() > 0;
    const bool is_hidden = ! has_something && playback.current().isRunning();
    const auto last = is_hidden ? TRANS ("Save the last %1 s...: only while 3D is shown") : TRANS ("Save the last %1 s...");
    add (menu, filled (last, juce::String (length_s, 0)), has_something, false,
         [] (FilmButton& b) { b.saveLast(); });
    add (menu, TRANS ("Film from now on"), playback.current().isRunning(), false, [] (FilmButton& b) { b.begin(); });
    menu.addSeparator();
    for (const double seconds : { 5.0, 10.0, 20.0, 30.0, 60.0 })
        add (lengths, juce::String (seconds, 0) + " s", true, seconds == length_s, [seconds] (FilmButton& b) {
            b.setLength (seconds);
            if (b.onLength) b.onLength();
        });
    menu.addSubMenu (TRANS ("Length of the film"), lengths);
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (this));
}

void FilmButton::saveLast() { ask (std::make_shared<Film> (tape().last (length_s)), {}); }
void FilmButton::saveKept (const std::function<void()>& then) { ask (kept, then); }

void FilmButton::begin()
{
    kept.reset();
    first_tick = tape().end();
    tape().keep (FilmTape::longest_s);
}

void FilmButton::end (const std::function<void()>& then)
{
    if (const auto first = std::exchange (first_tick, {}))
    {
        auto film = std::make_shared<Film> (tape().end() < *first ? tape().last (FilmTape::longest_s) : tape().since (*first));
        if (! film->ticks.empty() && ! film->states.empty()) kept = film;
        ask (std::move (film), then);
    }
    tape().keep (length_s);
}

void FilmButton::ask (std::shared_ptr<const Film> film, const std::function<void()>& then)
{
    if (job) return;
    if (! film || film->ticks.empty() || film->states.empty())
    {
        if (onHint) onHint (TRANS ("There is no film to save yet: start the graph, and move the tool"));
        return;
    }
    const auto folder = juce::File::getSpecialLocation (juce::File::userDocumentsDirectory).getChildFile ("Tactus");
    folder.createDirectory();
    const auto file = folder.getChildFile ("film" + juce::Time::getCurrentTime().formatted (" %Y-%m-%d %H-%M-%S") + ".png");
    ask (std::move (film), file.getFullPathName().toStdString(), then);
}

void FilmButton::ask (std::shared_ptr<const Film> film, const std::filesystem::path& begin, std::function<void()> then)
{
    if (! onChoose) return;
    onChoose (begin, [safe = juce::Component::SafePointer (this), film = std::move (film), then = std::move (then)] (const std::filesystem::path& named) {
        if (safe != nullptr) safe->saveOrAskAgain (film, named, then);
    });
}

/// The dialog has asked only about the .png.
void FilmButton::saveOrAskAgain (std::shared_ptr<const Film> film, const std::filesystem::path& named, const std::function<void()>& then)
{
    if (const auto taken = fileInTheWay (named))
    {
        if (onHint) onHint (filled (TRANS ("The film is not saved: %1 exists already. Choose another name."), taken->filename().string()));
        return ask (std::move (film), named, then);
    }
    save (std::move (film), named);
    if (then) then();
}

void FilmButton::save (std::shared_ptr<const Film> film, const std::filesystem::path& named)
{
    is_saved = false;
    kept = film;
    saved_as = named;
    job.reset();   // it may draw the picture until it has ended
    picture.emplace (themeOf (*this), space.getLocalBounds(), picture_width);
    job = std::make_unique<Job<FilmFiles>>();
    job->start (named.string(), [film = std::move (film), &drawn = *picture, named] (JobCourse& course) {
        return writeFilm (*film, drawn, named, [&course] (double part) {
            course.share = part;
            return ! course.cancelled;
        });
    });
    refresh();
}

void FilmButton::finish (const Result<FilmFiles>& result)
{
    is_saved = result.has_value();
    juce::String text;
    if (result)
    {
        kept.reset();
        text = filled (TRANS ("Saved %1"), result->files.front().string());
        for (std::size_t i = 1; i < result->files.size(); ++i)
            text << ", " << juce::String (result->files[i].extension().string());
        for (const auto& note : result->notes)
            text << ". " << juce::String (messageText (note));
    }
    else
        text = filled (TRANS ("%1: %2. The menu of Film keeps the film until it is saved."), saved_as.filename().string(), messageText (result.error()));
    job.reset();
    label (TRANS ("Film"));
    if (onHint) onHint (text);
}

}   // namespace tactus::host
