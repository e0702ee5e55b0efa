/* SPDX-License-Identifier: MIT */
#ifndef TACTUS_H
#define TACTUS_H

/**
 * The C API of Tactus: load and edit graphs, render them, and play them in your own loop or in real time.
 *
 *     tactus_messages* messages = tactus_messages_create();
 *     tactus_graph* graph = tactus_graph_load ("dry_wood.json", messages);
 *     const char* records[] = { "motor.force" };
 *     tactus_run_options options = TACTUS_RUN_OPTIONS;
 *     options.records = records;
 *     options.record_count = 1;
 *     tactus_run* run = tactus_run_create (graph, &options, messages);
 *     tactus_run_pushed_device (run, "stylus", NULL, messages);      // instead of the device that the graph describes
 *     tactus_run_open (run, messages);
 *     for (;;)
 *     {
 *         tactus_run_push (run, "stylus", &reading);                  // what your device measured
 *         tactus_run_tick (run);
 *         tactus_run_take (run, "stylus", &effort);                   // what your device should apply
 *     }
 *
 * Conventions
 *  - SI units; right-handed axes: x right, y away from the person, z up. Rotations are rotation vectors in rad.
 *  - Text is UTF-8. Text that a function returns belongs to the object that returned it, unless the comment says that you free it.
 *  - A function that can fail returns NULL or a tactus_result other than TACTUS_OK, and appends the reasons to `messages`, which may
 *    be NULL. No C++ exception leaves a function.
 *  - A handle may be NULL: freeing it does nothing, and everything else returns TACTUS_MISUSE, NULL or 0.
 *  - Each function says which thread may call it (docs/threads.md). [main thread]: any thread, but one at a time for each handle that it gets; the
 *    call may wait. [tick thread]: the thread that ticks the run. In your own loop, it is the thread that calls tactus_run_tick: the main thread, or
 *    another one beside it. [pushing thread]: any thread, but one at a time for each role. [any thread]: any thread at any time while the handle
 *    exists. A list of messages belongs to one thread at a time, whatever the function.
 *  - Structs begin with their size. Begin with the initialisers below: tactus_reading reading = TACTUS_READING. So code that was compiled against
 *    this version works with later ones, which may add members at the end. Any other size is refused with TACTUS_MISUSE, such as the size 0 of a
 *    struct that was only cleared.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define TACTUS_API_C extern "C"
#else
#define TACTUS_API_C
#endif

/** Goes before each function of this interface. */
#if defined(_WIN32) && defined(TACTUS_BUILDS_LIBRARY)
#define TACTUS_API TACTUS_API_C __declspec(dllexport)
#elif defined(_WIN32)
#define TACTUS_API TACTUS_API_C
#else
#define TACTUS_API TACTUS_API_C __attribute__ ((visibility ("default")))
#endif

/** The version of this interface. It grows only when a program compiled against an older version no longer works. */
#define TACTUS_API_VERSION 1

typedef enum tactus_result
{
    TACTUS_OK = 0,
    TACTUS_FAILED = 1, /**< the messages say why */
    TACTUS_MISUSE = 2, /**< a handle or pointer is NULL, or the call is not allowed at this time */
    TACTUS_NO_MEMORY = 3
} tactus_result;

typedef struct tactus_messages tactus_messages; /**< a list of errors and warnings */
typedef struct tactus_graph tactus_graph;       /**< a graph with its undo history */
typedef struct tactus_run tactus_run;           /**< a graph that is played */

TACTUS_API const char* tactus_version (void);  /**< of the library, such as "0.2.0" [any thread] */
TACTUS_API uint32_t tactus_api_version (void); /**< TACTUS_API_VERSION of the library [any thread] */
TACTUS_API void tactus_text_free (char* text); /**< frees a text that a function allocated for you [any thread] */

/** Why the latest TACTUS_MISUSE on this thread was returned, in a sentence; "" if there was none. Valid until the next one. [any thread] */
TACTUS_API const char* tactus_last_misuse (void);

/** The datasheets of all node types as JSON, in the format of `tactus nodes --json`. Free it with tactus_text_free. [any thread] */
TACTUS_API char* tactus_nodes_json (void);

/* ============================================================================ Messages */

typedef struct tactus_message
{
    uint32_t size;
    int32_t is_error;     /**< 1: an error, 0: a warning */
    const char* id;       /**< stable, such as "unit/mismatch" */
    const char* where;    /**< JSON pointer into the graph file, a file name, or "" */
    const char* text;     /**< what is wrong */
    const char* remedy;   /**< what to do about it */
    const char* file;     /**< the file that the text was read from, or "" */
    int32_t line, column; /**< counted from 1; 0 if unknown */
} tactus_message;

