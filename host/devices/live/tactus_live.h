/* SPDX-License-Identifier: MIT */
#ifndef TACTUS_LIVE_H
#define TACTUS_LIVE_H

/**
 * The C API of live sessions: play graphs on the devices of this computer, with the guards, the failsafe and the guardian process of
 * `tactus play`. libtactus_live also contains all functions of tactus.h: link it instead of libtactus.
 *
 *     tactus_messages* messages = tactus_messages_create();
 *     tactus_graph* graph = tactus_graph_load ("dry_wood.json", messages);
 *     const char* devices[] = { "stylus=hid:auto" };
 *     tactus_session_options options = TACTUS_SESSION_OPTIONS;
 *     options.devices = devices;
 *     options.device_count = 1;
 *     tactus_session* session = tactus_session_open (graph, &options, messages);
 *     tactus_session_start (session, messages);
 *     ...                                            // set parameters, edit the graph, read probes
 *     tactus_session_close (session);                // all forces go to zero first
 *
 * Conventions
 *  - Those of tactus.h. Text that a function returns stays valid until the next call of the same function for the same session.
 *  - Threads as in tactus.h and docs/threads.md. Calls for the main thread may wait for a few ms. A session has no tick thread of yours.
 *  - A session has a thread of its own that looks after it, so nothing needs to be called regularly. A program that does nothing or waits in a
 *    function of its own does not affect the ticks. A debugger that stops the whole process does: the devices are brought to rest.
 *  - Graphs never choose or calibrate real devices. Only `devices` and the user's session file do.
 *  - If the process ends, is killed or freezes, a guardian process brings the devices to rest (docs/hazards.md). If only its main thread ends, by
 *    pthread_exit, the session stops (run/main_thread; Linux with /proc).
 *  - After fork(), only the parent has the sessions. In the child, every function returns TACTUS_MISUSE, NULL or 0.
 *  - No signal handlers are installed except those for faults (SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL), while a device is open. They write
 *    the last reports and then run the handler that was there before.
 */

#include "tactus.h"

typedef struct tactus_session tactus_session; /**< a graph that plays on devices */

/** Anything that can be NULL or 0 may be left out. */
typedef struct tactus_session_options
{
    uint32_t size;
    const char* const* devices; /**< devices of roles, as for the option --device: "stylus=hid:auto", "stylus=gesture:circle" */
    size_t device_count;
    const char* session;     /**< which file binds the other roles to devices: NULL: the user's session, "off": none, or the name of a file */
    const char* clock;       /**< what ticks the run: a role (its device), or "timer"; NULL: as the session says, or the first device that can */
    double rate_hz;          /**< 0: that of the clock, or else the graph's */
    double duration_s;       /**< in s of wall time, however many ticks are lost; 0: until it is stopped */
    int32_t core;            /**< CPU core for the tick thread, plus 1; 0: any */
    int32_t is_strict;       /**< 1: a missing device of the session is an error. 0: its role gets no force until the device is there */
    int32_t fuses;           /**< 1: compiled code replaces the plan while it runs (docs/fusion.md) */
    const char* const* sets; /**< values that replace those of the graph: "drag.mu=0.3" */
    size_t set_count;
    const char* const* records; /**< ports to record: "motor.force" */
    size_t record_count;
    double buffer_s;            /**< how much of the records is kept until tactus_session_collect, in s; 0: none */
    const char* log;            /**< a file for the log of all inputs (docs/replay.md) */
    tactus_asset_reader assets; /**< as in tactus_run_options */
    void* asset_context;
} tactus_session_options;

#define TACTUS_SESSION_OPTIONS                                                                   \
    {                                                                                            \
        sizeof (tactus_session_options), 0, 0, 0, 0, 0.0, 0.0, 0, 0, 0, 0, 0, 0, 0, 0.0, 0, 0, 0 \
    }

/** Chooses the clock, compiles the graph and opens its devices. Nothing moves yet. The graph may be freed or edited afterwards. NULL if there are
 *  errors. [main thread] */
TACTUS_API tactus_session* tactus_session_open (const tactus_graph*, const tactus_session_options*, tactus_messages*);

/** Starts the ticks. Real-time privileges that the system refuses are warnings. Call it once. [main thread] */
TACTUS_API tactus_result tactus_session_start (tactus_session*, tactus_messages*);

/** Ramps all forces to zero, ends the ticks, and completes the log. Waits for it: usually for less than a second, with a low slew limit for up to
 *  30 s. The forces begin to fall at once, even if another function runs for the session at the same time; a session that starts only later ends with
 *  its first tick. If a tick does not end, because a plugin loops, it fails after that time (run/stuck); the device got its last reports long before.
 *  [any thread; not in a signal handler] */
TACTUS_API tactus_result tactus_session_stop (tactus_session*, tactus_messages*);

/** Stops, releases the devices, and frees the session. No other function may be called at the same time or later. If a tick does not end, the
 *  session stays in memory. [main thread] */
