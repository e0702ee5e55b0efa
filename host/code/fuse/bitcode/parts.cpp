// SPDX-License-Identifier: MIT
// The steps of a plan that are not nodes, for wiring (host/code/fuse/wiring_writer.hpp). The build compiles this file to bitcode.
#include <tactus/run/generated/fused_parts.hpp>

using namespace tactus;

extern "C"
{
    /// Part of each shared object, to tell it from others when the program ends. A compiler adds it when it links; the linker alone does not.
    [[gnu::visibility ("hidden")]] void* __dso_handle = &__dso_handle;

    [[gnu::always_inline]] double tactus_fused_sum_1 (double a) noexcept { return fused::sumOf (a); }
    [[gnu::always_inline]] double tactus_fused_sum_2 (double a, double b) noexcept { return fused::sumOf (a, b); }
    [[gnu::always_inline]] double tactus_fused_sum_3 (double a, double b, double c) noexcept { return fused::sumOf (a, b, c); }
    [[gnu::always_inline]] double tactus_fused_sum_4 (double a, double b, double c, double d) noexcept { return fused::sumOf (a, b, c, d); }
    [[gnu::always_inline]] double tactus_fused_sum (double* all, int n) noexcept { return plan::sum (all, n); }

    [[gnu::always_inline]] double tactus_fused_struck (double by_wires, double* pending) noexcept { return fused::struck (by_wires, *pending); }

    [[gnu::always_inline]] double tactus_fused_delayed (const double* samples, const std::size_t* now, double* out) noexcept
    {
        return fused::delayed (*samples, *now, *out);
    }
    [[gnu::always_inline]] void tactus_fused_delay (double value, double* samples, std::size_t* now, std::size_t size) noexcept
    {
        fused::delay (value, *samples, *now, size);
    }

    [[gnu::always_inline]] void tactus_fused_deliver (double* out, double* gathered) noexcept { fused::deliver (*out, *gathered); }
    [[gnu::always_inline]] void tactus_fused_head (double value, double* before, double* newest, bool* begun) noexcept
    {
        fused::head (value, *before, *newest, *begun);
    }
    [[gnu::always_inline]] double tactus_fused_follow (double value, const double* before, const double* newest, const bool* begun, double part) noexcept
    {
        return fused::follow (value, *before, *newest, *begun, part);
    }

    /// `flags` is a fused::Driven.
    [[gnu::always_inline]] void tactus_fused_drive (void* flags, double* target, double stored, double added, double min, double max) noexcept
    {
        (*static_cast<fused::Driven*> (flags)) (*target, stored, added, min, max);
    }

    [[gnu::always_inline]] void tactus_fused_run (void* const* objects, std::size_t first) noexcept { fused::Objects { objects }.run (first); }
}
