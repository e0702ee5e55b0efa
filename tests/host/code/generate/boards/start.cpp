// SPDX-License-Identifier: MIT
// What a program needs on QEMU's mps2-an500 and mps2-an386: vectors, the floating-point unit, what newlib asks of a system, and a timer.

#include <sys/stat.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

extern "C"
{
    extern char bss_begin[], bss_end[], heap_begin[], heap_end[], stack_top[];
    int runMain() __asm__("main");
    void __libc_init_array();
    void* __dso_handle = nullptr;   // crtbegin.o is not linked
    void _init() {}
    void reset();
    void fault();

    /// Asks the debugger, which is QEMU.
    static std::uint32_t semihost (std::uint32_t what, const void* with)
    {
        register std::uint32_t r0 __asm__("r0") = what;
        register const void* r1 __asm__("r1") = with;
        __asm__ volatile("bkpt 0xab"
                         : "+r"(r0)
                         : "r"(r1)
                         : "memory");
        return r0;
    }

    int _write (int, const char* text, int size)
    {
        for (int i = 0; i < size; ++i)
            semihost (0x03, text + i);   // SYS_WRITEC
        return size;
    }

    [[noreturn]] void _exit (int status)
    {
        const std::uint32_t block[] { 0x20026, static_cast<std::uint32_t> (status) };   // ADP_Stopped_ApplicationExit
        semihost (0x20, block);                                                         // SYS_EXIT_EXTENDED
        for (;;)
        {
        }
    }

    /// Only for printf of the C library.
    void* _sbrk (int size)
    {
        static char* now = heap_begin;
        if (now + size > heap_end) return reinterpret_cast<void*> (-1);
        now += size;
        return now - size;
    }

    int _close (int) { return -1; }
    int _lseek (int, int, int) { return 0; }
    int _read (int, char*, int) { return 0; }
    int _isatty (int) { return 1; }
    int _getpid() { return 1; }
    int _kill (int, int) { return -1; }
    int _fstat (int, struct stat* s)
    {
        s->st_mode = S_IFCHR;
        return 0;
    }

    /// A 32-bit timer of 25 MHz that counts down.
    std::uint32_t timer() { return *reinterpret_cast<volatile std::uint32_t*> (0x40000004); }

    void reset()
    {
        *reinterpret_cast<volatile std::uint32_t*> (0xE000ED88) |= 0xFu << 20;   // access to the floating-point unit
        __asm__ volatile("dsb\nisb");
        std::memset (bss_begin, 0, static_cast<std::size_t> (bss_end - bss_begin));
        *reinterpret_cast<volatile std::uint32_t*> (0x40000008) = 0xffffffff;
        *reinterpret_cast<volatile std::uint32_t*> (0x40000000) = 1;
        __libc_init_array();
        _exit (runMain());
    }

    void fault()
    {
        const char text[] = "fault\n";
        _write (1, text, sizeof text - 1);
        _exit (99);
    }
}

__attribute__ ((section (".vectors"), used)) static const void* const vectors[] {
    stack_top, reinterpret_cast<const void*> (&reset), reinterpret_cast<const void*> (&fault), reinterpret_cast<const void*> (&fault),
    reinterpret_cast<const void*> (&fault), reinterpret_cast<const void*> (&fault), reinterpret_cast<const void*> (&fault)
};