TACTUS_API void tactus_session_close (tactus_session*);

/** Fades all forces to zero and keeps them there until tactus_session_rearm. The graph keeps running. Safe in a signal handler. [any thread] */
TACTUS_API tactus_result tactus_session_emergency_stop (tactus_session*);

/** Ends emergency stops and all other latched stops. Only a person should decide this. Refused within a second of an emergency stop or of the
 *  last rearm. [any thread] */
TACTUS_API tactus_result tactus_session_rearm (tactus_session*, tactus_messages*);

/** The file of a graph: `name` itself or, if it is a bare name such as "dry_wood" and no file is called that, that of the preset. Free it with
 *  tactus_text_free. [any thread] */
TACTUS_API char* tactus_graph_file (const char* name);

/* ---------------------------------------------------------------------------- Nodes of your own, in plugins (docs/plugins.md) */

/** Loads a plugin, or all plugins of a folder, whose device drivers sessions then find, too. NULL: those that `tactus play` loads, from the folders in
 *  TACTUS_PLUGINS, that of the user, and that of the system. From now on, graphs may use their nodes, in tactus_run and in sessions; runs and
 *  sessions that exist keep their nodes. The rules are those of the command line: a plugin that another user could have written is not
 *  loaded, nor one that crashed the program when it was last loaded, nor a node whose id exists already. TACTUS_FAILED if something was refused; the
 *  rest is loaded. With NULL, refusals are only warnings. A plugin that is loaded already stays as it is. [main thread, while no other thread calls
 *  the library] */
TACTUS_API tactus_result tactus_plugins_load (const char* path, tactus_messages*);

/** Loads a plugin whose nodes replace those of the same ids, for graphs that are compiled from now on. For another build of a node, in another file.
 *  [main thread, while no other thread calls the library] */
TACTUS_API tactus_result tactus_plugins_replace (const char* plugin, tactus_messages*);

/** Compiles a header that ends with a line TACTUS_NODE into the file `plugin`, as the option --live of `tactus play` does, but does not load it. Waits
 *  for the compiler, which takes some seconds at the priority of this program. It needs a C++20 compiler and the development files of Tactus: ids
 *  live/compile, live/no_compiler, live/no_headers, live/no_node, live/foreign. [main thread] */
TACTUS_API tactus_result tactus_plugins_compile (const char* header, const char* plugin, tactus_messages*);

/* ---------------------------------------------------------------------------- What the command line finds out, as JSON */

/* Each function returns what the command of the same name prints with the option --json; free it with tactus_text_free. NULL if there are errors.
 * `options` is NULL, or a JSON object whose keys are the long options of the command, without the dashes: {"rate": 1000, "set": {"drag.mu": 0.3}}. A
 * list or an object stands for an option that may be given more than once. They take seconds, and use all processors. Other threads may use
 * other objects meanwhile. */

/** `tactus check`. Options: devices (a list of ROLE=…), set, rate, duration, sweep, speed, alpha, beta, gamma. A broken condition is no error: see
 *  docs/check.md for what is judged and what is not. [main thread] */
TACTUS_API char* tactus_check (const tactus_graph*, const char* options, tactus_messages*);

/** `tactus limits`. Options: devices, set, rate, duration, role, x, y, steps. With steps, also the points of the regions, as `columns` and `rows`, which
 *  `tactus limits --out FILE.json` writes. [main thread] */
TACTUS_API char* tactus_limits (const tactus_graph*, const char* options, tactus_messages*);

/** Ends the searches of tactus_limits that compute points of regions at this time, which may take minutes: they fail (api/interrupted). The other functions
 *  end by themselves within seconds. [any thread] */
TACTUS_API void tactus_limits_interrupt (void);

/** Columns of numbers of the caller. */
typedef struct tactus_columns
{
    const char* const* names; /**< as in the header of a CSV file: "t", "force [mN]" */
    size_t count;
    const double* values; /**< row after row: rows times count */
    size_t rows;
} tactus_columns;

/** `tactus fit KIND`. The recording is a CSV or WAV file, or `columns`; then `recording` is only its name in messages, and may be NULL. Options: columns, units and signs, objects by role, and those that the kind has, as SI numbers or texts with a unit. The JSON has the report of
 *  `tactus fit --json`, and `graph`, the text of the preset, `picture`, the recorded and fitted curves, `details` and `snippets`. [main thread] */
TACTUS_API char* tactus_fit (const char* kind, const char* recording, const tactus_columns* columns, const char* options, tactus_messages*);

/** `tactus convert`: a haptic clip into another format, or a pen recording into a trace, by the extensions of the files. Options:
 *  calibration, rate (Hz), split; for a pen also pitch, depth, lift (m), force (N) and full-pressure, as numbers. An output that exists is replaced, unless it
 *  is an input. The JSON has `seconds`, `tracks` and `events` or `rows`, `notes` of the reader, and `files`, each with its `name`, `losses` and
 *  `differences`. [main thread] */
