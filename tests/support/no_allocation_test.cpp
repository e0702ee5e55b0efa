// SPDX-License-Identifier: MIT
#include "no_allocation.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <mutex>
#include <shared_mutex>

TEST_CASE ("NoAllocation counts an allocation, a release and locks")
{
    if (! NoAllocation::watches)
    {
        WARN ("skipped: a sanitizer has its own allocator");
        return;
    }
    std::mutex mutex;
    std::shared_mutex shared;
    int allocations = 0, locks = 0;
    {
        const NoAllocation watch;
        auto number = std::make_unique<int> (1);
        volatile int kept = *number;   // so that the allocation is not optimised away
        (void)kept;
        {
            const std::lock_guard lock (mutex);
        }
        const std::unique_lock tried (mutex, std::try_to_lock);
        {
            const std::shared_lock reading (shared);
        }
        const std::lock_guard writing (shared);
        allocations = watch.allocations();
        locks = watch.locks();
    }
    CHECK (allocations > 0);
    CHECK (locks == 4);
}
