// SPDX-License-Identifier: MIT
#include "prepared_shelf.hpp"

#include <algorithm>
#include <mutex>

namespace tactus::plan
{

namespace
{
class Shelf final : public PreparedData
{
public:
    std::shared_ptr<const void> find (const Key& key) override
    {
        const std::lock_guard lock (mutex);
        std::erase_if (items, [] (const Item& i) { return i.data.expired() || (i.kept && i.source.expired()); });
        for (const auto& i : items)
            if (i.type == key.type && isSame (i.source, key.source) && i.rest == key.rest)
                if (auto data = i.data.lock()) return data;
        return nullptr;
    }

    void keep (const Key& key, const std::shared_ptr<const void>& data, Until until) override
    {
        const std::lock_guard lock (mutex);
        items.push_back ({ key.source, key.rest, key.type, data, until == Until::no_source && key.source ? data : nullptr });
    }

private:
    // Compares owners, because addresses may be used again.
    static bool isSame (const std::weak_ptr<const void>& a, const std::shared_ptr<const void>& b) { return ! a.owner_before (b) && ! b.owner_before (a); }

    struct Item
    {
        std::weak_ptr<const void> source;
        std::string rest;
        const void* type;
        std::weak_ptr<const void> data;
        std::shared_ptr<const void> kept;   // the data, if they live as long as their source
    };
    std::mutex mutex;
    std::vector<Item> items;
};
}   // namespace

PreparedData& preparedOfAll()
{
    static Shelf shelf;
    return shelf;
}

}   // namespace tactus::plan