#define TACTUS_MESSAGE                                  \
    {                                                   \
        sizeof (tactus_message), 0, 0, 0, 0, 0, 0, 0, 0 \
    }

TACTUS_API tactus_messages* tactus_messages_create (void);               /**< [any thread] */
TACTUS_API void tactus_messages_free (tactus_messages*);                 /**< [main thread] */
TACTUS_API void tactus_messages_clear (tactus_messages*);                /**< [main thread] */
TACTUS_API size_t tactus_messages_count (const tactus_messages*);        /**< [main thread] */
TACTUS_API int32_t tactus_messages_have_errors (const tactus_messages*); /**< [main thread] */

/** The texts stay valid until the list changes. [main thread] */
TACTUS_API tactus_result tactus_messages_get (const tactus_messages*, size_t index, tactus_message*);

/* ============================================================================ Graphs */

/** An empty graph that is ticked at this rate in Hz. [main thread] */
TACTUS_API tactus_graph* tactus_graph_create (const char* name, double rate_hz, tactus_messages*);

/** Reads a graph file and the files that it includes. NULL if it has errors. [main thread] */
TACTUS_API tactus_graph* tactus_graph_load (const char* path, tactus_messages*);

/** Reads a graph from text. Files that the graph names are relative to `folder` (NULL: the current folder). Subgraphs in separate
 *  files are not read: see tactus_graph_set_file. [main thread] */
TACTUS_API tactus_graph* tactus_graph_parse (const char* text, size_t length, const char* folder, tactus_messages*);

/** The graph plays a copy of `file` for nodes of the type "file:PATH", whatever is on the disk. It cannot be undone, and clears the undo steps of
 *  the graph. [main thread] */
TACTUS_API tactus_result tactus_graph_set_file (tactus_graph*, const char* path, const tactus_graph* file, tactus_messages*);

TACTUS_API void tactus_graph_free (tactus_graph*); /**< [main thread] */

/** [main thread] */
TACTUS_API tactus_result tactus_graph_save (const tactus_graph*, const char* path, tactus_messages*);

/** The text of its file. Free it with tactus_text_free. [main thread] */
TACTUS_API char* tactus_graph_text (const tactus_graph*);
TACTUS_API double tactus_graph_rate (const tactus_graph*); /**< in Hz [main thread] */

/* Edits. Each is one undo step, is checked, and changes nothing if it fails. An edit fails if it would add an error to the graph: an
 * unknown type, port or parameter, a wrong unit, a value out of range, a wire that does not fit, a loop without a delay. The message has
 * the id, place and remedy that tactus_run_create would give. Errors that the graph already has do not matter. A device node without
 * a role is not finished, so it can be added. `patch` is "" for the graph itself, or the name of a subgraph. Values are JSON, as in a
 * graph file: 0.4, "20 um", [0, 0, 1]; NULL removes the value. */

/** [main thread] */
TACTUS_API tactus_result tactus_graph_add_node (tactus_graph*, const char* patch, const char* name, const char* type, tactus_messages*);
/** [main thread] */
TACTUS_API tactus_result tactus_graph_remove_node (tactus_graph*, const char* patch, const char* name, tactus_messages*);
/** [main thread] */
TACTUS_API tactus_result tactus_graph_rename_node (tactus_graph*, const char* patch, const char* name, const char* to, tactus_messages*);
/** [main thread] */
TACTUS_API tactus_result tactus_graph_set_param (tactus_graph*, const char* patch, const char* node, const char* param, const char* value, tactus_messages*);
/** [main thread] */
TACTUS_API tactus_result tactus_graph_set_setting (tactus_graph*, const char* patch, const char* node, const char* setting, const char* value,
                                                   tactus_messages*);
/** Any other key of a node, such as "role" or "count". [main thread] */
TACTUS_API tactus_result tactus_graph_set_key (tactus_graph*, const char* patch, const char* node, const char* key, const char* value, tactus_messages*);
/** A wire as in a graph file: "a.out -> b.in". [main thread] */
TACTUS_API tactus_result tactus_graph_add_wire (tactus_graph*, const char* patch, const char* wire, tactus_messages*);
/** The same text, or another one that means the same wire. [main thread] */
TACTUS_API tactus_result tactus_graph_remove_wire (tactus_graph*, const char* patch, const char* wire, tactus_messages*);
/** The description of a role's device: {"driver": "sim", …}. [main thread] */
TACTUS_API tactus_result tactus_graph_set_device (tactus_graph*, const char* role, const char* description, tactus_messages*);
/** Where a control of the graph stands, from 0 to 1. [main thread] */
TACTUS_API tactus_result tactus_graph_set_control (tactus_graph*, const char* control, double value, tactus_messages*);
/** Your function for tactus_graph_perform_all. `user` is what you gave there. [main thread] */
typedef tactus_result (*tactus_graph_edits) (tactus_graph*, void* user);

