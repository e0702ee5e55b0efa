// SPDX-License-Identifier: MIT
// The stop keys and clicks of window_stop.hpp on Windows: hooks on a thread of their own. Windows gives a hook each key and click before the window, also
// while the thread of the window is busy. It removes, without saying so, a hook whose thread does not answer for a third of a second.
#if defined(_WIN32)
#include <host/base/platform/window_stop.hpp>

#include <tactus/run/realtime.hpp>
#include <tactus/text/caught.hpp>

#include <windows.h>

#include <future>
#include <utility>

namespace tactus::host
{

struct WindowStop::Server
{
    explicit Server (HWND w) noexcept : window (w) {}
    ~Server() { CloseHandle (bell); }

    static LRESULT CALLBACK onKey (int code, WPARAM what, LPARAM data) noexcept
    {
        const auto& key = *reinterpret_cast<const KBDLLHOOKSTRUCT*> (data);
        if (code == HC_ACTION && (what == WM_KEYDOWN || what == WM_SYSKEYDOWN) && key.vkCode == VK_ESCAPE && isOurs (GetForegroundWindow()))
            GetAsyncKeyState (VK_SHIFT) < 0 ? current->actions->emergency_stop() : current->actions->escape();
        return CallNextHookEx (nullptr, code, what, data);
    }

    /// Takes clicks on the area, and their releases, away from the window, whose button may be START by the time that it gets them.
    static LRESULT CALLBACK onMouse (int code, WPARAM what, LPARAM data) noexcept
    {
        const bool presses = what == WM_LBUTTONDOWN || what == WM_RBUTTONDOWN || what == WM_MBUTTONDOWN;
        const bool releases = what == WM_LBUTTONUP || what == WM_RBUTTONUP || what == WM_MBUTTONUP;
        if (code == HC_ACTION && presses && current->isInArea (reinterpret_cast<const MSLLHOOKSTRUCT*> (data)->pt))
        {
            current->actions->stop();
            current->taken = what;
            return 1;
        }
        if (code == HC_ACTION && releases && what == current->taken + 1)   // each release is the message after its press
        {
            current->taken = 0;
            return 1;
        }
        return CallNextHookEx (nullptr, code, what, data);
    }

    static bool isOurs (HWND window) noexcept
    {
        DWORD process = 0;
        return GetWindowThreadProcessId (window, &process) != 0 && process == GetCurrentProcessId();
    }

    /// Only where no other window covers it.
    bool isInArea (POINT p) const noexcept
    {
        const Area area = *wanted;
        if (area.isEmpty() || WindowFromPoint (p) != window || ! ScreenToClient (window, &p)) return false;
        return p.x >= area.x && p.y >= area.y && p.x < area.x + area.width && p.y < area.y + area.height;
    }

    static thread_local Server* current;   // of the thread whose hooks call

    const HWND window;
    const HANDLE bell = CreateEventW (nullptr, FALSE, FALSE, nullptr);
    const Actions* actions = nullptr;
    const std::atomic<Area>* wanted = nullptr;
    WPARAM taken = 0;   // the press of a click on the area, until its release; 0: none
    std::promise<bool> is_hooked {};
};

thread_local WindowStop::Server* WindowStop::Server::current = nullptr;

Result<std::unique_ptr<WindowStop>> WindowStop::open (std::uintptr_t window, Actions actions)
{
    auto server = std::make_unique<Server> (reinterpret_cast<HWND> (window));   // NOLINT(performance-no-int-to-ptr): as the header has it
    auto is_hooked = server->is_hooked.get_future();
    if (! IsWindow (server->window) || server->bell == nullptr)
        return Message::error ("stop/no_window", {}, "Windows does not let Tactus watch its window", "run the graph with `tactus play`");
    std::unique_ptr<WindowStop> made (new WindowStop (std::move (server), std::move (actions)));
    if (! is_hooked.get())
        return Message::error ("stop/no_server", {}, "Windows lets Tactus watch neither keys nor clicks", "run the graph with `tactus play`");
    return made;
}

WindowStop::WindowStop (std::unique_ptr<Server> s, Actions a)
    : server (std::move (s)), actions (std::move (a)), listening ([this] (const std::stop_token& stop) {
          if (! caught ("the stop keys", [&] { listen (stop); })) actions.emergency_stop();   // a key may have been lost
      })
{
}

void WindowStop::listen (const std::stop_token& stop)
{
    static_cast<void> (raisePriority (priority::stop));   // if it is refused, the run reports that
    const std::stop_callback ring (stop, [this] { wake(); });
    server->actions = &actions;
    server->wanted = &wanted;
    Server::current = server.get();
    const auto keys = SetWindowsHookExW (WH_KEYBOARD_LL, Server::onKey, GetModuleHandleW (nullptr), 0);
    const auto clicks = SetWindowsHookExW (WH_MOUSE_LL, Server::onMouse, GetModuleHandleW (nullptr), 0);
    server->is_hooked.set_value (keys != nullptr && clicks != nullptr);
    while (! stop.stop_requested())
    {
        MSG message;
        while (PeekMessageW (&message, nullptr, 0, 0, PM_REMOVE))   // hooks are called from within
            DispatchMessageW (&message);
        MsgWaitForMultipleObjects (1, &server->bell, FALSE, INFINITE, QS_ALLINPUT);
    }
    if (keys != nullptr) UnhookWindowsHookEx (keys);
    if (clicks != nullptr) UnhookWindowsHookEx (clicks);
}

void WindowStop::wake() noexcept { SetEvent (server->bell); }

WindowStop::~WindowStop() = default;

}   // namespace tactus::host
#endif
