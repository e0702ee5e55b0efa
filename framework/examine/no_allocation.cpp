// SPDX-License-Identifier: MIT
#if __has_include(<features.h>)
#include <features.h>
#endif

#include "no_allocation.hpp"

#include <cerrno>
#include <cstddef>

#if defined(__GLIBC__)
#include <dlfcn.h>
#include <pthread.h>
#endif

namespace
{
thread_local bool watching = false;
thread_local int allocations_seen = 0;
thread_local int locks_seen = 0;

[[maybe_unused]] void allocating() noexcept
{
    if (watching) ++allocations_seen;
}
}   // namespace

namespace tactus::examine
{
NoAllocation::NoAllocation() noexcept
{
    allocations_seen = locks_seen = 0;
    watching = true;
}
NoAllocation::~NoAllocation() { watching = false; }
int NoAllocation::allocations() const noexcept { return allocations_seen; }
int NoAllocation::locks() const noexcept { return locks_seen; }
}   // namespace tactus::examine

#if ! TACTUS_SANITIZED && defined(__GLIBC__)

namespace
{
/// The libc function of this name, which the wrapper below overrides.
template <typename Lock>
auto next (const char* name) noexcept
{
    return reinterpret_cast<int (*) (Lock*)> (dlsym (RTLD_NEXT, name));
}

template <typename Lock>
int locking (int (*real) (Lock*), Lock* lock) noexcept
{
    if (watching) ++locks_seen;
    return real (lock);
}
}   // namespace

// The executable's own symbols take precedence over libc's, even for calls from inside libstdc++.
// Long because it is one list of short wrappers, one for each function that is counted.
extern "C"
{
    void* __libc_malloc (std::size_t);
    void __libc_free (void*);
    void* __libc_realloc (void*, std::size_t);
    void* __libc_calloc (std::size_t, std::size_t);
    void* __libc_memalign (std::size_t, std::size_t);

    void* malloc (std::size_t n) noexcept
    {
        allocating();
        return __libc_malloc (n);
    }
    void free (void* p) noexcept
    {
        if (p) allocating();
        __libc_free (p);
    }
    void* realloc (void* p, std::size_t n) noexcept
    {
        allocating();
        return __libc_realloc (p, n);
    }
    void* calloc (std::size_t count, std::size_t n) noexcept
    {
        allocating();
        return __libc_calloc (count, n);
    }
    void* memalign (std::size_t alignment, std::size_t n) noexcept
    {
        allocating();
        return __libc_memalign (alignment, n);
    }
    void* aligned_alloc (std::size_t alignment, std::size_t n) noexcept
    {
        allocating();
        return __libc_memalign (alignment, n);
    }
    int posix_memalign (void** p, std::size_t alignment, std::size_t n) noexcept
    {
        allocating();
        *p = __libc_memalign (alignment, n);
        return *p ? 0 : ENOMEM;
    }
    int pthread_mutex_lock (pthread_mutex_t* m) noexcept
    {
        static const auto real = next<pthread_mutex_t> ("pthread_mutex_lock");
        return locking (real, m);
    }
    int pthread_mutex_trylock (pthread_mutex_t* m) noexcept
    {
        static const auto real = next<pthread_mutex_t> ("pthread_mutex_trylock");
        return locking (real, m);
    }
    int pthread_rwlock_rdlock (pthread_rwlock_t* l) noexcept
    {
        static const auto real = next<pthread_rwlock_t> ("pthread_rwlock_rdlock");
        return locking (real, l);
    }
    int pthread_rwlock_wrlock (pthread_rwlock_t* l) noexcept
    {
        static const auto real = next<pthread_rwlock_t> ("pthread_rwlock_wrlock");
        return locking (real, l);
    }
}

#endif
