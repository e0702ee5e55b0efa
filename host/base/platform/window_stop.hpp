// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <thread>

namespace tactus::host
{

/// Receives the stop keys and clicks on a part of a window directly from the X server, on its own connection and thread, so a stop does
/// not wait for the thread that draws the window.
///
/// Keys: a second client may select the key presses of a window. Both clients then receive each of them. A key press goes to the
/// window with the keyboard focus, so all windows of the program that can get the focus must be watched.
///
/// Clicks: only one client may select the button presses of a window. So this object lays an invisible window (InputOnly) over the
/// part. The X server delivers clicks there to this object alone, and only where no other window covers the part.
class WindowStop
{
public:
    /// A part of the window, in pixels. The types are those of the X protocol.
    struct Area
    {
        std::int16_t x = 0, y = 0;
        std::uint16_t width = 0, height = 0;

        bool isEmpty() const noexcept { return width == 0 || height == 0; }
        bool operator== (const Area&) const = default;
    };

    /// The actions of a stop. These functions are called on the thread of this object and must not wait.
    struct Actions
    {
        std::function<void()> stop;             ///< a click on the area
        std::function<void()> escape;           ///< Esc
        std::function<void()> emergency_stop;   ///< Shift+Esc
    };

    /// `window` is the X id of the window. Ids: stop/no_server, stop/no_window. [main thread]
    static Result<std::unique_ptr<WindowStop>> open (std::uintptr_t window, Actions);
    ~WindowStop();
    WindowStop (const WindowStop&) = delete;
    WindowStop& operator= (const WindowStop&) = delete;

    /// As soon as the thread of this object has got the call, clicks on the area count as stops. In an empty area there are none. [main thread]
    void setArea (const Area& a) noexcept
    {
        if (wanted.exchange (a) != a) wake();
    }

    /// Other windows of the program, such as a file dialog: as soon as the thread of this object has got the call, their stop keys count too.
    /// At most `most_others`; an id that is not a window has no effect. [main thread]
    static constexpr std::size_t most_others = 8;
    void setOthers (std::span<const std::uintptr_t> windows) noexcept
    {
        bool differ = false;
        for (std::size_t i = 0; i < others.size(); ++i)
        {
            const auto window = i < windows.size() ? windows[i] : 0;
            differ |= others[i].exchange (window) != window;
        }
        if (differ) wake();
    }

private:
    struct Server;

    explicit WindowStop (std::unique_ptr<Server>, Actions);
    void listen (const std::stop_token&);
    void wake() noexcept;   // the thread of this object, which otherwise waits for the X server

    static_assert (std::atomic<Area>::is_always_lock_free && std::atomic<std::uintptr_t>::is_always_lock_free, "the main thread must not delay a stop");

    std::unique_ptr<Server> server;
    Actions actions;
    std::atomic<Area> wanted { Area {} };
    std::array<std::atomic<std::uintptr_t>, most_others> others {};
    std::jthread listening;   // declared last, because this thread uses the other members
};

}   // namespace tactus::host
