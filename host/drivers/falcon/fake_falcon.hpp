// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tactus::host
{

/// The kinematics of a Falcon from the grip to the angles, the inverse of those in the driver, without shared code. Places are in the axes of the Falcon,
/// in m.
namespace falcon_legs
{
using Place = std::array<double, 3>;

Place anglesAt (const Place&);                              ///< of the thighs, in rad; not a number where the legs do not reach
std::array<int, 3> countsAt (const Place&);                 ///< of the encoders
Place forceOf (const Place& torques_nm, const Place& at);   ///< on the grip, in N
}   // namespace falcon_legs

/// A fake Novint Falcon at the other end of a pseudo-terminal. It answers each packet with a packet, and forgets its homing if a packet lacks the bit for it.
/// It ignores bytes at a wrong baud rate. It runs on its own thread. [any thread]
class FakeFalcon
{
public:
    using Place = falcon_legs::Place;

    /// A fault of the fake Falcon.
    enum class Fault
    {
        none,
        silent,       ///< takes packets, and answers nothing
        shorter,      ///< each third answer lacks two bytes, but not its end
        shifted,      ///< each third answer lacks its first byte
        noisy,        ///< bytes between answers
        changed,      ///< each third answer has another count, as if a byte had changed on the way
        impossible,   ///< counts that no pose has
        late,         ///< each answer takes 30 ms
        forgetful     ///< it no longer knows its position
    };

    /// The hand: gives the next place of the grip, from its place now and the force on it, for each packet. [thread of the fake]
    using Hand = std::function<Place (const Place& grip, const Place& force)>;

    /// Without a hand, a spring pulls to `target`. `image_size`: the number of bytes to load until the firmware runs.
    explicit FakeFalcon (Hand = {}, bool has_firmware = true, std::size_t image_size = 0);
    ~FakeFalcon();
    FakeFalcon (const FakeFalcon&) = delete;
    FakeFalcon& operator= (const FakeFalcon&) = delete;

    const std::string& port() const noexcept { return name; }
    void fail (Fault f) noexcept { fault = f; }
    void unplug();   ///< as if the cable was pulled

    /// Holds the grip exactly here from the next answer on, with these buttons. Forgets the packets so far.
    void hold (const Place&, unsigned buttons);
    bool hasGot (const std::array<int, 3>& motors) const;   ///< true if a packet since hold() had these
    Place place() const;
    std::vector<std::uint8_t> image() const;   ///< of the firmware that was loaded
    bool isAtRest() const { return motors[0] == 0 && motors[1] == 0 && motors[2] == 0; }

    std::atomic<Fault> fault = Fault::none;
    std::array<std::atomic<double>, 3> target { 0.0, 0.0, 0.14 };   // of the hand
    std::atomic<double> stiffness = 300.0, tremor = 0.0;            // of the hand, in N/m and m
    std::atomic<unsigned> buttons = 0, homed = 7;
    std::atomic<int> first_tries_that_fail = 0;   // of loading
    std::atomic<int> looks_ms = 0;                // a wait before each answer, to see whether the driver waits for it

    // The packets so far, and the contents of the latest one.
    std::atomic<std::uint64_t> packets = 0, malformed = 0, without_homing = 0, pushes = 0;
    std::atomic<std::uint64_t> together = 0, alone = 0;   // packets sent before the last one was answered; packets since then that were not
    std::atomic<unsigned> bits = 0;
    std::array<std::atomic<int>, 3> motors {};
    std::atomic<std::int64_t> zero_at = 0;   // by the steady clock, in ns: the first packet without a force after one with a force
    std::atomic<int> largest_motor = 0;
    std::atomic<double> largest_force = 0.0;   // on the grip, in N
    std::atomic<std::size_t> loaded = 0;       // bytes

private:
    void attend();
    unsigned speed() const;
    void put (const std::vector<std::uint8_t>&);
    bool hears (int within_ms) const;
    void load();
    void answerPackets();
    void take (const std::uint8_t*);
    std::vector<std::uint8_t> answer() const;

    const Hand hand;
    const std::size_t image_size;
    std::string name;
    std::atomic<bool> runs_firmware, is_over = false;
    bool is_loading = false, is_ready = false;   // [its thread]
    std::vector<std::uint8_t> in;                // [its thread]

    mutable std::mutex mutex;   // of what follows
    int line = -1, kept_open = -1;
    Place grip { 0.0, 0.0, 0.14 };
    bool is_held = false;
    std::vector<std::array<int, 3>> got;
    std::vector<std::uint8_t> stored;

    std::thread running;
};

}   // namespace tactus::host