/** Edits in a batch: calls `edits`, and takes what that does with the functions above as one undo step with this name. Only the result is
 *  checked, so this takes much less time than many single edits, and an edit may leave an error that a later one removes. If an edit fails, if
 *  `edits` does not return TACTUS_OK, or if the result has an error that the batch has added, the graph is as it was before. A batch cannot
 *  contain undo, redo, tactus_graph_set_file or another batch. [main thread] */
TACTUS_API tactus_result tactus_graph_perform_all (tactus_graph*, const char* name, tactus_graph_edits edits, void* user, tactus_messages*);
TACTUS_API int32_t tactus_graph_undo (tactus_graph*); /**< 0 if there is nothing to undo [main thread] */
TACTUS_API int32_t tactus_graph_redo (tactus_graph*); /**< 0 if there is nothing to redo [main thread] */

/** A control moves parameters between two values, which the graph states. */
typedef struct tactus_control
{
    uint32_t size;
    const char* id;   /**< the name to turn it by: "roughness" */
    const char* name; /**< for people: "Roughness"; "" if the graph gives none */
    double value;     /**< where it stands, from 0 to 1 */
} tactus_control;

#define TACTUS_CONTROL                     \
    {                                      \
        sizeof (tactus_control), 0, 0, 0.0 \
    }

TACTUS_API size_t tactus_graph_control_count (const tactus_graph*);                 /**< [main thread] */
TACTUS_API const char* tactus_graph_control_id (const tactus_graph*, size_t index); /**< valid until the graph changes [main thread] */

/** The texts are valid until the graph changes. [main thread] */
TACTUS_API tactus_result tactus_graph_get_control (const tactus_graph*, const char* control, tactus_control*, tactus_messages*);

/* ============================================================================ Assets */

/* Settings can name files: tables (CSV), meshes (OBJ, OFF, PLY, STL), pictures and recordings. The library reads tables and meshes, with
 * the budgets and errors of `tactus render`. It has no decoders for pictures and recordings, so you supply their numbers. You may supply
 * tables and meshes, too. */

typedef enum tactus_asset_kind
{
    TACTUS_ASSET_SIGNAL = 1, /**< a recording: one row per sample, one column per channel */
    TACTUS_ASSET_IMAGE = 2,  /**< a picture: grey values from 0 (black) to 1 (white), top row first */
    TACTUS_ASSET_TABLE = 3,  /**< numbers in rows and columns */
    TACTUS_ASSET_MESH = 4    /**< points and triangles */
} tactus_asset_kind;

/** Numbers that you supply instead of a file. The library copies them when your function has returned. */
typedef struct tactus_asset
{
    uint32_t size;        /**< set by the library */
    size_t rows, columns; /**< of a signal, an image or a table */
    const double* values; /**< rows x columns finite numbers, row after row */
    double rate_hz;       /**< sample rate of a signal */
    const double* points; /**< x, y and z of each point of a mesh, as they would be in its file */
    size_t point_count;
    const int32_t* triangles; /**< three points per triangle, numbered from 0, counter-clockwise as seen from outside */
    size_t triangle_count;
    const char* problem; /**< with TACTUS_ASSET_REFUSED: why there are no numbers, in a sentence; may be NULL */
} tactus_asset;

#define TACTUS_ASSET                                       \
    {                                                      \
        sizeof (tactus_asset), 0, 0, 0, 0.0, 0, 0, 0, 0, 0 \
    }

typedef enum tactus_asset_answer
{
    TACTUS_ASSET_FROM_FILE = 0, /**< read the file */
    TACTUS_ASSET_SUPPLIED = 1,  /**< the asset is filled */
    TACTUS_ASSET_REFUSED = 2    /**< the graph does not compile */
} tactus_asset_answer;

/** Your function, asked about each file that a setting names, by tactus_run_create and tactus_run_edit. `path` begins with the folder of the
 *  graph. The asset that it fills is empty at first. What its pointers point to must stay valid until the next call of this function, or
 *  until the function of the library returns. [main thread] */
typedef tactus_asset_answer (*tactus_asset_reader) (void* context, tactus_asset_kind kind, const char* path, tactus_asset* asset);

/** Sets what files may cost, for all graphs of this process, as the option --limits of `tactus render` does: "points=1M,memory=2GB". Those
 *  that the text does not name keep their defaults. Call it before a graph is loaded. [main thread, while no other thread calls the library] */
TACTUS_API tactus_result tactus_set_limits (const char* limits, tactus_messages*);

