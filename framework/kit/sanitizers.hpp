// SPDX-License-Identifier: MIT
#pragma once

/// 1 in code that is instrumented by ASan or TSan, which have their own allocator and make their own system calls; 0 in other code.
#define TACTUS_SANITIZED 0

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)   // GCC, MSVC
#undef TACTUS_SANITIZED
#define TACTUS_SANITIZED 1
#elif defined(__has_feature)   // Clang
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#undef TACTUS_SANITIZED
#define TACTUS_SANITIZED 1
#endif
#endif
