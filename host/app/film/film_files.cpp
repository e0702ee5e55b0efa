// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_files.hpp"

#include <host/app/text/filled.hpp>
#include <host/base/platform/background_program.hpp>
#include <host/base/platform/private_folder.hpp>
#include <host/devices/audio/listening.hpp>
#include <host/tools/figures/animated_png.hpp>
#include <tactus/file/csv.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <system_error>
#include <thread>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

Message stoppedFilm()
{
    return Message::error ("film/stopped", "", TRANS ("the film was not saved, because it was stopped").toStdString(), TRANS ("save it again").toStdString());
}

Result<std::string> picturesOf (const Film& film, FilmPicture& picture, const std::function<bool (double)>& progress)
{
    constexpr double share = 0.9;   // of the whole work
    AnimatedPng animation { film_tolerance };
    const auto count = std::max (1, static_cast<int> (std::lround (film.seconds() * 1000.0 / film_picture_ms)));
    for (int i = 0; i < count; ++i)
    {
        if (! progress (share * i / count)) return stoppedFilm();
        const auto* state = stateAt (film, i * film_picture_ms / 1000.0);
        if (! animation.add (picture.draw (*state), film_picture_ms))
            return Message::error ("film/picture", "", TRANS ("a picture could not be encoded").toStdString(),
                                   TRANS ("make the scene larger, and save the film again").toStdString());
    }
    return animation.file();
}

Result<> writeBytes (const fs::path& path, const std::string& bytes)
{
    auto file = AtomicFile::create (path);
    if (! file) return file.error();
    if (! file->stream().write (bytes.data(), static_cast<std::streamsize> (bytes.size()))) return file->writeError();
    return file->commit();
}

Result<> copyTo (const fs::path& from, const fs::path& to)
{
    std::ifstream in (from, std::ios::binary);
    auto file = AtomicFile::create (to);
    if (! file) return file.error();
    if (! (file->stream() << in.rdbuf())) return file->writeError();
    return file->commit();
}

Result<> writeForces (const fs::path& path, const Film& film)
{
    const std::vector<std::string> columns { "t", "x", "y", "z", "force.x", "force.y", "force.z" };
    auto table = TableWriter::create (path, columns);
    if (! table) return table.error();
    for (const auto& t : film.ticks)
    {
        const double seconds = static_cast<double> (t.tick - film.ticks.front().tick) / film.rate_hz;
        const std::array row { seconds, t.position.x(), t.position.y(), t.position.z(), t.force.x(), t.force.y(), t.force.z() };
        if (const auto written = table->row (row); ! written) return written;
    }
    return table->commit();
}

/// A tick that was lost repeats the one before.
Result<> writeSound (const fs::path& path, const Film& film, Messages& notes)
{
    std::vector<Tap> taps;
    for (const char* component : { "tool.force.x", "tool.force.y", "tool.force.z" })
        taps.push_back ({ .name = component, .quantity = Quantity::force, .unit = "N" });
    Listening listening { path.string(), taps, film.rate_hz, 1 };
    auto tick = film.ticks.front().tick;
    std::array<double, 3> held {};
    for (const auto& t : film.ticks)
    {
        for (; tick < t.tick; ++tick)
            listening.frame (held);
        held = { t.force.x(), t.force.y(), t.force.z() };
        for (auto& f : held)
            if (! std::isfinite (f)) f = 0.0;
        listening.frame (held);
        ++tick;
    }
    Messages said;
    if (auto written = listening.write (said); ! written) return written;
    for (auto& m : said)
        notes.push_back (Message::warning ("film/silent", m.where, TRANS ("the sound is silent: no force on the tool moves faster than 20 Hz").toStdString(),
                                           TRANS ("stroke a texture").toStdString()));
    return {};
}

/// The pictures and the sound as a video, by a program that may not be installed.
void writeVideo (const fs::path& named, const std::string& ffmpeg, const std::function<bool (double)>& progress, FilmFiles& written)
{
    const auto with = [&named] (const char* extension) { return filmFile (named, extension); };
    const auto folder = privateFolder ("tactus-film-");   // next to the film, ffmpeg would follow the links of others
    const auto half_made = folder / "film.webm", says = folder / "says.txt", video = with (".webm");
    const std::vector<std::string> command { ffmpeg, "-nostdin", "-loglevel", "error", "-y", "-f", "apng", "-ignore_loop", "1", "-i", with (".png").string(),
                                             "-i", with (".wav").string(), "-c:v", "libvpx-vp9", "-pix_fmt", "yuv420p", "-crf", "24", "-b:v", "0", "-deadline",
                                             "good", "-cpu-used", "4", "-row-mt", "1", "-c:a", "libopus", half_made.string() };
    const auto noVideo = [&] (const juce::String& why, const juce::String& remedy) {
        written.notes.push_back (Message::warning ("film/no_video", video.string(), why.toStdString(), remedy.toStdString()));
    };
    auto program = folder.empty() ? nullptr : BackgroundProgram::start (command, says);
    std::error_code ignored;
    if (! program)
    {
        fs::remove_all (folder, ignored);
        return noVideo (TRANS ("no video was written, because ffmpeg is not installed"), TRANS ("install ffmpeg"));
    }
    auto status = program->status();
    for (; ! status && progress (0.95); status = program->status())
        std::this_thread::sleep_for (std::chrono::milliseconds (50));
    program.reset();
    if (status == 0 && copyTo (half_made, video))
        written.files.push_back (video);
    else
        noVideo (TRANS ("no video was written: ffmpeg failed or was stopped"), TRANS ("make the video from the .png and the .wav"));
    fs::remove_all (folder, ignored);
}
}   // namespace

fs::path filmFile (const fs::path& named, const std::string& extension)
{
    const auto given = named.extension();
    const bool is_ours = given == ".png" || given == ".wav" || given == ".csv" || given == ".webm";
    return fs::path (named).replace_extension (is_ours ? extension : given.string() + extension);
}

std::optional<fs::path> fileInTheWay (const fs::path& named)
{
    std::error_code unseen;
    for (const auto* extension : { ".wav", ".csv", ".webm" })
        if (const auto file = filmFile (named, extension); fs::exists (file, unseen)) return file;
    return {};
}

Result<FilmFiles> writeFilm (const Film& film, FilmPicture& picture, const fs::path& named, const std::function<bool (double)>& progress,
                             const std::string& ffmpeg)
{
    if (film.ticks.empty() || film.states.empty())
        return Message::error ("film/empty", named.string(), TRANS ("there is nothing to save yet").toStdString(),
                               TRANS ("start the graph, and move the tool").toStdString());
    const auto with = [&named] (const char* extension) { return filmFile (named, extension); };
    const auto pictures = picturesOf (film, picture, progress);
    if (! pictures) return pictures.error();
    FilmFiles written;
    if (auto done = writeBytes (with (".png"), *pictures); ! done) return done.error();
    if (auto done = writeSound (with (".wav"), film, written.notes); ! done) return done.error();
    if (auto done = writeForces (with (".csv"), film); ! done) return done.error();
    written.files = { with (".png"), with (".wav"), with (".csv") };
    if (progress (0.95)) writeVideo (named, ffmpeg, progress, written);
    return written;
}

}   // namespace tactus::host
