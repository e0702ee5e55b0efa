/* SPDX-License-Identifier: MIT */
#ifndef TACTUS_PLUGIN_H
#define TACTUS_PLUGIN_H

/**
 * The binary interface between Tactus and node plugins. C++ authors need only <tactus/plugin/node_plugin.hpp>, which implements it.
 * See docs/plugins.md.
 *
 * A plugin is a shared object that exports one symbol, `tactus_plugin_entry`. It describes the plugin and lists its node types.
 *
 * Conventions
 *  - SI units. Text is UTF-8 and ends with a zero byte, unless a length is given with it.
 *  - Each struct begins with its size, which the side that fills the struct sets. Begin with its initialiser, such as TACTUS_PLUGIN_PORT_INIT for a
 *    tactus_plugin_port. Later versions may add members at the end. A reader uses a member only if the size covers it. Arrays of structs are arrays of
 *    pointers, so that their elements can grow.
 *  - What the plugin describes (entry, nodes, datasheets) stays valid and unchanged from init to deinit. What the host passes to a
 *    hook is valid during the call, unless the comment says otherwise.
 *  - No C++ exception and no longjmp crosses the interface. A hook that can fail returns TACTUS_PLUGIN_FAILED and says why in `report`.
 *  - [main thread]: no two calls at the same time for the same plugin, though not always on the same thread. [tick thread]: the
 *    thread that ticks the node, at the same time as calls for other nodes on other threads. A function for the tick thread does not
 *    allocate, lock, wait, call the system, read a clock or fail, and gives the same bits for the same inputs. While a node ticks, the
 *    main thread may call `announce`, and hooks that take the node as const.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define TACTUS_PLUGIN_EXTERN extern "C"
#define TACTUS_PLUGIN_NOEXCEPT noexcept
#else
#define TACTUS_PLUGIN_EXTERN extern
#define TACTUS_PLUGIN_NOEXCEPT
#endif

#if defined(_WIN32)
#define TACTUS_PLUGIN_EXPORT __declspec(dllexport)
#else
#define TACTUS_PLUGIN_EXPORT __attribute__ ((visibility ("default")))
#endif

/** The version of this interface. It grows only when plugins built for an older version can no longer be loaded. */
#define TACTUS_PLUGIN_ABI 1

enum
{
    TACTUS_PLUGIN_OK = 0,
    TACTUS_PLUGIN_FAILED = 1
};

/** Receives text from a hook: its answer, or why it failed. `text` needs no zero byte at its end. */
typedef struct tactus_plugin_report
{
    uint32_t size;
    void* context;
    void (*put) (void* context, const char* text, size_t length) TACTUS_PLUGIN_NOEXCEPT; /**< [the thread of the hook] */
} tactus_plugin_report;

#define TACTUS_PLUGIN_REPORT_INIT           \
    {                                       \
        sizeof (tactus_plugin_report), 0, 0 \
    }

/* ============================================================================ The datasheet */

enum
{
    TACTUS_PLUGIN_UNIT_FIXED = 0,  /**< always this unit */
    TACTUS_PLUGIN_UNIT_OPEN = 1,   /**< the unit of the wire; the same for all entries of a list */
    TACTUS_PLUGIN_UNIT_EACH = 2,   /**< the unit of the wire; each entry of a list has its own */
    TACTUS_PLUGIN_UNIT_SAME = 3,   /**< the unit of port `a`, times this unit */
    TACTUS_PLUGIN_UNIT_PRODUCT = 4 /**< the product of ports `a` and `b`; if `b` is "", of all entries of `a` */
};

typedef struct tactus_plugin_unit
{
    uint32_t size;
    int32_t rule;
    const char* quantity;            /**< "force", "length", …, as in framework/text/quantity.hpp; "any" if it has no name */
    int32_t metre, kilogram, second; /**< exponents */
    const char* symbol;              /**< "N" */
    const char *a, *b;               /**< ids of ports, or "" */
    int32_t adds_up;                 /**< 1: several wires of any unit may end at this input */
} tactus_plugin_unit;

