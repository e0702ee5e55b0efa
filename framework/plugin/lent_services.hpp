// SPDX-License-Identifier: MIT
#pragma once

/// The services of the host, as a node in a plugin uses them.

#include "exported_asset.hpp"

#include <tactus/kit/geometry/nearest_triangle.hpp>
#include <tactus/kit/threads/async_query.hpp>
#include <tactus/node/node.hpp>

#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <vector>

namespace tactus::plugin
{

/// A search that the host has built.
class LentNearest final : public NearestTriangle
{
public:
    explicit LentNearest (const tactus_plugin_nearest& n) noexcept : nearest (n) {}
    LentNearest (const LentNearest&) = delete;
    LentNearest& operator= (const LentNearest&) = delete;
    ~LentNearest() override { nearest.destroy (nearest.context); }

    int operator() (const Vec3& p) const noexcept override { return nearest.find (nearest.context, p.data()); }

private:
    tactus_plugin_nearest nearest;
};

/// Passes questions on to the host.
class LentQueries final : public QueryService
{
public:
    explicit LentQueries (const tactus_plugin_services& s) noexcept : services (s) {}

    void add (AsyncQueryBase& query) override
    {
        const auto answer = [] (void* q) noexcept -> std::int32_t { return static_cast<AsyncQueryBase*> (q)->answer() ? 1 : 0; };
        const tactus_plugin_query shown { sizeof shown, &query, answer };
        void* handle = services.add_query (services.queries, &shown);
        if (handle == nullptr) throw std::bad_alloc();
        const std::scoped_lock lock { guard };
        handles[&query] = handle;
    }

    void remove (AsyncQueryBase& query) override
    {
        void* handle = nullptr;
        {
            const std::scoped_lock lock { guard };
            const auto found = handles.find (&query);
            if (found == handles.end()) return;
            handle = found->second;
            handles.erase (found);
        }
        services.remove_query (services.queries, handle);
    }

    bool isLate (bool ready) noexcept override { return services.is_late (services.queries, ready ? 1 : 0) != 0; }

private:
    tactus_plugin_services services;
    std::mutex guard;   // nodes that share a query may be freed on several threads
    std::map<const AsyncQueryBase*, void*> handles;
};

/// The services that the host lends to one node. This object must outlive the node.
class LentServices
{
public:
    /// The Setup for `prepare`. `answers` is valid as long as this object, the rest during the call. [main thread]
    Setup setup (const tactus_plugin_setup& s)
    {
        Setup made { .rate_hz = s.rate_hz };
        if (s.services == nullptr) return made;
        if (s.services->build_nearest != nullptr)
            made.services.nearest_triangle = [lent = s.services] (const std::shared_ptr<const Mesh>& m) { return build (*lent, *m); };
        if (s.services->add_query != nullptr)
        {
            queries.push_back (std::make_unique<LentQueries> (*s.services));   // the old ones stay: the node may still have questions there
            made.services.answers = queries.back().get();
        }
        return made;
    }

private:
    static std::unique_ptr<NearestTriangle> build (const tactus_plugin_services& services, const Mesh& mesh)
    {
        const auto arrays = ExportedAsset::meshOf (mesh);
        tactus_plugin_nearest built { sizeof built, nullptr, nullptr, nullptr };
        if (services.build_nearest (services.meshes, &arrays, &built, nullptr) != TACTUS_PLUGIN_OK) throw std::runtime_error ("the host cannot index the mesh");
        return std::make_unique<LentNearest> (built);
    }

    std::vector<std::unique_ptr<LentQueries>> queries;
};

}   // namespace tactus::plugin
