// SPDX-License-Identifier: MIT
// A stick with one motor, as an event device of the kernel (uinput): its effects are uploaded and played here.
#include "uhid.hpp"

#include <linux/uinput.h>

#include <sys/ioctl.h>

#include <cmath>
#include <csignal>
#include <memory>

namespace tactus::guest
{

namespace
{
volatile std::sig_atomic_t ended = 0;

constexpr std::uint16_t axes[] { ABS_X, ABS_Y, ABS_Z };
constexpr int largest = 32767;

/// The axes at time t: the tool is one millimetre deep and is rubbed back and forth. Each axis is 12 cm long, and z points downwards.
std::array<int, 3> placeAt (double t)
{
    constexpr double counts = 2.0 * largest / 0.12;
    return { static_cast<int> (std::lround (0.02 * std::sin (6.0 * t) * counts)), 0, static_cast<int> (std::lround (1e-3 * counts)) };
}

class Wheel
{
public:
    Wheel (std::string& l, Mark& m) : lines (l), mark (m)
    {
        fd = ::open ("/dev/uinput", O_RDWR | O_CLOEXEC | O_NONBLOCK);
        if (fd < 0)
        {
            std::perror ("/dev/uinput");
            std::exit (2);
        }
        set (UI_SET_EVBIT, EV_ABS);
        set (UI_SET_EVBIT, EV_KEY);
        set (UI_SET_EVBIT, EV_FF);
        set (UI_SET_KEYBIT, BTN_TRIGGER);
        set (UI_SET_KEYBIT, BTN_THUMB);
        for (const int effect : { FF_CONSTANT, FF_GAIN, FF_AUTOCENTER })
            set (UI_SET_FFBIT, effect);
        for (const auto axis : axes)
        {
            uinput_abs_setup about {};
            about.code = axis;
            about.absinfo.minimum = -largest;
            about.absinfo.maximum = largest;
            about.absinfo.fuzz = 64;   // as many joysticks have
            ask (UI_ABS_SETUP, &about);
        }
        uinput_setup about {};
        about.id = { .bustype = 3, .vendor = 0x046d, .product = 0xc24f, .version = 1 };
        std::snprintf (about.name, sizeof about.name, "Test wheel");
        about.ff_effects_max = 4;
        ask (UI_DEV_SETUP, &about);
        ask (UI_DEV_CREATE, nullptr);
    }

    /// Closing destroys the device. UI_DEV_DESTROY would do so under a lock that an upload which is under way waits for, for ever (Linux 6.1).
    ~Wheel() { ::close (fd); }

    Wheel (const Wheel&) = delete;
    Wheel& operator= (const Wheel&) = delete;

    int forces = 0;   ///< levels other than 0 so far

    void move (double t)
    {
        const auto place = placeAt (t);
        std::array<input_event, 4> events {};
        for (std::size_t i = 0; i < 3; ++i)
        {
            events[i].type = EV_ABS;
            events[i].code = axes[i];
            events[i].value = place[i];
        }
        events[3].type = EV_SYN;
        if (::write (fd, events.data(), sizeof events) < 0) return note ("dropped", 0);
        note ("in", place[0]);
    }

    /// Answers the kernel until the given time.
    void serve (double until)
    {
        for (;;)
        {
            const auto wait = waitUntil (until);
            pollfd p { fd, POLLIN, 0 };
            if (::ppoll (&p, 1, &wait, nullptr) <= 0)
            {
                if (now() >= until) return;
                continue;
            }
            input_event e {};
            if (::read (fd, &e, sizeof e) != static_cast<ssize_t> (sizeof e)) return;
            if (e.type == EV_UINPUT && e.code == UI_FF_UPLOAD) upload (e.value);
            if (e.type == EV_UINPUT && e.code == UI_FF_ERASE) erase (e.value);
            if (e.type == EV_FF && e.code < FF_GAIN) note (e.value != 0 ? "play" : "stop", e.code);
            if (e.type == EV_FF && e.code == FF_GAIN) note ("gain", e.value);
            if (e.type == EV_FF && e.code == FF_AUTOCENTER) note ("autocenter", e.value);
        }
    }

    void note (const char* what, int value)
    {
        char line[64];
        std::snprintf (line, sizeof line, "%s,%d,%.6f\n", what, value, now());
        lines += line;
    }

private:
    void ask (unsigned long what, void* with)
    {
        if (::ioctl (fd, what, with) == 0) return;
        std::perror ("uinput");
        std::exit (2);
    }
    void set (unsigned long what, int bit)
    {
        if (::ioctl (fd, what, bit) == 0) return;
        std::perror ("uinput");
        std::exit (2);
    }

    void upload (int request)
    {
        uinput_ff_upload asked {};
        asked.request_id = static_cast<std::uint32_t> (request);
        if (::ioctl (fd, UI_BEGIN_FF_UPLOAD, &asked) != 0) return;
        const auto& effect = asked.effect;
        const int level = effect.u.constant.level;
        note (effect.type == FF_CONSTANT && effect.direction == 0x4000 && effect.replay.length == 500 ? "level" : "other", level);
        if (level != 0)
        {
            ++forces;
            mark.count();
        }
        asked.retval = 0;
        ::ioctl (fd, UI_END_FF_UPLOAD, &asked);
    }

    void erase (int request)
    {
        uinput_ff_erase asked {};
        asked.request_id = static_cast<std::uint32_t> (request);
        if (::ioctl (fd, UI_BEGIN_FF_ERASE, &asked) != 0) return;
        note ("erase", static_cast<int> (asked.effect_id));
        asked.retval = 0;
        ::ioctl (fd, UI_END_FF_ERASE, &asked);
    }

    std::string& lines;
    Mark& mark;
    int fd = -1;
};
}   // namespace

/// --log FILE --mark FILE --seconds S --rate HZ; once, after N forces: --unplug N (away for --away S), --hang N (answers no upload for --for S)
int wheel (const std::vector<std::string>& args)
{
    std::signal (SIGTERM, [] (int) { ended = 1; });
    const double period = 1.0 / option (args, "rate", 1000.0);
    auto unplug = static_cast<int> (option (args, "unplug", 0.0)), hang = static_cast<int> (option (args, "hang", 0.0));
    std::string lines;
    Mark mark (args);
    auto device = std::make_unique<Wheel> (lines, mark);
    const double begin = now(), end = begin + option (args, "seconds", 10.0);
    for (double due = begin; now() < end && ended == 0; due = std::max (due + period, now() - 4.0 * period))
    {
        device->serve (due);
        if (hang > 0 && device->forces >= hang)
        {
            hang = 0;
            device->note ("hangs", 0);
            // It still moves: a force that does not change needs no update.
            for (const double until = now() + option (args, "for", 1.0); now() < until && ended == 0; pauseFor (period))
                device->move (now() - begin);
            device->note ("answers", 0);
        }
        if (unplug > 0 && device->forces >= unplug)
        {
            unplug = 0;
            device->note ("unplugged", 0);
            device.reset();
            pauseFor (option (args, "away", 0.8));
            device = std::make_unique<Wheel> (lines, mark);
            device->note ("plugged", 0);
        }
        device->move (now() - begin);
    }
    device->serve (now() + 0.05);
    writeLog (args, lines);
    return 0;
}

}   // namespace tactus::guest