#define TACTUS_PLUGIN_UNIT_INIT                                \
    {                                                          \
        sizeof (tactus_plugin_unit), 0, 0, 0, 0, 0, 0, 0, 0, 0 \
    }

typedef struct tactus_plugin_limits
{
    uint32_t size;
    int32_t latch;               /**< 1: read at contact onset only */
    double hard_min, hard_max;   /**< outside of these the model has no meaning */
    double usual_min, usual_max; /**< range of a slider */
} tactus_plugin_limits;

#define TACTUS_PLUGIN_LIMITS_INIT                            \
    {                                                        \
        sizeof (tactus_plugin_limits), 0, 0.0, 0.0, 0.0, 0.0 \
    }

enum
{
    TACTUS_PLUGIN_INPUT = 0,
    TACTUS_PLUGIN_PARAM = 1,
    TACTUS_PLUGIN_OUTPUT = 3
};

/** How many entries a list has among params and outputs. */
#define TACTUS_PLUGIN_LIST_CAPACITY 64

/** An input, a param or an output. Inputs are read through the `sources` of tick. A param is at `offset` of what `params` returns: one
 *  double, three for a vector, TACTUS_PLUGIN_LIST_CAPACITY for a list, or an int32_t if it has choices. An output is at `offset` of
 *  what tick fills, in the same form. */
typedef struct tactus_plugin_port
{
    uint32_t size;
    int32_t role;
    const char *id, *about;
    const tactus_plugin_unit* unit;
    const tactus_plugin_limits* limits;
    const char* const* choices; /**< names of a choice, which is 0 … n-1 */
    size_t choice_count;        /**< 0: not a choice */
    int32_t width;              /**< components: 1, or 3 for a vector */
    int32_t is_list;            /**< 1: an array port; the setting `inputs` is its length */
    size_t offset;              /**< not for inputs */
    double initial[3];          /**< default of each component; for a list, of each entry */
} tactus_plugin_port;

#define TACTUS_PLUGIN_PORT_INIT                                                      \
    {                                                                                \
        sizeof (tactus_plugin_port), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, { 0.0, 0.0, 0.0 } \
    }

enum
{
    TACTUS_PLUGIN_NUMBER = 0,
    TACTUS_PLUGIN_INTEGER = 1,
    TACTUS_PLUGIN_TEXT = 2,
    TACTUS_PLUGIN_VECTOR = 3,
    TACTUS_PLUGIN_NUMBERS = 4,
    TACTUS_PLUGIN_CURVE = 5,
    TACTUS_PLUGIN_LAW = 6,
    TACTUS_PLUGIN_RECORD = 7,
    TACTUS_PLUGIN_RECORDS = 8,
    TACTUS_PLUGIN_SIGNAL = 9,
    TACTUS_PLUGIN_IMAGE = 10,
    TACTUS_PLUGIN_TABLE = 11,
    TACTUS_PLUGIN_SURFACE = 12,
    TACTUS_PLUGIN_MESH = 13 /**< only as part of a surface */
};

enum
{
    TACTUS_PLUGIN_LAW_NONE = 0,
    TACTUS_PLUGIN_LAW_POWER = 1,       /**< a e^b */
    TACTUS_PLUGIN_LAW_EXPONENTIAL = 2, /**< a (exp (b e) - 1) */
    TACTUS_PLUGIN_LAW_TABLE = 3,       /**< straight lines between the points */
    TACTUS_PLUGIN_LAW_DISSIPATION = 4  /**< only for damping: a times the stiffness law given with it */
};

/** The content of a file, or a surface. It never changes, and is shared: code that keeps it, or a pointer into it, calls `retain`,
 *  and later `release`. As long as an asset is kept, the same content gives the same asset. [any thread] */
typedef struct tactus_plugin_asset
{
    uint32_t size;
    int32_t kind; /**< SIGNAL, IMAGE, TABLE, SURFACE or MESH: says what `content` points to */
    const void* content;
    void (*retain) (const struct tactus_plugin_asset*) TACTUS_PLUGIN_NOEXCEPT;  /**< [any thread] */
    void (*release) (const struct tactus_plugin_asset*) TACTUS_PLUGIN_NOEXCEPT; /**< [any thread] */
} tactus_plugin_asset;

