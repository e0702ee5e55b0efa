// SPDX-License-Identifier: MIT
#include "no_allocation.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <mutex>

TEST_CASE ("the watch on allocation sees an allocation, a release and a lock")
{
    if (! NoAllocation::watches)
    {
        WARN ("skipped: a sanitizer has its own allocator");
        return;
    }
    std::mutex mutex;
    int allocations = 0, locks = 0;
    {
        const NoAllocation watch;
        auto number = std::make_unique<int> (1);
        volatile int kept = *number;   // so that the allocation is not optimised away
        (void)kept;
        const std::lock_guard lock (mutex);
        allocations = watch.allocations();
        locks = watch.locks();
    }
    CHECK (allocations > 0);
    CHECK (locks == 1);
}