/* ============================================================================ Runs */

typedef struct tactus_run_options
{
    uint32_t size;
    double rate_hz;           /**< 0: the graph's rate */
    const char* const* feeds; /**< ports driven by you: "drag.position.x", "drag.mu" */
    size_t feed_count;
    const char* const* records; /**< ports to record: "motor.force"; none: the inputs of all sinks */
    size_t record_count;
    const char* const* sets; /**< values that replace those of the graph: "drag.mu=0.3" */
    size_t set_count;
    tactus_asset_reader assets; /**< asked before a file is read; NULL: all files are read by the library */
    void* asset_context;        /**< passed to `assets`; must outlive the run */
    const char* log;            /**< a file for the log of all inputs (docs/replay.md), from tactus_run_open to tactus_run_stop; NULL: none */
} tactus_run_options;

#define TACTUS_RUN_OPTIONS                                          \
    {                                                               \
        sizeof (tactus_run_options), 0.0, 0, 0, 0, 0, 0, 0, 0, 0, 0 \
    }

/** Compiles a graph, which may be freed or edited afterwards. NULL if it does not compile. [main thread] */
TACTUS_API tactus_run* tactus_run_create (const tactus_graph*, const tactus_run_options*, tactus_messages*);

/** Stops the run, waits until all forces are zero, and frees it. No other function may be called at the same time or later; a tick thread of your
 *  own must have ended. [main thread] */
TACTUS_API void tactus_run_free (tactus_run*);

TACTUS_API double tactus_run_rate (const tactus_run*);                           /**< in Hz [main thread] */
TACTUS_API size_t tactus_run_role_count (const tactus_run*);                     /**< [main thread] */
TACTUS_API const char* tactus_run_role (const tactus_run*, size_t index);        /**< name of a role [main thread] */
TACTUS_API size_t tactus_run_feed_count (const tactus_run*);                     /**< [main thread] */
TACTUS_API size_t tactus_run_record_count (const tactus_run*);                   /**< components, not ports [main thread] */
TACTUS_API const char* tactus_run_record_name (const tactus_run*, size_t index); /**< "motor.force.x" [main thread] */
TACTUS_API const char* tactus_run_record_unit (const tactus_run*, size_t index); /**< "N"; "" if unknown [main thread] */

/* ---------------------------------------------------------------------------- Devices, before tactus_run_open */

/** The device of a role, written as for the option --device of the command line: "sim", "trace:FILE.csv", "gesture:NAME", "FILE.json".
 *  Without this, it is the device that the graph describes. Real devices belong to the host. [main thread] */
TACTUS_API tactus_result tactus_run_device (tactus_run*, const char* role, const char* device, tactus_messages*);

#define TACTUS_CHANNELS 32

/** What a device measured. */
typedef struct tactus_reading
{
    uint32_t size;
    int32_t valid;      /**< 0: the device has nothing to report, and the guard holds its force at zero */
    double position[3]; /**< m */
    double rotation[3]; /**< rotation vector, rad */
    double pressure;    /**< N */
    double age_s;       /**< time since the device took this reading */
    uint32_t buttons;   /**< bit i: button i is down */
    uint32_t axis_count, signal_count;
    double axes[TACTUS_CHANNELS], signals[TACTUS_CHANNELS];
} tactus_reading;

#define TACTUS_READING                                                                                        \
    {                                                                                                         \
        sizeof (tactus_reading), 0, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, 0.0, 0.0, 0, 0, 0, { 0.0 }, { 0.0 } \
    }

/** What a device should apply, after the guard. */
typedef struct tactus_effort
{
    uint32_t size;
    double force[3];  /**< on the tool, N */
    double torque[3]; /**< on the tool, N m */
    uint32_t axis_count, signal_count;
    double axes[TACTUS_CHANNELS], signals[TACTUS_CHANNELS];
    double brake; /**< damping of the brake on the tool, N s/m; 0 for a device without one, and for one that a driver in a plugin drives */

    /* What only drivers in plugins get (tactus_device.h); otherwise 0. */
    double max_signal;    /**< limit of the run for signals, infinite without one: a driver that adds signals, or a force, in one motor keeps the sum within */
    uint32_t is_withheld; /**< 1 during a stop: a driver that sends what it derives from earlier efforts, such as an amplitude, forgets them, so that the
                               stop takes no longer than the guard's */
} tactus_effort;