#define TACTUS_PLUGIN_ASSET_INIT                 \
    {                                            \
        sizeof (tactus_plugin_asset), 0, 0, 0, 0 \
    }

/** The value of a setting. Only the members of its kind are used; the others are 0. */
typedef struct tactus_plugin_value
{
    uint32_t size;
    int32_t kind;
    double a, b;                                     /**< NUMBER, INTEGER: a. LAW: a and b */
    int32_t law;                                     /**< LAW */
    const char* text;                                /**< TEXT */
    const double *x, *y;                             /**< VECTOR, NUMBERS: x. CURVE, LAW of a table: x and y */
    size_t count;                                    /**< length of text, x, y and values */
    const struct tactus_plugin_value* const* values; /**< RECORD: its fields. RECORDS: values of kind RECORD */
    const tactus_plugin_asset* asset;                /**< SIGNAL, IMAGE, TABLE, SURFACE; NULL: not given */
} tactus_plugin_value;

#define TACTUS_PLUGIN_VALUE_INIT                                       \
    {                                                                  \
        sizeof (tactus_plugin_value), 0, 0.0, 0.0, 0, 0, 0, 0, 0, 0, 0 \
    }

typedef struct tactus_plugin_signal
{
    uint32_t size;
    double rate_hz;
    const double* const* channels;
    size_t channel_count, sample_count;
} tactus_plugin_signal;

#define TACTUS_PLUGIN_SIGNAL_INIT                   \
    {                                               \
        sizeof (tactus_plugin_signal), 0.0, 0, 0, 0 \
    }

/** An image or a table: rows x columns numbers, row after row. */
typedef struct tactus_plugin_grid
{
    uint32_t size;
    int32_t rows, columns;
    const double* values;
} tactus_plugin_grid;

#define TACTUS_PLUGIN_GRID_INIT              \
    {                                        \
        sizeof (tactus_plugin_grid), 0, 0, 0 \
    }

typedef struct tactus_plugin_mesh
{
    uint32_t size;
    const double* points; /**< x, y, z of each point, m */
    size_t point_count;
    const int32_t* triangles; /**< three points each, counted from 0, counter-clockwise as seen from outside */
    size_t triangle_count;
} tactus_plugin_mesh;

#define TACTUS_PLUGIN_MESH_INIT                 \
    {                                           \
        sizeof (tactus_plugin_mesh), 0, 0, 0, 0 \
    }

/** A body that can be touched; see framework/kit/geometry/surface.hpp. */
typedef struct tactus_plugin_surface
{
    uint32_t size;
    const tactus_plugin_asset* mesh;
    const double* frames; /**< 9 numbers per frame, row after row; no frames: derived from the mesh */
    size_t frame_count;
    const size_t* tools; /**< number of curve triples, by shape of tool */
    size_t tool_count;
    const tactus_plugin_value* const* curves; /**< three laws per triple, shape after shape */
    const tactus_plugin_value* const* mu;     /**< each is a NUMBER, a LAW or a CURVE */
    size_t mu_count;
    const double* weights;       /**< tool_count shares per entry, the entries of one tool after those of another; no entries: tool t is shape t */
    const size_t* weight_counts; /**< number of entries, by tool: one per node, or one for all nodes */
    size_t weighted_count;       /**< how many tools have entries */
} tactus_plugin_surface;

#define TACTUS_PLUGIN_SURFACE_INIT                                      \
    {                                                                   \
        sizeof (tactus_plugin_surface), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 \
    }

/** A setting, or a field of a record. */
typedef struct tactus_plugin_setting
{
    uint32_t size;
    int32_t kind;
    const char *id, *about;
    const tactus_plugin_unit *unit, *x_unit; /**< of the value, and of the argument of a curve or law */
    const tactus_plugin_limits* limits;
    const struct tactus_plugin_setting* const* fields; /**< of RECORD and RECORDS */
    size_t field_count;
    const tactus_plugin_value* initial;
} tactus_plugin_setting;

