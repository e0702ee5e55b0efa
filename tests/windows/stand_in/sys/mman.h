// SPDX-License-Identifier: MIT
// A stand-in for the shared memory of POSIX: a whole file that stays mapped.
#pragma once

#include <windows.h>

#include <fcntl.h>
#include <io.h>

#define O_CLOEXEC (_O_NOINHERIT | _O_BINARY)
#define PROT_READ 1
#define PROT_WRITE 2
#define MAP_SHARED 1
#define MAP_FAILED nullptr

inline void* mmap (void*, size_t size, int, int, int file, int)
{
    const auto memory = ::CreateFileMappingW (reinterpret_cast<HANDLE> (::_get_osfhandle (file)), nullptr, PAGE_READWRITE, 0, static_cast<DWORD> (size), nullptr);
    return memory != nullptr ? ::MapViewOfFile (memory, FILE_MAP_ALL_ACCESS, 0, 0, size) : nullptr;
}
