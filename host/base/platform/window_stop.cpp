// SPDX-License-Identifier: MIT
#include "window_stop.hpp"

#include <tactus/run/realtime.hpp>
#include <tactus/text/caught.hpp>

#include <utility>

#if defined(TACTUS_XCB)
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <xcb/xcb.h>

#include <bitset>
#include <cstdlib>
#endif

namespace tactus::host
{

#if defined(TACTUS_XCB)

namespace
{
constexpr xcb_keysym_t escape_symbol = 0xff1b;      // XK_Escape
constexpr std::uintptr_t largest_id = 0x1fffffff;   // the X protocol leaves the top three bits of all ids at 0

template <typename T>
using Owned = std::unique_ptr<T, decltype (&std::free)>;

template <typename T>
Owned<T> owned (T* p) noexcept
{
    return { p, std::free };
}
}   // namespace

/// The connection to the X server, and what was created through it. After open(), only the thread `listening` uses this struct; others ring `bell`.
/// libxcb, unlike Xlib, has no error handlers that the whole process shares, and does not end the process if the server goes away.
struct WindowStop::Server
{
    ~Server()
    {
        xcb_disconnect (connection);   // the X server then destroys `glass`
        if (bell >= 0) close (bell);
    }

    bool isThere() const noexcept { return xcb_connection_has_error (connection) == 0; }

    void readKeyboard()
    {
        const auto* setup = xcb_get_setup (connection);
        const auto first = setup->min_keycode;
        const auto count = static_cast<std::uint8_t> (setup->max_keycode - first + 1);
        const auto map = owned (xcb_get_keyboard_mapping_reply (connection, xcb_get_keyboard_mapping (connection, first, count), nullptr));
        if (! map) return;
        const auto* symbols = xcb_get_keyboard_mapping_keysyms (map.get());
        escape.reset();
        for (int i = 0; i < xcb_get_keyboard_mapping_keysyms_length (map.get()); ++i)
            if (symbols[i] == escape_symbol) escape.set (static_cast<std::size_t> (first + i / map->keysyms_per_keycode));
    }

    /// True if the X server carries out the request.
    bool accepts (xcb_void_cookie_t request) const noexcept { return ! owned (xcb_request_check (connection, request)); }

    bool watch (xcb_window_t window)
    {
        const std::uint32_t keys = XCB_EVENT_MASK_KEY_PRESS, clicks = XCB_EVENT_MASK_BUTTON_PRESS;
        glass = xcb_generate_id (connection);
        return accepts (xcb_change_window_attributes_checked (connection, window, XCB_CW_EVENT_MASK, &keys))
               && accepts (xcb_create_window_checked (connection, 0, glass, window, 0, 0, 1, 1, 0, XCB_WINDOW_CLASS_INPUT_ONLY, XCB_COPY_FROM_PARENT,
                                                      XCB_CW_EVENT_MASK, &clicks));
    }

    void place (const Area& area) noexcept
    {
        if (std::exchange (placed, area) == area) return;
        if (area.isEmpty())
            xcb_unmap_window (connection, glass);
        else
        {
            const std::uint32_t values[] { static_cast<std::uint32_t> (area.x), static_cast<std::uint32_t> (area.y), area.width, area.height };
            xcb_configure_window (connection, glass, XCB_CONFIG_WINDOW_X | XCB_CONFIG_WINDOW_Y | XCB_CONFIG_WINDOW_WIDTH | XCB_CONFIG_WINDOW_HEIGHT, values);
            xcb_map_window (connection, glass);
        }
        xcb_flush (connection);
    }

    /// If the window no longer exists, the X server answers with an error, which listen() ignores.
    void watchKeys (std::size_t i, std::uintptr_t window) noexcept
    {
        if (std::exchange (watched[i], window) == window || window == 0 || window > largest_id) return;
        const std::uint32_t keys = XCB_EVENT_MASK_KEY_PRESS;
        xcb_change_window_attributes (connection, static_cast<xcb_window_t> (window), XCB_CW_EVENT_MASK, &keys);
        xcb_flush (connection);
    }