#define TACTUS_PLUGIN_SETTING_INIT                                \
    {                                                             \
        sizeof (tactus_plugin_setting), 0, 0, 0, 0, 0, 0, 0, 0, 0 \
    }

/* ============================================================================ What the host lends */

/** A search for the triangle of a mesh that is nearest to a point. */
typedef struct tactus_plugin_nearest
{
    uint32_t size;
    void* context;
    int32_t (*find) (void* context, const double point[3]) TACTUS_PLUGIN_NOEXCEPT; /**< index of the triangle [any thread] */
    void (*destroy) (void* context) TACTUS_PLUGIN_NOEXCEPT;                        /**< [main thread] */
} tactus_plugin_nearest;

#define TACTUS_PLUGIN_NEAREST_INIT              \
    {                                           \
        sizeof (tactus_plugin_nearest), 0, 0, 0 \
    }

/** Open questions of a node; see framework/kit/threads/async_query.hpp. */
typedef struct tactus_plugin_query
{
    uint32_t size;
    void* context;
    /** Answers all open questions. Returns 1 if there were any. [answering thread] */
    int32_t (*answer) (void* context) TACTUS_PLUGIN_NOEXCEPT;
} tactus_plugin_query;

#define TACTUS_PLUGIN_QUERY_INIT           \
    {                                      \
        sizeof (tactus_plugin_query), 0, 0 \
    }

