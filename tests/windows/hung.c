/* SPDX-License-Identifier: MIT */
/* hung.exe: makes the thread of Tactus's window hang. For each line of its input, "escape" or "click X Y", it presses Esc, or the left button at this place
 * of the screen. When the input ends, the thread goes on. It gives keys and clicks to Windows itself: in wine, those of X11 pass through the thread of the
 * window. */
#include <windows.h>

#include <stdio.h>
#include <string.h>

static BOOL CALLBACK find (HWND window, LPARAM found)
{
    char title[256];
    const int size = GetWindowTextA (window, title, sizeof title);
    if (! IsWindowVisible (window) || size < 6 || strcmp (title + size - 6, "Tactus") != 0) return TRUE;
    *(HWND*)found = window;
    return FALSE;
}

/* Suspends it where it waits for messages, so that it holds no lock: it has answered one before, and is at the place where it was after others. */
static BOOL hang (HANDLE thread, HWND window)
{
    DWORD64 places[3] = { 0 };
    for (int tries = 0; tries < 1000; ++tries)
    {
        DWORD_PTR unused;
        CONTEXT at = { .ContextFlags = CONTEXT_CONTROL };
        SendMessageTimeoutA (window, WM_NULL, 0, 0, 0, 5000, &unused);
        Sleep (5);
        if (SuspendThread (thread) == (DWORD)-1 || ! GetThreadContext (thread, &at)) return FALSE;
        if (at.Rip == places[0] && at.Rip == places[1] && at.Rip == places[2]) return TRUE;
        places[tries % 3] = at.Rip;
        ResumeThread (thread);
    }
    return FALSE;
}

static void click (int x, int y)
{
    INPUT move = { .type = INPUT_MOUSE, .mi = { .dwFlags = MOUSEEVENTF_MOVE | MOUSEEVENTF_ABSOLUTE } }, press = move, release = move;
    move.mi.dx = (2 * x + 1) * 32768 / GetSystemMetrics (SM_CXSCREEN); /* 65536 is the width of the screen */
    move.mi.dy = (2 * y + 1) * 32768 / GetSystemMetrics (SM_CYSCREEN);
    press.mi.dwFlags = MOUSEEVENTF_LEFTDOWN;
    release.mi.dwFlags = MOUSEEVENTF_LEFTUP;
    SendInput (1, &move, sizeof move);
    SendInput (1, &press, sizeof press);
    SendInput (1, &release, sizeof release);
}

static void escape (void)
{
    INPUT press = { .type = INPUT_KEYBOARD, .ki = { .wVk = VK_ESCAPE, .wScan = 1 } }, release = press;
    release.ki.dwFlags = KEYEVENTF_KEYUP;
    SendInput (1, &press, sizeof press);
    SendInput (1, &release, sizeof release);
}

int main (void)
{
    HWND window = NULL;
    EnumWindows (find, (LPARAM)&window);
    const DWORD id = window != NULL ? GetWindowThreadProcessId (window, NULL) : 0;
    const HANDLE thread = OpenThread (THREAD_SUSPEND_RESUME | THREAD_GET_CONTEXT, FALSE, id);
    if (thread == NULL || ! hang (thread, window))
    {
        printf ("no window hangs\n");
        return 1;
    }
    DWORD_PTR unused;
    const BOOL answers = SendMessageTimeoutA (window, WM_NULL, 0, 0, 0, 500, &unused) != 0;
    printf (answers ? "it answers\n" : "hung\n");
    fflush (stdout);
    char line[64];
    while (fgets (line, sizeof line, stdin) != NULL)
    {
        int x, y;
        if (sscanf (line, "click %d %d", &x, &y) == 2)
            click (x, y);
        else
            escape();
        printf ("done\n");
        fflush (stdout);
    }
    ResumeThread (thread);
    return answers ? 1 : 0;
}