    void handleEvents (const Actions& actions)
    {
        while (const auto event = owned (xcb_poll_for_event (connection)))
            switch (event->response_type & 0x7f)   // the top bit marks events that another client sent
            {
            case XCB_KEY_PRESS:
            {
                const auto& key = *reinterpret_cast<const xcb_key_press_event_t*> (event.get());
                if (escape[key.detail]) (key.state & XCB_MOD_MASK_SHIFT) != 0 ? actions.emergency_stop() : actions.escape();
                break;
            }
            case XCB_BUTTON_PRESS:   // button 4 and above are wheels
                if (reinterpret_cast<const xcb_button_press_event_t*> (event.get())->detail <= 3) actions.stop();
                break;
            case XCB_MAPPING_NOTIFY:
                readKeyboard();
                break;
            }
    }

    /// Sleeps until the X server sends something or another thread rings.
    void wait() const noexcept
    {
        std::array<pollfd, 2> either { pollfd { xcb_get_file_descriptor (connection), POLLIN, 0 }, pollfd { bell, POLLIN, 0 } };
        poll (either.data(), either.size(), -1);
        eventfd_t rings = 0;
        static_cast<void> (eventfd_read (bell, &rings));
    }

    xcb_connection_t* connection = nullptr;
    const int bell = eventfd (0, EFD_CLOEXEC | EFD_NONBLOCK);
    xcb_window_t glass = 0;       // the invisible window over the area that receives the clicks
    std::bitset<256> escape {};   // the key codes of Esc
    Area placed {};
    std::array<std::uintptr_t, most_others> watched {};
};

Result<std::unique_ptr<WindowStop>> WindowStop::open (std::uintptr_t window, Actions actions)
{
    auto server = std::make_unique<Server>();
    server->connection = xcb_connect (nullptr, nullptr);
    if (! server->isThere() || server->bell < 0)
        return Message::error ("stop/no_server", {}, "Tactus cannot open a second connection to the X server",
                               "let the X server accept more clients, or run the graph with `tactus play`");
    if (window == 0 || window > largest_id || ! server->watch (static_cast<xcb_window_t> (window)))
        return Message::error ("stop/no_window", {}, "the X server does not let Tactus watch its window", "run the graph with `tactus play`");
    server->readKeyboard();
    return std::unique_ptr<WindowStop> (new WindowStop (std::move (server), std::move (actions)));
}

WindowStop::WindowStop (std::unique_ptr<Server> s, Actions a)
    : server (std::move (s)), actions (std::move (a)), listening ([this] (const std::stop_token& stop) {
          while (! stop.stop_requested() && server->isThere())
              if (! caught ("the stop keys", [&] { listen (stop); })) actions.emergency_stop();   // a key may have been lost
      })
{
}

void WindowStop::listen (const std::stop_token& stop)
{
    static_cast<void> (raisePriority (priority::stop));   // if real-time priority is refused, the run reports that
    const std::stop_callback ring (stop, [this] { wake(); });
    while (! stop.stop_requested() && server->isThere())
    {
        server->place (wanted);
        for (std::size_t i = 0; i < others.size(); ++i)
            server->watchKeys (i, others[i]);
        server->handleEvents (actions);   // before waiting: a request that was sent may have read events that had arrived
        server->wait();
    }
}

void WindowStop::wake() noexcept
{
    static_cast<void> (eventfd_write (server->bell, 1));   // fails only if it has rung very often, and then the thread wakes all the same
}

#elif ! defined(_WIN32)   // there, windows/window_stop.cpp

struct WindowStop::Server
{
};

Result<std::unique_ptr<WindowStop>> WindowStop::open (std::uintptr_t, Actions)
{
    return Message::error ("stop/no_server", {}, "this program was built without libxcb", "run the graph with `tactus play`");
}

WindowStop::WindowStop (std::unique_ptr<Server> s, Actions a) : server (std::move (s)), actions (std::move (a)) {}
void WindowStop::listen (const std::stop_token&) {}
void WindowStop::wake() noexcept {}

#endif

#if ! defined(_WIN32)
WindowStop::~WindowStop() = default;
#endif

}   // namespace tactus::host