/** What a host lends to nodes. The struct is valid during the call of the hook that gets it; `queries` as long as the node exists. */
typedef struct tactus_plugin_services
{
    uint32_t size;
    void* meshes;  /**< the first argument of build_nearest */
    void* queries; /**< the first argument of the functions below */
    /** NULL: the host has no search. Builds a search for the mesh, and fills the tactus_plugin_nearest. Copies the mesh if needed.
     *  [main thread, during prepare] */
    int32_t (*build_nearest) (void* meshes, const tactus_plugin_mesh*, tactus_plugin_nearest*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    /** NULL: the node computes each answer itself when it is due. Returns a handle for `remove_query`, NULL if it failed. [main thread] */
    void* (*add_query) (void* queries, const tactus_plugin_query*)TACTUS_PLUGIN_NOEXCEPT;
    /** After it returns, no question of the query is being answered. [main thread] */
    void (*remove_query) (void* queries, void* handle) TACTUS_PLUGIN_NOEXCEPT;
    int32_t (*is_late) (void* queries, int32_t ready) TACTUS_PLUGIN_NOEXCEPT; /**< 1: the answer due now is late; once per query and tick [tick thread] */
} tactus_plugin_services;

#define TACTUS_PLUGIN_SERVICES_INIT                       \
    {                                                     \
        sizeof (tactus_plugin_services), 0, 0, 0, 0, 0, 0 \
    }

typedef struct tactus_plugin_setup
{
    uint32_t size;
    double rate_hz;
    const tactus_plugin_services* services;
} tactus_plugin_setup;

#define TACTUS_PLUGIN_SETUP_INIT             \
    {                                        \
        sizeof (tactus_plugin_setup), 0.0, 0 \
    }

/** What is known about the mechanics of a device, at its tool. */
typedef struct tactus_plugin_mechanics
{
    uint32_t size;
    double mass;    /**< kg; 0: unknown */
    double damping; /**< N s/m; 0: unknown */
} tactus_plugin_mechanics;

#define TACTUS_PLUGIN_MECHANICS_INIT               \
    {                                              \
        sizeof (tactus_plugin_mechanics), 0.0, 0.0 \
    }

/** What a device has in addition to a tool. */
typedef struct tactus_plugin_layout
{
    uint32_t size;
    const char* const* axes;
    size_t axis_count;
    const char* const* efforts;
    size_t effort_count;
    const char* const* buttons;
    size_t button_count;
    int32_t signal_inputs, signal_outputs;
    const tactus_plugin_mechanics* mechanics;
    double brake; /**< the largest damping of its brake on the tool, N s/m; 0: it has none */
} tactus_plugin_layout;

#define TACTUS_PLUGIN_LAYOUT_INIT                                     \
    {                                                                 \
        sizeof (tactus_plugin_layout), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0 \
    }

#define TACTUS_PLUGIN_CHANNELS 32

/** Values in place: `values` has room for TACTUS_PLUGIN_CHANNELS, and `count` says how many are in use now. */
typedef struct tactus_plugin_channels
{
    uint32_t size;
    const int32_t* count;
    const double* values;
} tactus_plugin_channels;

#define TACTUS_PLUGIN_CHANNELS_INIT           \
    {                                         \
        sizeof (tactus_plugin_channels), 0, 0 \
    }

/** The device of a node's role. The host writes the values behind these pointers before each tick, on the tick thread. They are valid
 *  as long as the node, and the pointers never change. The structs themselves and the layout are valid during the call. */
typedef struct tactus_plugin_device
{
    uint32_t size;
    const tactus_plugin_layout* layout;
    const double *position, *rotation;           /**< three each; m, and a rotation vector in rad */
    const double *pressure, *age_s;              /**< N, s */
    const uint32_t *buttons, *fault;             /**< fault: as in framework/node/reading_fault.hpp */
    const unsigned char* valid;                  /**< 0: the device has nothing to report */
    const double *true_position, *true_velocity; /**< three each, only of simulated devices; m, m/s */
    const tactus_plugin_channels *axes, *signals;
    const double *applied_force, *applied_torque; /**< what the guard let through on the last tick; three each; N, N m */
    const tactus_plugin_channels *applied_axes, *applied_signals;
    const void* state;           /**< for TACTUS_PLUGIN_DEVICE_STATE; valid as long as the node, and never changes */
    const double* applied_brake; /**< the damping that the guard let through on the last tick; N s/m */
} tactus_plugin_device;

#define TACTUS_PLUGIN_DEVICE_INIT                                                           \
    {                                                                                       \
        sizeof (tactus_plugin_device), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 \
    }

/** The id of an extension of the host: `state` of a tactus_plugin_device is the tactus::DeviceState that the values are part of. A plugin
 *  in C++ may read it in place, instead of copying the values before each tick, but only if a DeviceState has the same form in both. */
#define TACTUS_PLUGIN_DEVICE_STATE "tactus.device_state"

typedef struct tactus_plugin_device_state
{
    uint32_t size;
    const char* form; /**< as tactus::plugin::formOfDeviceState() describes it in the host: sizes, places and the standard library */
} tactus_plugin_device_state;

#define TACTUS_PLUGIN_DEVICE_STATE_INIT        \
    {                                          \
        sizeof (tactus_plugin_device_state), 0 \
    }

/** What a sink adds to the effort of its role. The node sets the counts and fills only what it uses. */
typedef struct tactus_plugin_effort
{
    uint32_t size;
    uint32_t axis_count, signal_count;
    double force[3], torque[3];
    double axes[TACTUS_PLUGIN_CHANNELS], signals[TACTUS_PLUGIN_CHANNELS];
    double brake; /**< N s/m */
} tactus_plugin_effort;

#define TACTUS_PLUGIN_EFFORT_INIT                                                                        \
    {                                                                                                    \
        sizeof (tactus_plugin_effort), 0, 0, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, { 0.0 }, { 0.0 }, 0.0 \
    }

/** The most that checking and preparing a node can cost. */
typedef struct tactus_plugin_cost
{
    uint32_t size;
    double work;   /**< in units of about 5 ns */
    double memory; /**< bytes */
} tactus_plugin_cost;

#define TACTUS_PLUGIN_COST_INIT               \
    {                                         \
        sizeof (tactus_plugin_cost), 0.0, 0.0 \
    }

/** What a node guarantees; see framework/node/node.hpp. */
typedef struct tactus_plugin_claims
{
    uint32_t size;
    int32_t passive;
    double stiffness, damping, spatial_frequency, amplitude;
} tactus_plugin_claims;

#define TACTUS_PLUGIN_CLAIMS_INIT                            \
    {                                                        \
        sizeof (tactus_plugin_claims), 0, 0.0, 0.0, 0.0, 0.0 \
    }

/** What a node looks like in a picture of the scene; see framework/node/appearance.hpp. A host that does not know the kind or a part
 *  leaves it out. */
typedef struct tactus_plugin_appearance
{
    uint32_t size;
    const char* kind;         /**< "plane", "body", … */
    const char* const* parts; /**< "tool", "normal", … */
    const char* const* rows;  /**< by part: the id of a port or setting of the node */
    size_t part_count;
} tactus_plugin_appearance;

#define TACTUS_PLUGIN_APPEARANCE_INIT                 \
    {                                                 \
        sizeof (tactus_plugin_appearance), 0, 0, 0, 0 \
    }

/* ============================================================================ A node type */

/** `node` is what `create` returned. Functions marked optional may be NULL. `report` takes the answer of `problem`, `warning`,
 *  `missing` and `save` if they return TACTUS_PLUGIN_OK, and otherwise why the hook failed. framework/node/node.hpp says what each hook means. */
typedef struct tactus_plugin_node
{
    uint32_t size;
    const char *id, *name, *summary, *source;
    const tactus_plugin_port* const* ports;
    size_t port_count;
    const tactus_plugin_setting* const* settings;
    size_t setting_count;
    size_t params_size;
    size_t outputs_size, outputs_align;

    /** NULL if it failed. [main thread] */
    void* (*create) (const tactus_plugin_report*)TACTUS_PLUGIN_NOEXCEPT;
    /** Called once. [main thread] */
    void (*destroy) (void* node) TACTUS_PLUGIN_NOEXCEPT;
    /** Gives a setting its value, before prepare; `setting` is its index. [main thread] */
    int32_t (*set) (void* node, size_t setting, const tactus_plugin_value*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    /** Always the same address for a node. [any thread] */
    void* (*params) (void* node)TACTUS_PLUGIN_NOEXCEPT;
    /** Fills the outputs with their defaults. [any thread] */
    void (*initialise_outputs) (void* outputs) TACTUS_PLUGIN_NOEXCEPT;

    /** One sample. `sources` has one pointer per input component, in the order of the ports, with the entries of a list one after
     *  another. A node with `peek` leaves `outputs` alone. [tick thread] */
    void (*tick) (void* node, const double* const* sources, void* outputs) TACTUS_PLUGIN_NOEXCEPT;
    /** Optional. Not called if nothing reads the outputs, so it must not change what tick does. [tick thread] */
    void (*peek) (void* node, const double* const* sources, void* outputs) TACTUS_PLUGIN_NOEXCEPT;
    /** Optional. Called instead of tick if wires or feeds set params of the node: `stored` holds the params as its file and knobs set
     *  them, in params_size bytes. [tick thread] */
    void (*tick_stored) (void* node, const void* stored, const double* const* sources, void* outputs) TACTUS_PLUGIN_NOEXCEPT;
    int32_t (*delay) (const void* node) TACTUS_PLUGIN_NOEXCEPT; /**< optional [any thread] */
    void (*update) (void* node) TACTUS_PLUGIN_NOEXCEPT;         /**< optional [tick thread] */
    /** Optional; `old` is a node of the same type, from this build of the plugin or from one with the same layout in memory.
     *  [tick thread] */
    void (*adopt) (void* node, const void* old) TACTUS_PLUGIN_NOEXCEPT;

    /** Optional. [main thread] */
    int32_t (*cost) (const void* node, tactus_plugin_cost*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    /** Optional. [main thread] */
    int32_t (*problem) (const void* node, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    /** Optional. [main thread] */
    int32_t (*warning) (const void* node, const tactus_plugin_setup*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    /** Optional. [main thread] */
    int32_t (*prepare) (void* node, const tactus_plugin_setup*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    /** Optional. [main thread] */
    int32_t (*claims) (const void* node, tactus_plugin_claims*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;

    /** A device node has both of these, or neither. `announce` copies what `bind` will need; the node may be ticking at that time. `bind`
     *  makes the node use what was announced last, and allocates nothing. [main thread] */
    int32_t (*announce) (void* node, const tactus_plugin_device*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    void (*bind) (void* node) TACTUS_PLUGIN_NOEXCEPT; /**< see announce [main thread or tick thread] */
    /** Optional. [main thread] */
    int32_t (*missing) (const void* node, const tactus_plugin_layout*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    /** Optional; makes the node a sink. [tick thread] */
    void (*effort) (const void* node, tactus_plugin_effort*) TACTUS_PLUGIN_NOEXCEPT;
    /** Optional, not for device nodes. [main thread or tick thread] */
    void (*learn) (void* node, const tactus_plugin_mechanics*) TACTUS_PLUGIN_NOEXCEPT;
    const tactus_plugin_appearance* appearance; /**< optional; plugins built before this member was added do not have it */

    /** Optional, but both or neither; plugins built before they were added do not have them. Without them, no state of a run with this node can be
     *  saved. Both are called between two ticks. `save` puts the state as bytes, in a form of the plugin's own: all that a tick changes. It puts
     *  nothing if there is no state. [main thread] */
    int32_t (*save) (const void* node, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    /** Gets what `save` of the same build of the plugin has put, in a node with the same settings. The params are in place, and `update` has been called.
     *  It fails if the bytes do not fit, and then gets earlier bytes again. They may be damaged: trust no size, index or address in them. [main thread] */
    int32_t (*restore) (void* node, const void* bytes, size_t size, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
} tactus_plugin_node;

#define TACTUS_PLUGIN_NODE_INIT                                                                                                              \
    {                                                                                                                                        \
        sizeof (tactus_plugin_node), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 \
    }

/* ============================================================================ The plugin */

/** What the host tells the plugin about itself. Valid until deinit. */
typedef struct tactus_plugin_host
{
    uint32_t size;
    uint32_t abi;                                                    /**< TACTUS_PLUGIN_ABI of the host */
    const char* name;                                                /**< "Tactus" */
    const char* version;                                             /**< "0.2.0" */
    const void* (*extension) (const char* id)TACTUS_PLUGIN_NOEXCEPT; /**< NULL if the host does not have it [any thread] */
} tactus_plugin_host;

#define TACTUS_PLUGIN_HOST_INIT                                 \
    {                                                           \
        sizeof (tactus_plugin_host), TACTUS_PLUGIN_ABI, 0, 0, 0 \
    }

/** The type of the exported symbol `tactus_plugin_entry`. A program may load the same plugin several times; then init and deinit come in
 *  pairs, and what the nodes describe stays valid until the last deinit. */
typedef struct tactus_plugin
{
    uint32_t size;
    /** TACTUS_PLUGIN_ABI of the plugin */
    uint32_t abi;
    const char *name, *version; /**< for people */
    /** Called first, once per loading. [main thread] */
    int32_t (*init) (const tactus_plugin_host*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
    /** Called last, once per init, even if init failed. [main thread] */
    void (*deinit) (void) TACTUS_PLUGIN_NOEXCEPT;
    size_t (*get_node_count) (void) TACTUS_PLUGIN_NOEXCEPT;                     /**< [main thread] */
    const tactus_plugin_node* (*get_node) (size_t index)TACTUS_PLUGIN_NOEXCEPT; /**< [main thread] */
    /** NULL if the plugin does not have it. [any thread] */
    const void* (*extension) (const char* id)TACTUS_PLUGIN_NOEXCEPT;
} tactus_plugin;

#define TACTUS_PLUGIN_INIT                                             \
    {                                                                  \
        sizeof (tactus_plugin), TACTUS_PLUGIN_ABI, 0, 0, 0, 0, 0, 0, 0 \
    }

TACTUS_PLUGIN_EXTERN TACTUS_PLUGIN_EXPORT const tactus_plugin tactus_plugin_entry;

#endif
