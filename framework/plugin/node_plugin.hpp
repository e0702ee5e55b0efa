// SPDX-License-Identifier: MIT
#pragma once

/// Makes a plugin of nodes. The header of a node stays as it is; one source file has these lines:
///
///     #include <tactus/plugin/node_plugin.hpp>
///     #include "ripple.hpp"
///     TACTUS_PLUGIN (my::Ripple)
///
/// TACTUS_PLUGIN takes several nodes: TACTUS_PLUGIN (my::Ripple, my::Dent). In CMake, tactus_add_plugin builds it. docs/plugins.md

#include "described.hpp"
#include "device_link.hpp"
#include "lent_services.hpp"

#include <tactus/kit/state_archive.hpp>

#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace tactus::plugin
{

/// A node as the host holds it, with what it borrows. The node is first: then a pointer to both is also a pointer to the node, and the
/// host can call the same functions as for a node that is compiled in.
template <typename N>
struct Hosted
{
    Hosted() : node() {}
    Hosted (const Hosted&) = delete;
    Hosted& operator= (const Hosted&) = delete;
    ~Hosted() { node.~N(); }   // before what it borrows

    union
    {
        N node;
    };
    LentServices services {};
    DeviceLink device {};
};

inline void put (const tactus_plugin_report* report, const std::string& text) noexcept
{
    if (report != nullptr) report->put (report->context, text.data(), text.size());
}

/// Runs a hook so that no exception leaves it.
template <typename F>
std::int32_t guarded (const tactus_plugin_report* report, F&& hook) noexcept
{
    try
    {
        hook();
        return TACTUS_PLUGIN_OK;
    }
    catch (const std::exception& e)
    {
        if (report != nullptr) report->put (report->context, e.what(), std::char_traits<char>::length (e.what()));
    }
    catch (...)
    {
        if (report != nullptr) report->put (report->context, "an unknown exception", 20);
    }
    return TACTUS_PLUGIN_FAILED;
}

/// Fills a struct of the host with the members that both sides know.
template <typename T>
void give (T* to, T from) noexcept
{
    from.size = to->size;
    std::copy_n (reinterpret_cast<const char*> (&from), std::min<std::size_t> (to->size, sizeof from), reinterpret_cast<char*> (to));
}

/// The functions of a node type that the host calls.
template <Node N>
struct Hooks
{
    using NodeAdapter = detail::NodeAdapter<N>;

    static Hosted<N>& hosted (void* node) noexcept { return *static_cast<Hosted<N>*> (node); }
    static const N& read (const void* node) noexcept { return static_cast<const Hosted<N>*> (node)->node; }

    static const NodeType& type()
    {
        static const NodeType one = describe<N>();
        return one;
    }

    static void* create (const tactus_plugin_report* report) noexcept
    {
        void* made = nullptr;
        guarded (report, [&] { made = new Hosted<N>(); });
        return made;
    }

    static void destroy (void* node) noexcept { delete static_cast<Hosted<N>*> (node); }

    static std::int32_t set (void* node, std::size_t setting, const tactus_plugin_value* value, const tactus_plugin_report* report) noexcept
    {
        return guarded (report, [&] { type().settings.at (setting).set (&hosted (node).node, readValue (*value, Keep::yes)); });
    }

    static void* params (void* node) noexcept { return &hosted (node).node.params; }
    static void initialiseOutputs (void* outputs) noexcept { new (outputs) typename N::Outputs(); }

    /// The hook `f` of a device node that cannot read the host's state in place. The first hook of each tick renews the copy.
    template <auto f, typename... Arguments>
    static void renewFirst (void* node, Arguments... arguments) noexcept
    {
        hosted (node).device.renew();
        f (node, arguments...);
    }

    static void fillCopying (tactus_plugin_node& c) noexcept
    {
        if constexpr (Peekable<N>)
            c.peek = &renewFirst<&NodeAdapter::peek>;
        else
        {
            c.tick = &renewFirst<&NodeAdapter::tick>;
            if constexpr (KnowsStored<N>) c.tick_stored = &renewFirst<&NodeAdapter::tickStored>;
        }
    }

    static void learn (void* node, const tactus_plugin_mechanics* device) noexcept
    {
        hosted (node).node.learn (DeviceMechanics { .mass = device->mass, .damping = device->damping });
    }

    static std::int32_t prepare (void* node, const tactus_plugin_setup* setup, const tactus_plugin_report* report) noexcept
    {
        return guarded (report, [&] { hosted (node).node.prepare (hosted (node).services.setup (*setup)); });
    }

    static std::int32_t warning (const void* node, const tactus_plugin_setup* setup, const tactus_plugin_report* report) noexcept
    {
        return guarded (report, [&] { put (report, read (node).warning (Setup { .rate_hz = setup->rate_hz })); });
    }

    static std::int32_t cost (const void* node, tactus_plugin_cost* to, const tactus_plugin_report* report) noexcept
    {
        return guarded (report, [&] {
            const Cost c = read (node).cost();
            give (to, { sizeof (tactus_plugin_cost), c.work, c.memory });
        });
    }

    static std::int32_t claims (const void* node, tactus_plugin_claims* to, const tactus_plugin_report* report) noexcept
    {
        return guarded (report, [&] {
            const Claims c = read (node).claims();
            give (to, { sizeof (tactus_plugin_claims), c.passive, c.stiffness, c.damping, c.spatial_frequency, c.amplitude });
        });
    }

    static std::int32_t announce (void* node, const tactus_plugin_device* device, const tactus_plugin_report* report) noexcept
    {
        return guarded (report, [&] { hosted (node).device.announce (*device); });
    }

    static void serialize (void* node, StateArchive& archive)
    {
        if constexpr (Savable<N>) hosted (node).node.serialize (archive);
        if (archive.restores() && ! archive.isAtEnd()) archive.refuse ("has bytes that nothing reads");
        if (archive.isRefused()) throw std::runtime_error (archive.refusal());
    }

    static std::int32_t save (const void* node, const tactus_plugin_report* report) noexcept
    {
        return guarded (report, [&] {
            std::vector<std::byte> bytes;
            StateArchive archive { bytes };
            serialize (const_cast<void*> (node), archive);   // which changes nothing while it saves
            report->put (report->context, reinterpret_cast<const char*> (bytes.data()), bytes.size());
        });
    }

    static std::int32_t restore (void* node, const void* bytes, std::size_t size, const tactus_plugin_report* report) noexcept
    {
        return guarded (report, [&] {
            StateArchive archive { std::span (static_cast<const std::byte*> (bytes), size) };
            serialize (node, archive);
        });
    }

    static void fill (tactus_plugin_node& c)
    {
        c.create = &create;
        c.destroy = &destroy;
        c.set = &set;
        c.params = &params;
        c.initialise_outputs = &initialiseOutputs;
        c.tick = &NodeAdapter::tick;
        if constexpr (KnowsStored<N>) c.tick_stored = &NodeAdapter::tickStored;
        if constexpr (LearnsOfDevice<N>) c.learn = &learn;
        if constexpr (Peekable<N>) c.peek = &NodeAdapter::peek;
        if constexpr (Delaying<N>) c.delay = [] (const void* n) noexcept -> std::int32_t { return read (n).delay(); };
        if constexpr (Updatable<N>) c.update = [] (void* n) noexcept { hosted (n).node.update(); };
        if constexpr (Adoptable<N>) c.adopt = [] (void* n, const void* old) noexcept { hosted (n).node.adopt (read (old)); };
        if constexpr (Savable<N> || Unchanging<N>)
        {
            c.save = &save;
            c.restore = &restore;
        }
        if constexpr (Costly<N>) c.cost = &cost;
        if constexpr (SelfChecking<N>)
            c.problem = [] (const void* n, const tactus_plugin_report* r) noexcept { return guarded (r, [&] { put (r, read (n).problem()); }); };
        if constexpr (Warning<N>) c.warning = &warning;
        if constexpr (Preparable<N>) c.prepare = &prepare;
        if constexpr (Claiming<N>) c.claims = &claims;
        if constexpr (DeviceBound<N>)
        {
            if (! DeviceLink::in_place) fillCopying (c);
            c.announce = &announce;
            c.bind = [] (void* n) noexcept { hosted (n).node.bind (hosted (n).device.bind()); };
        }
        if constexpr (NamesDeviceParts<N>)
            c.missing = [] (const void* n, const tactus_plugin_layout* l, const tactus_plugin_report* r) noexcept {
                return guarded (r, [&] { put (r, read (n).missing (readLayout (*l))); });
            };
        if constexpr (Sink<N>) c.effort = [] (const void* n, tactus_plugin_effort* to) noexcept { show (read (n).effort(), *to); };
    }
};

/// The nodes of this plugin.
template <Node... N>
struct Exported
{
    static inline int users = 0;   // calls to init that no deinit has followed yet   [main thread]

    static std::vector<std::unique_ptr<Described>>& all() noexcept
    {
        static std::vector<std::unique_ptr<Described>> nodes;
        return nodes;
    }

    template <Node One>
    static void add()
    {
        all().push_back (std::make_unique<Described> (Hooks<One>::type()));
        Hooks<One>::fill (all().back()->node);
    }

    static std::int32_t init (const tactus_plugin_host* host, const tactus_plugin_report* report) noexcept
    {
        const bool is_first = users++ == 0;
        return guarded (report, [&] {
            const bool shares = sharesDeviceState (host);
            if (is_first)
            {
                DeviceLink::in_place = shares;
                (add<N>(), ...);
            }
            else if (DeviceLink::in_place && ! shares)
                throw std::runtime_error ("another version of Tactus in this program uses the plugin");
        });
    }

    static void deinit() noexcept
    {
        if (--users == 0) all().clear();
    }
    static std::size_t count() noexcept { return all().size(); }
    static const tactus_plugin_node* node (std::size_t i) noexcept { return i < count() ? &all()[i]->node : nullptr; }
    static const void* extension (const char*) noexcept { return nullptr; }

    static constexpr tactus_plugin entry (const char* name, const char* version) noexcept
    {
        return { sizeof (tactus_plugin), TACTUS_PLUGIN_ABI, name, version, &init, &deinit, &count, &node, &extension };
    }
};

}   // namespace tactus::plugin

// tactus_add_plugin defines these.
#if ! defined(TACTUS_PLUGIN_NAME)
#define TACTUS_PLUGIN_NAME ""
#endif
#if ! defined(TACTUS_PLUGIN_VERSION)
#define TACTUS_PLUGIN_VERSION ""
#endif

/// Exports nodes. Once per plugin, in a source file, outside of any namespace.
#define TACTUS_PLUGIN(...)                                                    \
    extern "C" TACTUS_PLUGIN_EXPORT const tactus_plugin tactus_plugin_entry = \
        ::tactus::plugin::Exported<__VA_ARGS__>::entry (TACTUS_PLUGIN_NAME, TACTUS_PLUGIN_VERSION);
