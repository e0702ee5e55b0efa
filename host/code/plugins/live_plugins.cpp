// SPDX-License-Identifier: MIT
#include "live_plugins.hpp"
#include "compiler_output.hpp"
#include "declarations.hpp"

#include <tactus/file/text_file.hpp>
#include <tactus/plugin/plugin_library.hpp>

#include <algorithm>
#include <chrono>
#include <thread>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;
using FileClock = fs::file_time_type::clock;

fs::file_time_type lastSaved (const std::vector<fs::path>& files)
{
    auto last = fs::file_time_type::min();
    for (const auto& file : files)
    {
        std::error_code unseen;
        if (const auto at = fs::last_write_time (file, unseen); ! unseen) last = std::max (last, at);
    }
    return last;
}

/// Text that differs if nodes made of these files may have a different layout in memory; empty if that cannot be known.
std::string layoutOf (const LiveSource& source, std::vector<fs::path> files)
{
    if (source.sources.size() > 1 || files.empty()) return {};   // the compiler lists the files that it has read for one source only
    std::ranges::sort (files);                                   // a precompiled header may change the order
    std::string text;
    for (const auto& file : files)
    {
        const auto content = readTextFile (file);
        if (! content) return {};
        text += file.string() + "\n" + declarationsOf (*content) + "\n";
    }
    return text;
}
}   // namespace

double LivePlugins::RebuiltPlugin::secondsSinceSaved() const { return std::chrono::duration<double> (FileClock::now() - saved).count(); }

LivePlugins::LivePlugins (std::vector<LiveSource> sources)
{
    for (auto& source : sources)
        all.emplace_back (std::move (source));
}

std::optional<LivePlugins::RebuiltPlugin> LivePlugins::poll()
{
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        auto& watched = all[i];
        if (! watched.files.poll()) continue;
        watched.waits = true;
        watched.saved = lastSaved (watched.source.watched());
        if (compiled == i) compiled.reset();   // what is being compiled is out of date; the next start drops it
    }
    if (! compiled) return startNext();
    auto output = compiler.finished();
    return output ? load (std::move (*output)) : std::nullopt;
}

std::optional<LivePlugins::RebuiltPlugin> LivePlugins::startNext()
{
    const auto next = std::ranges::find (all, true, &WatchedSource::waits);
    if (next == all.end()) return std::nullopt;
    next->waits = false;
    started = FileClock::now();
    if (auto refused = compiler.start (next->source); ! refused) return RebuiltPlugin { next->source.file, {}, { refused.error() }, next->saved };
    compiled = static_cast<std::size_t> (next - all.begin());
    return std::nullopt;
}

std::optional<LivePlugins::RebuiltPlugin> LivePlugins::load (LiveCompiler::Output output)
{
    auto& watched = all[*compiled];
    compiled.reset();
    std::error_code ignored;
    if (! output.messages.empty())
    {
        fs::remove (output.plugin, ignored);
        return RebuiltPlugin { watched.source.file, {}, std::move (output.messages), watched.saved };
    }
    auto files = watched.source.watched();
    for (const auto& file : output.read)
        if (std::ranges::find (files, file) == files.end()) files.push_back (file);
    const auto layout = layoutOf (watched.source, output.read);
    const auto saved = lastSaved (output.read);
    const bool is_old = saved >= started && saved <= FileClock::now();   // saved during the compilation, which may have mixed old and new code
    watched.files.watch (std::move (files));
    if (is_old)
    {
        watched.waits = true;
        fs::remove (output.plugin, ignored);
        return std::nullopt;
    }
    auto news = loadLive (output.plugin, watched.source.file, layout);
    news.saved = watched.saved;
    fs::remove (output.plugin, ignored);   // what is loaded stays in memory
    return news;
}

Result<> LivePlugins::prepare() { return all.empty() ? Result<> {} : compiler.prepareFor (all.front().source); }

std::vector<LivePlugins::RebuiltPlugin> LivePlugins::buildHeaders (const std::function<bool()>& stop_wanted)
{
    for (auto& watched : all)
        if (watched.source.sources.empty())
        {
            watched.waits = true;
            watched.saved = FileClock::now();
        }
    std::vector<RebuiltPlugin> made;
    while (compiled || std::ranges::find (all, true, &WatchedSource::waits) != all.end())
    {
        if (stop_wanted && stop_wanted()) return made;
        if (auto news = poll()) made.push_back (std::move (*news));
        std::this_thread::sleep_for (std::chrono::milliseconds (10));
    }
    return made;
}

Messages compileHeader (const fs::path& header, const fs::path& plugin)
{
    const auto source = liveHeader (header);
    if (! source) return { source.error() };
    LiveCompiler compiler { LiveCompiler::Work::once };
    if (auto refused = compiler.start (*source); ! refused) return { std::move (refused).error() };
    auto output = compiler.finished();
    for (; ! output; output = compiler.finished())
        std::this_thread::sleep_for (std::chrono::milliseconds (10));
    for (auto& m : output->messages)
        m.remedy = "correct the C++ code and compile it again; what is loaded stays as it is";
    if (! output->messages.empty()) return std::move (output->messages);
    std::error_code failed;
    fs::copy_file (output->plugin, plugin, fs::copy_options::overwrite_existing, failed);
    if (failed) return { Message::error ("output/unwritable", plugin.string(), "the plugin cannot be written: " + failed.message(), "choose another file") };
    return {};
}

LivePlugins::RebuiltPlugin loadLive (const fs::path& plugin, const fs::path& code, const std::string& layout)
{
    LivePlugins::RebuiltPlugin news { code };
    auto library = PluginLibrary::load (plugin);
    if (! library)
    {
        news.messages.push_back (std::move (library).error());
        news.messages.back().where = code.string();
        news.messages.back().remedy = correct_and_save;
        return news;
    }
    news.types = (*library)->types (news.messages, layout);
    for (auto& type : news.types)
        type.origin = code.string();
    for (auto& m : news.messages)
        m.where = code.string();
    return news;
}

}   // namespace tactus::host