#define TACTUS_EFFORT                                                                                     \
    {                                                                                                     \
        sizeof (tactus_effort), { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, 0, 0, { 0.0 }, { 0.0 }, 0.0, 0.0, 0 \
    }

/** Where a tool is on tick i of the n ticks of a step of tactus_run_step_for. docs/steps.md has the delay of each. */
typedef enum tactus_between
{
    TACTUS_HOLD = 0,       /**< at the new reading */
    TACTUS_LINEAR = 1,     /**< i/n of the way from the last reading to the new one; buttons, pressure and signals are those of the new one */
    TACTUS_BY_VELOCITY = 2 /**< where the new reading and its velocity lead in i - 1 periods */
} tactus_between;

/** The effort that tactus_run_take returns after a step. */
typedef enum tactus_step_effort
{
    TACTUS_LAST_TICK = 0, /**< the effort of the last tick of the step */
    TACTUS_MEAN = 1       /**< the mean over its ticks; signals are those of the last one. What came before a stop of the guard does not count */
} tactus_step_effort;

/** What your device has, beyond a tool that moves and can be pushed. Everything may be 0 or NULL. */
typedef struct tactus_device_options
{
    uint32_t size;
    const char* const* axes; /**< names of axes that can be read */
    size_t axis_count;
    const char* const* efforts; /**< names of axes that can be pushed */
    size_t effort_count;
    const char* const* buttons;
    size_t button_count;
    int32_t signal_inputs, signal_outputs;
    const char* guard; /**< JSON with the limits of docs/safety.md: {"max_force": "3 N", …}. Its "watchdog" replaces that of 50 ms, also by a longer
                            one; the guard that a graph asks for only tightens */
    double brake;      /**< the largest damping of its brake on the tool, N s/m, which also limits tactus_effort::brake; 0: it has none */

    /* What happens between the readings of tactus_run_step_for. */
    tactus_between between;
    tactus_step_effort step_effort;

    int simulated; /**< 1: your program simulates the device, and no person holds it. Only then can the run be saved and restored, because a state may step
                        the effort */
} tactus_device_options;

#define TACTUS_DEVICE_OPTIONS                                                                            \
    {                                                                                                    \
        sizeof (tactus_device_options), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0, TACTUS_HOLD, TACTUS_LAST_TICK, 0 \
    }

/** Your own device: you push readings and take efforts. Until the first reading, the effort is zero. When readings stop for longer than the watchdog
 *  of the guard, 50 ms if you do not set it, the effort fades to zero within 5 ms, or as slowly as `max_slew` requires. The watchdog counts the periods
 *  of tactus_run_tick, the seconds of tactus_run_tick_after, and wall time after tactus_run_start. So push for each tick, also if nothing moves.
 *  [main thread] */
TACTUS_API tactus_result tactus_run_pushed_device (tactus_run*, const char* role, const tactus_device_options*, tactus_messages*);

/** Opens the devices of all roles, and begins the log. [main thread] */
TACTUS_API tactus_result tactus_run_open (tactus_run*, tactus_messages*);

/** The reading that the next ticks use; the latest one wins. Waits for nothing. [pushing thread] */
TACTUS_API tactus_result tactus_run_push (tactus_run*, const char* role, const tactus_reading*);

/** The same, with the velocity of the tool for TACTUS_BY_VELOCITY: three numbers in m/s, and three in rad/s about the axes of space, or NULL if it does not
 *  turn. Without it, the velocity is the way since the last step, divided by the length of this one. [pushing thread] */
TACTUS_API tactus_result tactus_run_push_moving (tactus_run*, const char* role, const tactus_reading*, const double* velocity, const double* angular_velocity);

/** The effort of the latest tick, however long ago that was: the watchdog counts ticks, so a device needs a watchdog of its own for a loop that
 *  hangs. Waits for nothing. [any thread] */
TACTUS_API tactus_result tactus_run_take (const tactus_run*, const char* role, tactus_effort*);

/* ---------------------------------------------------------------------------- Ticking in your own loop

 * The loop may run on the main thread, or on a thread of its own. In the second case, functions for the main thread may be called meanwhile, except
 * tactus_run_open, tactus_run_start, tactus_run_steps and tactus_run_free. If there is a log, call tactus_run_attend several times a second. */

/** Runs one tick. Allocates nothing, takes no lock, reads no clock. Every tick counts as one period, for the guard, too. [tick thread] */
TACTUS_API tactus_result tactus_run_tick (tactus_run*);

/** The same, `passed_s` after the last tick. Use it if your loop drives a motor and can be late: the guard then counts seconds, not ticks,
 *  for its slew, its watchdog and its windows. [tick thread] */
TACTUS_API tactus_result tactus_run_tick_after (tactus_run*, double passed_s);

/** Runs the ticks that are due `dt_s` after the last step, for a loop with steps longer than a tick: more than 0, at most 1 s. What remains of a period is
 *  kept for the next step, so that steps of 1/60 s at 4 kHz have 66, 67 and 67 ticks. The readings pushed since the last step are where the devices are
 *  now; `between` and `step_effort` of tactus_device_options say what happens in between. Push first, then step, then take. [tick thread] */
TACTUS_API tactus_result tactus_run_step_for (tactus_run*, double dt_s);

/** Writes the state of the run between two ticks: nodes, parameters, delays, guards, controls, simulated devices, and what remains of a step. `size` gets
 *  its length in bytes; call it with room 0 to learn that. Writes nothing if there is too little room. A node or a device whose state cannot be
 *  saved is refused by name (state/refused). Only for a run that you tick yourself. [tick thread] */
TACTUS_API tactus_result tactus_run_save (tactus_run*, void* bytes, size_t room, size_t* size, tactus_messages*);

/** Goes back, or on, to a state of this run or of another one of the same graph, with the same devices and the same version of Tactus, in any process
 *  (docs/states.md says what may differ): the next ticks have the same bits. A state of another graph, a damaged one and the like are refused, and then
 *  nothing changes. The state does not undo limits, a halt or an emergency stop, but a stop that the guard latched by itself. Restore only what you have
 *  saved: the checksum finds damage, not malice. Ids: state/… [tick thread] */
TACTUS_API tactus_result tactus_run_restore (tactus_run*, const void* bytes, size_t size, tactus_messages*);

/** Sets the feeds for the next tick, one value per feed. [tick thread] */
TACTUS_API tactus_result tactus_run_set_feeds (tactus_run*, const double* values);

/** The recorded components after the latest tick. [tick thread] */
TACTUS_API tactus_result tactus_run_get_records (const tactus_run*, double* values);

/** Runs many ticks: row k of `feeds` (ticks x feed count; NULL if there are none) drives tick k, and row k of `records` (ticks x record
 *  count; may be NULL) receives its records. Also writes the log. No other thread may tick the run meanwhile. [main thread] */
TACTUS_API tactus_result tactus_run_steps (tactus_run*, size_t ticks, const double* feeds, double* records);

/** The duration in s of the devices that have one (traces, gestures); 0 if none has. After tactus_run_open. [main thread] */
TACTUS_API double tactus_run_duration (const tactus_run*);

/* ---------------------------------------------------------------------------- Ticking in real time */

typedef struct tactus_start_options
{
    uint32_t size;
    int32_t core;    /**< CPU core for the tick thread; -1: any */
    uint64_t length; /**< in ticks; 0: until it is stopped */
    size_t buffer;   /**< recorded ticks that are kept until tactus_run_collect; 0: none */
} tactus_start_options;

#define TACTUS_START_OPTIONS                    \
    {                                           \
        sizeof (tactus_start_options), -1, 0, 0 \
    }

/** Ticks the run by a timer on its own thread. From now on, that is the tick thread. Real-time privileges that the system
 *  refuses are warnings. Call it once. [main thread] */
TACTUS_API tactus_result tactus_run_start (tactus_run*, const tactus_start_options*, tactus_messages*);

/** Frees memory that the tick thread no longer uses, and writes the log. Call it several times a second while the run plays. TACTUS_FAILED, once, if
 *  the log is incomplete. [main thread] */
TACTUS_API tactus_result tactus_run_attend (tactus_run*, tactus_messages*);

/** Moves recorded ticks, the oldest first, into `rows` (up to `most` rows of record count values). Returns how many. [main thread] */
TACTUS_API size_t tactus_run_collect (tactus_run*, double* rows, size_t most);

/** Recorded ticks that were lost because the buffer was full. [main thread] */
TACTUS_API uint64_t tactus_run_lost (const tactus_run*);

/** Brings all forces to zero, ends the tick thread and completes the log. Waits for all of this. A run that you tick yourself has no thread: its efforts
 *  are zero at once, so for a smooth end call tactus_run_emergency_stop, tick on until they are zero, and then stop. TACTUS_FAILED if the log is
 *  incomplete; the next tactus_run_attend says why. [main thread] */
TACTUS_API tactus_result tactus_run_stop (tactus_run*);

typedef enum tactus_phase
{
    TACTUS_IDLE = 0, /**< not started, or ticked by you: then only `is_emergency` of tactus_status is used; see tactus_run_guard */
    TACTUS_RUNNING = 1,
    TACTUS_HALTING = 2, /**< the forces are falling to zero */
    TACTUS_OVER = 3
} tactus_phase;

typedef struct tactus_status
{
    uint32_t size;
    tactus_phase phase;
    uint64_t ticks, late_ticks; /**< late: began at least one period late */
    double force, peak_force;   /**< largest force of all roles in N: now, and since the start */
    int32_t is_emergency;
} tactus_status;

#define TACTUS_STATUS                                          \
    {                                                          \
        sizeof (tactus_status), TACTUS_IDLE, 0, 0, 0.0, 0.0, 0 \
    }

TACTUS_API tactus_result tactus_run_status (const tactus_run*, tactus_status*); /**< [any thread] */

/** Why a guard withholds the effort of a role; docs/safety.md explains each. The last four are latched: they end with tactus_run_rearm, or when a state
 *  from before the stop is restored. */
typedef enum tactus_stop
{
    TACTUS_STOP_NONE = 0,
    TACTUS_STOP_NOT_FINITE = 1, /**< the graph asked for a value that is not a number */
    TACTUS_STOP_STALE = 2,      /**< no reading, or one that is old, frozen or not a number */
    TACTUS_STOP_STARVED = 3,    /**< more time was lost than ticked */
    TACTUS_STOP_RELEASED = 4,   /**< the dead-man's switch is not held */
    TACTUS_STOP_HALTED = 5,     /**< at the end of a run */
    TACTUS_STOP_SPEED = 6,
    TACTUS_STOP_IMPULSE = 7,
    TACTUS_STOP_ENERGY = 8,
    TACTUS_STOP_EMERGENCY = 9
} tactus_stop;

/** The guard of a role after the latest tick. */
typedef struct tactus_guard
{
    uint32_t size;
    tactus_stop stop;    /**< why it withholds the effort now */
    int32_t is_latched;  /**< 1: only tactus_run_rearm ends a stop, even if `stop` reports another cause */
    int32_t is_clipping; /**< 1: most ticks of the last second asked for more than the limits let through, so the force is not that of the graph */
    tactus_stop latest;  /**< the cause of the latest stop, also if it has ended */
    double value, limit; /**< of the latest stop: what was measured, and the most that is allowed, SI; 0 if the cause has none */
    double window;       /**< of that limit, in s; 0: none, or the whole run */
    uint64_t stops;      /**< how many there have been */
} tactus_guard;

#define TACTUS_GUARD                                                                      \
    {                                                                                     \
        sizeof (tactus_guard), TACTUS_STOP_NONE, 0, 0, TACTUS_STOP_NONE, 0.0, 0.0, 0.0, 0 \
    }

/** Says why there is no force, in your own loop and in a run that was started. After tactus_run_open. Waits for nothing. [any thread] */
TACTUS_API tactus_result tactus_run_guard (const tactus_run*, const char* role, tactus_guard*);

/** The latest stop of a role in words, such as "the impulse of the force is 30.01 N*s; the limit is 30 N*s in 10 s"; NULL for an unknown role. Free it
 *  with tactus_text_free. [any thread] */
TACTUS_API char* tactus_run_guard_text (const tactus_run*, const char* role);

/** The name of a stop, such as "impulse"; "" for TACTUS_STOP_NONE, NULL for a number that is no stop. [any thread] */
TACTUS_API const char* tactus_stop_name (tactus_stop);

/* ---------------------------------------------------------------------------- While it plays */

/** Sets a parameter by name: "drag.mu", "finger[*]/drag.mu", or a component of a vector: "cut.normal.x". The value ramps to it. Refuses
 *  a value that is not finite or out of range (param/value, param/out_of_range), a vector as a whole (param/shape) and a choice
 *  (param/unknown_choice). [main thread] */
TACTUS_API tactus_result tactus_run_set (tactus_run*, const char* param, double value, tactus_messages*);

/** Sets all components of a vector, or all entries of a list, or none: "cut.normal" to three numbers. [main thread] */
TACTUS_API tactus_result tactus_run_set_vector (tactus_run*, const char* param, const double* values, size_t count, tactus_messages*);

/** Sets a parameter to a value that is written as in a graph file: a choice by its name, "saw"; a number with a unit, "2 N/mm"; a vector,
 *  "[0, 0, 1]". Text needs no quotes inside of yours. [main thread] */
TACTUS_API tactus_result tactus_run_set_value (tactus_run*, const char* param, const char* value, tactus_messages*);

TACTUS_API size_t tactus_run_control_count (const tactus_run*);                 /**< [main thread] */
TACTUS_API const char* tactus_run_control_id (const tactus_run*, size_t index); /**< valid until tactus_run_edit [main thread] */

/** Where a control stands: where it was turned to, or else where `sets` or the graph puts it. The texts are valid until tactus_run_edit.
 *  [main thread] */
TACTUS_API tactus_result tactus_run_get_control (const tactus_run*, const char* control, tactus_control*, tactus_messages*);

/** Turns a control, from 0 to 1, and with it all parameters that it moves. [main thread] */
TACTUS_API tactus_result tactus_run_turn (tactus_run*, const char* control, double value, tactus_messages*);

/** Triggers a hit input: "ring.hit", in m/s; more than 0, at most 1000 (hit/value). [main thread] */
TACTUS_API tactus_result tactus_run_hit (tactus_run*, const char* input, double speed, tactus_messages*);

/** Plays an edited graph, or one that was read again, from the next tick on. What both contain, by name, continues, and no force jumps. An edit that
 *  removes a probed port fails. [main thread] */
TACTUS_API tactus_result tactus_run_edit (tactus_run*, const tactus_graph*, tactus_messages*);

/* Probes sample ports while a run plays, about 1000 times a second, or on every tick of a slower run. The ticks never wait for them. */

/** From now on, probes these ports instead of earlier ones; none: ends it. If this fails, the earlier ones stay. After tactus_run_open.
 *  [main thread] */
TACTUS_API tactus_result tactus_run_probe (tactus_run*, const char* const* ports, size_t count, tactus_messages*);

/** How many values the probes have: a port with three components has three. An edit changes it if a port of several instances is probed and their
 *  number changes. [main thread] */
TACTUS_API size_t tactus_run_probe_count (const tactus_run*);
TACTUS_API const char* tactus_run_probe_name (const tactus_run*, size_t index); /**< "motor.force.x" [main thread] */

/** The latest values of the probes; not numbers until there are some. There must be room for all of them. [main thread] */
TACTUS_API tactus_result tactus_run_probed (tactus_run*, double* values, size_t count);

/** Moves samples that were not collected yet, the oldest first, into `rows` (up to `most` rows of probe count values), and the numbers of their ticks
 *  into `ticks`, which may be NULL. Returns how many. [main thread] */
TACTUS_API size_t tactus_run_collect_probes (tactus_run*, uint64_t* ticks, double* rows, size_t most);

/** Samples lost so far: the queue holds 4096, and later ones are dropped until you collect. [main thread] */
TACTUS_API uint64_t tactus_run_lost_probes (const tactus_run*);

/** Fades all forces to zero and keeps them there, from the next tick on, until tactus_run_rearm. Safe in a signal handler. [any thread] */
TACTUS_API tactus_result tactus_run_emergency_stop (tactus_run*);

/** Ends emergency stops and all other stops of the guards. Only a person should decide this. [any thread] */
TACTUS_API tactus_result tactus_run_rearm (tactus_run*);

/* ============================================================================ Logs */

typedef struct tactus_table tactus_table; /**< numbers of a run in columns, one row for each tick */

/** Reads what a log (docs/replay.md) says about each tick from `from_s` to before `until_s`; INFINITY: to the end. The columns are `passed` (s), for each
 *  role the fields of its reading ("stylus.position.x"), and the feeds. Values that the log does not repeat are repeated. Nothing is played, so the files
 *  that the graph uses are not needed. NULL if there are errors, such as take/too_large: see tactus_set_limits. [main thread] */
TACTUS_API tactus_table* tactus_log_read (const char* log, double from_s, double until_s, tactus_messages*);

/** Repeats a logged run, as `tactus render --replay` does, with the same bits. The columns are the recorded components. `graph`: played instead of that of
 *  the log; may be NULL. Of the options, which may be NULL, `records`, `sets`, `assets` and `asset_context` are used. NULL if there are errors.
 *  [main thread] */
TACTUS_API tactus_table* tactus_replay (const char* log, const tactus_graph* graph, const tactus_run_options*, double from_s, double until_s,
                                        tactus_messages*);

TACTUS_API void tactus_table_free (tactus_table*);                                 /**< [main thread] */
TACTUS_API size_t tactus_table_columns (const tactus_table*);                      /**< [any thread] */
TACTUS_API size_t tactus_table_rows (const tactus_table*);                         /**< [any thread] */
TACTUS_API uint64_t tactus_table_first (const tactus_table*);                      /**< the tick of the first row [any thread] */
TACTUS_API const char* tactus_table_name (const tactus_table*, size_t column);     /**< "motor.force.x" [any thread] */
TACTUS_API const char* tactus_table_unit (const tactus_table*, size_t column);     /**< SI; "" if unknown [any thread] */
TACTUS_API const double* tactus_table_values (const tactus_table*, size_t column); /**< one for each row, until the table is freed [any thread] */

/** The rest, as JSON: of a log, `head` (program, rate_hz, clocks: when tick 0 began), `events` (tick, kind, name, value) and `is_cut_off`; of a replay,
 *  `name` of the graph, `rate_hz`, `ticks` and `is_cut_off`. Until the table is freed. [any thread] */
TACTUS_API const char* tactus_table_about (const tactus_table*);

#endif