TACTUS_API char* tactus_convert (const char* in, const char* out, const char* options, tactus_messages*);

/** `tactus devices`: a list of HID devices, serial ports, event devices, and profiles that can only be simulated. The command also lists sound cards, which
 *  sessions of this library cannot open. Nothing is opened. [main thread] */
TACTUS_API char* tactus_devices (tactus_messages*);

/* ---------------------------------------------------------------------------- While it plays */

/** Plays an edited graph, or one that was read again, from the next tick on. What both contain, by name, continues, and no force
 *  jumps. Limits that the graph asks for only tighten until the next start. [main thread] */
TACTUS_API tactus_result tactus_session_edit (tactus_session*, const tactus_graph*, tactus_messages*);

/** Sets a parameter, as tactus_run_set_value: "drag.mu" to "0.4", "cut.normal" to "[0, 0, 1]", "wave.shape" to "saw". The value ramps to it.
 *  [main thread] */
TACTUS_API tactus_result tactus_session_set (tactus_session*, const char* param, const char* value, tactus_messages*);

/** Turns a control of the graph, from 0 to 1. tactus_graph_control_id lists them. [main thread] */
TACTUS_API tactus_result tactus_session_turn (tactus_session*, const char* control, double value, tactus_messages*);

/** Triggers a hit input, with a speed in m/s. [main thread] */
TACTUS_API tactus_result tactus_session_hit (tactus_session*, const char* input, double speed, tactus_messages*);

/** From now on, tactus_session_probed returns the values of these ports, instead of earlier ones. If this fails, the earlier ones stay.
 *  [main thread] */
TACTUS_API tactus_result tactus_session_probe (tactus_session*, const char* const* ports, size_t count, tactus_messages*);

/** How many values the probes have: a port with three components has three. [main thread] */
TACTUS_API size_t tactus_session_probe_count (const tactus_session*);
TACTUS_API const char* tactus_session_probe_name (const tactus_session*, size_t index); /**< "motor.force.x" [main thread] */

/** The latest values of the probes; not numbers until there are some. There must be room for all of them. [main thread] */
TACTUS_API tactus_result tactus_session_probed (tactus_session*, double* values, size_t count);

/** Samples of the probes that were not collected yet, and how many were lost, as tactus_run_collect_probes and tactus_run_lost_probes. [main thread] */
TACTUS_API size_t tactus_session_collect_probes (tactus_session*, uint64_t* ticks, double* rows, size_t most);
TACTUS_API uint64_t tactus_session_lost_probes (tactus_session*); /**< [main thread] */

TACTUS_API size_t tactus_session_record_count (const tactus_session*);                   /**< components, not ports [main thread] */
TACTUS_API const char* tactus_session_record_name (const tactus_session*, size_t index); /**< [main thread] */
TACTUS_API const char* tactus_session_record_unit (const tactus_session*, size_t index); /**< "N"; "" if unknown [main thread] */

/** Moves recorded ticks, the oldest first, into `rows` (up to `most` rows of record count values). Returns how many. [main thread] */
TACTUS_API size_t tactus_session_collect (tactus_session*, double* rows, size_t most);
TACTUS_API uint64_t tactus_session_lost (const tactus_session*); /**< recorded ticks that were lost because the buffer was full [main thread] */

/* ---------------------------------------------------------------------------- What it does */

TACTUS_API tactus_result tactus_session_status (const tactus_session*, tactus_status*); /**< [any thread] */
TACTUS_API double tactus_session_rate (const tactus_session*);                          /**< in Hz [any thread] */

/** The role of the device that ticks the run; "" if a timer does. [any thread] */
TACTUS_API const char* tactus_session_clock (const tactus_session*);

/** The state of a real device. */
typedef struct tactus_health
{
    uint32_t size;
    const char* role;
    const char* profile; /**< id of its profile or driver */
    int32_t is_connected;
    double age_s, oldest_s; /**< age of its readings: now, and the oldest so far */
    double rate_hz;         /**< of its reports; 0: unknown */
    uint64_t reports, lost, departures;
    const char* trouble; /**< the latest failure, or "" */
} tactus_health;

#define TACTUS_HEALTH                                              \
    {                                                              \
        sizeof (tactus_health), 0, 0, 0, 0.0, 0.0, 0.0, 0, 0, 0, 0 \
    }

TACTUS_API size_t tactus_session_health_count (tactus_session*);                                /**< real devices, present or awaited [main thread] */
TACTUS_API tactus_result tactus_session_health (tactus_session*, size_t index, tactus_health*); /**< [main thread] */

/** Moves what has happened since the last call to `messages`: alarms of the guardian, stops of the guards, trouble with devices and the log.
 *  Returns how many. Messages wait until they are asked for; of more than 1000, the oldest are lost. [main thread] */
TACTUS_API size_t tactus_session_events (tactus_session*, tactus_messages*);

#endif
