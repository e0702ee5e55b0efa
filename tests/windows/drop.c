/* SPDX-License-Identifier: MIT */
/* drop.exe FILE X Y: a small window at this place of the screen, which is dragged as this file, as one drags it out of Explorer. Prints "ready", and then
 * "dropped" or "refused". */
#define COBJMACROS
#include <ole2.h>
#include <shellapi.h>
#include <shlobj.h>
#include <windows.h>

#include <stdio.h>
#include <stdlib.h>

static IDataObject* file;

static HRESULT WINAPI query (IDropSource* self, REFIID id, void** to)
{
    const BOOL is = IsEqualIID (id, &IID_IUnknown) || IsEqualIID (id, &IID_IDropSource);
    *to = is ? self : NULL;
    return is ? S_OK : E_NOINTERFACE;
}

static ULONG WINAPI count (IDropSource* self)
{
    (void)self;
    return 1;
}

static HRESULT WINAPI go_on (IDropSource* self, BOOL is_escaped, DWORD keys)
{
    (void)self;
    if (is_escaped) return DRAGDROP_S_CANCEL;
    return (keys & MK_LBUTTON) != 0 ? S_OK : DRAGDROP_S_DROP;
}

static HRESULT WINAPI feedback (IDropSource* self, DWORD effect)
{
    (void)self;
    (void)effect;
    return DRAGDROP_S_USEDEFAULTCURSORS;
}

static LRESULT CALLBACK proceed (HWND window, UINT message, WPARAM w, LPARAM l)
{
    if (message != WM_LBUTTONDOWN) return DefWindowProcW (window, message, w, l);
    static IDropSourceVtbl functions = { query, count, count, go_on, feedback };
    static IDropSource source = { &functions };
    DWORD effect = DROPEFFECT_NONE;
    const HRESULT ended = DoDragDrop (file, &source, DROPEFFECT_COPY, &effect);
    printf (ended == DRAGDROP_S_DROP && effect != DROPEFFECT_NONE ? "dropped\n" : "refused\n");
    fflush (stdout);
    PostQuitMessage (0);
    return 0;
}

int wmain (int argc, wchar_t** argv)
{
    PIDLIST_ABSOLUTE place;
    PCUITEMID_CHILD name;
    IShellFolder* folder;
    if (argc != 4 || FAILED (OleInitialize (NULL)) || FAILED (SHParseDisplayName (argv[1], NULL, &place, 0, NULL))
        || FAILED (SHBindToParent (place, &IID_IShellFolder, (void**)&folder, &name))
        || FAILED (IShellFolder_GetUIObjectOf (folder, NULL, 1, &name, &IID_IDataObject, NULL, (void**)&file)))
    {
        printf ("there is no such file\n");
        return 1;
    }
    const WNDCLASSW kind = { .lpfnWndProc = proceed, .hInstance = GetModuleHandleW (NULL), .lpszClassName = L"file" };
    RegisterClassW (&kind);
    const int x = _wtoi (argv[2]), y = _wtoi (argv[3]);
    const HWND window =
        CreateWindowExW (WS_EX_TOPMOST | WS_EX_TOOLWINDOW, L"file", L"file", WS_POPUP | WS_VISIBLE, x, y, 40, 40, NULL, NULL, kind.hInstance, NULL);
    UpdateWindow (window);
    printf ("ready\n");
    fflush (stdout);
    for (MSG message; GetMessageW (&message, NULL, 0, 0) > 0;)
        DispatchMessageW (&message);
    OleUninitialize();
    return 0;
}
