// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

namespace tactus
{

/// The results of a slow function of an object and some numbers, as long as the object lives, for a next plan that uses the same ones. The result of the
/// function must depend on nothing else. [any thread, but not the tick thread]
template <typename Object, typename Numbers, typename Result>
class KeptResults
{
public:
    template <typename Make>
    Result of (const std::shared_ptr<const Object>& object, const Numbers& numbers, Make make)
    {
        {
            const Turn turn (busy);
            std::erase_if (all, [] (const Entry& e) { return e.object.expired() || ! isAlive (e.result); });
            const auto kept = std::ranges::find_if (all, [&] (const Entry& e) { return e.object.lock() == object && e.numbers == numbers; });
            if (kept != all.end())
                if (auto result = alive (kept->result)) return *std::move (result);
        }
        Result made = make();   // meanwhile, another thread may make it, too
        const Turn turn (busy);
        all.push_back ({ object, numbers, keep (made) });
        return made;
    }

private:
    // A shared result is kept only as long as others use it, because it may use the object.
    template <typename T>
    static std::weak_ptr<T> keep (const std::shared_ptr<T>& made)
    {
        return made;
    }
    template <typename T>
    static T keep (const T& made)
    {
        return made;
    }
    template <typename T>
    static bool isAlive (const std::weak_ptr<T>& kept)
    {
        return ! kept.expired();
    }
    template <typename T>
    static bool isAlive (const T&)
    {
        return true;
    }
    template <typename T>
    static std::unique_ptr<std::shared_ptr<T>> alive (const std::weak_ptr<T>& kept)
    {
        auto shared = kept.lock();
        return shared ? std::make_unique<std::shared_ptr<T>> (std::move (shared)) : nullptr;
    }
    template <typename T>
    static std::unique_ptr<T> alive (const T& kept)
    {
        return std::make_unique<T> (kept);
    }

    struct Entry
    {
        std::weak_ptr<const Object> object;
        Numbers numbers;
        decltype (keep (std::declval<const Result&>())) result;
    };

    /// A lock that needs no system: boards have none. It is held for a few comparisons.
    struct Turn
    {
        explicit Turn (std::atomic_flag& f) : flag (f)
        {
            while (flag.test_and_set (std::memory_order_acquire))
            {
            }
        }
        ~Turn() { flag.clear (std::memory_order_release); }
        Turn (const Turn&) = delete;
        Turn& operator= (const Turn&) = delete;

        std::atomic_flag& flag;
    };

    std::atomic_flag busy;
    std::vector<Entry> all;
};

}   // namespace tactus
