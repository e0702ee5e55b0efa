// SPDX-License-Identifier: MIT
#include "capture.hpp"

#include <host/devices/hid/hex.hpp>

#include <tactus/text/caught.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tactus::host::hid
{
namespace
{
constexpr std::string_view capture_format = "tactus-capture";
constexpr int capture_version = 1;
constexpr std::array<const char*, 5> line_kinds { "in", "out", "feature_in", "feature_out", "gone" };   // in the order of Capture::Line::What
constexpr std::array<const char*, 3> wire_names { "hid", "serial", "udp" };                             // in the order of Wire
constexpr const char* service_wire = "websocket";

using LineKind = Capture::Line::What;

Message badCapture (std::size_t line, std::string id, std::string text, std::string remedy)
{
    auto m = Message::error (std::move (id), "", std::move (text), std::move (remedy));
    m.line = static_cast<int> (line);
    m.column = 1;
    return m;
}

std::string textAt (const Json& json, const char* key)
{
    const auto at = json.find (key);
    return at != json.end() && at->is_string() ? at->asString() : std::string();
}

/// The text up to the next end of a line, which is removed from `text`; empty at the end.
std::string_view nextLine (std::string_view& text)
{
    const auto end = text.find ('\n');
    const auto line = text.substr (0, end);
    text.remove_prefix (end == text.npos ? text.size() : end + 1);
    return line;
}

Result<Capture> readHead (std::string_view text)
{
    auto read = readJson (std::string (text));
    if (hasErrors (read.messages)) return std::move (read.messages.front());
    const auto& json = read.root;
    if (! json.is_object() || textAt (json, "format") != capture_format)
        return badCapture (1, "capture/format", "this is not a capture of a device", "make one: tactus devices --capture FILE");
    const auto number = json.find ("version");
    if (number == json.end() || ! number->is_number_integer() || number->get<std::int64_t>() != capture_version)
        return badCapture (1, "capture/version", "this Tactus reads only captures of version " + std::to_string (capture_version), "use a newer Tactus");
    Capture capture { .profile = textAt (json, "profile"), .driver = textAt (json, "driver"), .wire = {}, .lines = {} };
    if (textAt (json, "wire") == service_wire)
    {
        if (! capture.driver.empty()) return capture;
        return badCapture (1, "capture/format", "the capture does not say which driver talks with the service", "make the capture again");
    }
    capture.driver.clear();
    const auto wire = std::ranges::find (wire_names, textAt (json, "wire"));
    if (wire == wire_names.end())
        return badCapture (1, "capture/format", "the wire of the capture is none of hid, serial, udp and websocket", "make the capture again");
    capture.wire = static_cast<Wire> (wire - wire_names.begin());
    return capture;
}

Result<Capture::Line> readLine (std::string_view text, std::size_t number, bool is_text)
{
    const auto refuse = [&] (std::string why) {
        return badCapture (number, "capture/line", std::move (why), R"(a line is written as {"t":0.001,"in":"54 01"}; remove this one)");
    };
    auto read = readJson (std::string (text));
    if (hasErrors (read.messages)) return refuse ("the line is not JSON: " + read.messages.front().text);
    const auto& json = read.root;
    if (! json.is_object()) return refuse ("the line is not an object");
    Capture::Line line;
    const auto t = json.find ("t");
    if (t == json.end() || ! t->is_number() || ! std::isfinite (t->get<double>())) return refuse ("the line has no time");
    line.t = t->get<double>();
    const auto what = std::ranges::find_if (line_kinds, [&] (const char* name) { return json.contains (name); });
    if (what == line_kinds.end()) return refuse ("the line is none of in, out, feature_in, feature_out and gone");
    line.what = static_cast<LineKind> (what - line_kinds.begin());
    if (line.what == LineKind::gone) return line;
    const auto written = json.find (*what);
    if (is_text)
    {
        if (! written->is_string()) return refuse ("the message is no text");
        const auto& message = written->asString();
        line.bytes.assign (message.begin(), message.end());
        return line;
    }
    auto bytes = written->is_string() ? bytesOf (written->asString()) : std::nullopt;
    if (! bytes) return refuse ("the bytes are not written as 54 01 ff");
    line.bytes = std::move (*bytes);
    return line;
}

/// Records what passes through another transport. Its tick thread does not read it, because writing to a file takes time.
class CapturingTransport final : public Transport
{
public:
    CapturingTransport (std::unique_ptr<Transport> t, CaptureFile& f) : inner (std::move (t)), file (f) {}

    Result<std::size_t> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override
    {
        auto got = inner->read (into, timeout);
        if (! got)
            file.add (LineKind::gone, {});
        else if (*got > 0)
            file.add (LineKind::in, into.first (std::min (*got, into.size())));
        return got;
    }

    Result<std::size_t> getInput (std::span<std::uint8_t> report) override
    {
        auto got = inner->getInput (report);
        if (got && *got > 0) file.add (LineKind::in, report.first (std::min (*got, report.size())));
        return got;
    }

    std::size_t keptBySystem() const noexcept override { return inner->keptBySystem(); }
    std::uint64_t strayBytes() const noexcept override { return inner->strayBytes(); }
    bool awaitsAnswer() const noexcept override { return inner->awaitsAnswer(); }

    Result<> write (std::span<const std::uint8_t> report) override { return recorded (LineKind::out, report, inner->write (report)); }
    Result<> sendFeature (std::span<const std::uint8_t> report) override { return recorded (LineKind::feature_out, report, inner->sendFeature (report)); }
    Result<> getFeature (std::span<std::uint8_t> report) override
    {
        auto done = inner->getFeature (report);
        return recorded (LineKind::feature_in, report, std::move (done));
    }

    Result<> armFailsafe (const std::vector<OutgoingReport>& reports) override { return inner->armFailsafe (reports); }
    bool beat (bool driven) noexcept override { return inner->beat (driven); }

private:
    Result<> recorded (LineKind what, std::span<const std::uint8_t> report, Result<> done)
    {
        if (done) file.add (what, report);
        return done;
    }

    const std::unique_ptr<Transport> inner;
    CaptureFile& file;
};

Result<std::unique_ptr<Transport>> capturing (Result<std::unique_ptr<Transport>> opened, CaptureFile& file)
{
    if (! opened) return opened;
    return std::make_unique<CapturingTransport> (std::move (*opened), file);
}
}   // namespace

Result<Capture> readCapture (std::string_view text)
{
    if (text.empty() || text.back() != '\n') text = text.substr (0, text.rfind ('\n') + 1);   // npos + 1 is 0
    auto head = readHead (nextLine (text));
    if (! head) return head;
    for (std::size_t number = 2; ! text.empty(); ++number)
    {
        const auto line = nextLine (text);
        if (line.empty()) continue;
        auto read = readLine (line, number, ! head->driver.empty());
        if (! read) return std::move (read).error();
        head->lines.push_back (std::move (*read));
    }
    return head;
}

Result<std::unique_ptr<CaptureFile>> CaptureFile::create (const std::string& path, const ConnectedDevice& device, std::string_view profile,
                                                          const Bytes& descriptor)
{
    Json head { { "format", capture_format }, { "version", capture_version }, { "wire", wire_names[static_cast<std::size_t> (device.wire)] } };
    if (! profile.empty()) head["profile"] = profile;
    if (device.wire == Wire::hid)
        for (const auto& [key, number] : { std::pair<const char*, int> { "vid", device.vid },
                                           { "pid", device.pid },
                                           { "usage_page", device.usage_page },
                                           { "usage", device.usage },
                                           { "interface", device.interface_number } })
            head[key] = number;
    if (! descriptor.empty()) head["descriptor"] = hexOf (descriptor);
    return begin (path, head, false);
}

Result<std::unique_ptr<CaptureFile>> CaptureFile::createForMessages (const std::string& path, std::string_view driver)
{
    return begin (path, { { "format", capture_format }, { "version", capture_version }, { "wire", service_wire }, { "driver", driver } }, true);
}

Result<std::unique_ptr<CaptureFile>> CaptureFile::begin (const std::string& path, const Json& head, bool is_text)
{
    std::ofstream file (path, std::ios::trunc | std::ios::binary);
    file << head.dump() << '\n'
         << std::flush;
    if (! file) return Message::error ("output/unwritable", path, "the capture cannot be written", "name a file in a folder that you may write to");
    return std::unique_ptr<CaptureFile> (new CaptureFile (std::move (file), is_text));
}

void CaptureFile::add (Capture::Line::What what, std::span<const std::uint8_t> bytes) noexcept
{
    const std::lock_guard lock (mutex);
    const double t = std::chrono::duration<double> (std::chrono::steady_clock::now() - began).count();
    static_cast<void> (caught ("the capture", [&] {
        const Json written = is_text ? std::string (bytes.begin(), bytes.end()) : hexOf (bytes);
        file << R"({"t":)" << numberText (t) << R"(,")" << line_kinds[static_cast<std::size_t> (what)] << R"(":)" << written.dump() << "}\n"
             << std::flush;
    }));
    count += file ? 1 : 0;
}

std::uint64_t CaptureFile::lines() const noexcept
{
    const std::lock_guard lock (mutex);
    return count;
}

bool CaptureFile::isGood() const noexcept
{
    const std::lock_guard lock (mutex);
    return static_cast<bool> (file);
}

Result<std::unique_ptr<Transport>> CapturingSystem::open (const ConnectedDevice& device) { return capturing (system.open (device), file); }

Result<std::unique_ptr<Transport>> CapturingSystem::reach (const ConnectedDevice& device, const Profile& profile)
{
    return capturing (system.reach (device, profile), file);
}

}   // namespace tactus::host::hid
