// SPDX-License-Identifier: MIT
#include "fake_player.hpp"

#include <host/drivers/websocket/fake_service.hpp>
#include <host/drivers/websocket/member.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <thread>
#include <utility>

namespace tactus::host
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr int motors = 20;   // of each side of a vest

/// A whole number from 0 to `most`.
std::optional<int> wholeAt (const Json& from, const char* key, int most)
{
    const auto* at = member (from, key);
    if (at == nullptr || ! at->is_number()) return std::nullopt;
    const double number = at->get<double>();
    if (! (number >= 0.0 && number <= most) || number != std::floor (number)) return std::nullopt;
    return static_cast<int> (number);
}

/// The part of the vest that a key drives, the intensities of its motors, and when they end.
struct Shown
{
    std::string position;
    std::array<int, motors> intensities {};
    Clock::time_point until {};
};

class Player final : public FakeService<FakePlayer>
{
public:
    explicit Player (int p) : FakeService (p) { begin ("the fake Player"); }
    ~Player() override { end(); }

    std::vector<std::string> heard() const override
    {
        const std::lock_guard lock (mutex);
        return messages;
    }

    int intensity (const std::string& position, int motor) const override
    {
        const std::lock_guard lock (mutex);
        int most = 0;
        for (const auto& [key, what] : shown)
            if (what.position == position && Clock::now() < what.until) most = std::max (most, what.intensities.at (static_cast<std::size_t> (motor)));
        return most;
    }

    bool isSilent() const override
    {
        const std::lock_guard lock (mutex);
        return std::ranges::none_of (shown, [] (const auto& s) {
            return Clock::now() < s.second.until && std::ranges::any_of (s.second.intensities, [] (int i) { return i > 0; });
        });
    }

private:
    void serve (WebServer::Client& client, const std::stop_token& stop) override
    {
        if (! client.target().starts_with ("/v2/feedbacks?app_id=")) count ([&] (Counts& n) { ++n.refused; });
        bool has_vest = fault() != Fault::unworn;
        client.say (statusOf (has_vest));
        while (! mustEnd (stop))
        {
            if (fault() == Fault::silent)
            {
                std::this_thread::sleep_for (std::chrono::milliseconds (look_ms));
                continue;
            }
            if (fault() == Fault::garbage) client.say ("{\"ConnectedDeviceCount\":");
            if (const bool now = fault() != Fault::unworn; now != has_vest) client.say (statusOf (has_vest = now));
            while (client.says (look_ms))
                hear (client.hear());
        }
    }

    static std::string statusOf (bool has_vest)
    {
        const auto positions = has_vest ? Json::array ({ "VestFront", "VestBack" }) : Json::array();
        return Json { { "ConnectedDeviceCount", has_vest ? 1 : 0 },
                      { "ActiveKeys", Json::array() },
                      { "ConnectedPositions", positions },
                      { "RegisteredKeys", Json::array() },
                      { "Status", Json::object() } }
            .dump();
    }

    void hear (const std::string& text)
    {
        const std::lock_guard lock (mutex);
        ++tally.heard;
        messages.push_back (text);
        const auto read = readJson (text);
        const auto* all = member (read.root, "Submit");
        if (! read.messages.empty() || all == nullptr || ! all->is_array())
        {
            ++tally.refused;
            return;
        }
        for (const auto& one : *all)
            if (! submit (one)) ++tally.refused;
    }

    bool submit (const Json& one)
    {
        const auto type = textAt (one, "Type"), key = textAt (one, "Key");
        if (type == "turnOffAll") shown.clear();
        if (type == "turnOff") shown.erase (key);
        if (type == "turnOff" || type == "turnOffAll") return ++tally.turned_off > 0;
        const auto* frame = member (one, "Frame");
        if (type != "frame" || key.empty() || frame == nullptr) return false;
        Shown what { .position = textAt (*frame, "position") };
        const auto lasts = wholeAt (*frame, "durationMillis", 60'000);
        const auto* points = member (*frame, "dotPoints");
        if ((what.position != "VestFront" && what.position != "VestBack") || ! lasts || points == nullptr || ! points->is_array()) return false;
        for (const auto& point : *points)
        {
            const auto index = wholeAt (point, "index", motors - 1), intensity = wholeAt (point, "intensity", 100);
            if (! index || ! intensity) return false;
            what.intensities[static_cast<std::size_t> (*index)] = *intensity;
            tally.largest = std::max (tally.largest, *intensity);
        }
        what.until = Clock::now() + std::chrono::milliseconds (*lasts);
        shown[key] = what;
        ++tally.frames;
        return true;
    }

    std::vector<std::string> messages;
    std::map<std::string, Shown> shown;   // by key
};
}   // namespace

Result<std::unique_ptr<FakePlayer>> FakePlayer::make (int port)
{
    return madeService<FakePlayer> (port, [&] { return std::make_unique<Player> (port); });
}

}   // namespace tactus::host
