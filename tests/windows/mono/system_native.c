/* SPDX-License-Identifier: MIT */
/* System.Native.dll: what the classes of Debian's Mono, which are compiled for Linux, call of Linux while they run the tests of Tactus.cs in wine. */
#include <sys/stat.h>
#include <windows.h>

#include <stdint.h>

enum
{
    folder = 0x41ff,
    plain_file = 0x81ff,
    no_entry = 0x1002d /* as Mono numbers ENOENT */
};

struct status
{
    int32_t flags, mode;
    uint32_t user, group;
    int64_t size, accessed[2], modified[2], changed[2], born[2], device, node;
    uint32_t user_flags;
};

__declspec(dllexport) int32_t SystemNative_LChflagsCanSetHiddenFlag (void) { return 0; }

__declspec(dllexport) int32_t SystemNative_Stat2 (const char* path, struct status* to)
{
    wchar_t wide[1024];
    struct _stat64 found;
    if (MultiByteToWideChar (CP_UTF8, 0, path, -1, wide, 1024) == 0 || _wstat64 (wide, &found) != 0) return -1;
    *to = (struct status) { .mode = (found.st_mode & _S_IFDIR) != 0 ? folder : plain_file, .size = found.st_size };
    return 0;
}

__declspec(dllexport) int32_t SystemNative_LStat2 (const char* path, struct status* to) { return SystemNative_Stat2 (path, to); }

__declspec(dllexport) int32_t SystemNative_ConvertErrorPlatformToPal (int32_t error)
{
    (void)error;
    return no_entry;
}
