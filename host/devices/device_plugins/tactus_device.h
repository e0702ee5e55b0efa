/* SPDX-License-Identifier: MIT */
#ifndef TACTUS_DEVICE_H
#define TACTUS_DEVICE_H

/**
 * The binary interface between Tactus and device drivers. See docs/plugins.md#device-drivers; docs/examples/device_plugin is a driver.
 *
 * A driver is a shared object NAME.tactus-device that exports one symbol, `tactus_device_entry`. NAME is the name of the driver in the option
 * --device ROLE=NAME:PORT and in descriptions of devices: {"driver": "NAME", "port": "PORT"}. Only a person chooses a driver; a graph cannot.
 *
 * Conventions
 *  - Those of tactus_plugin.h: SI units, UTF-8, structs that begin with their size and have initialisers, such as TACTUS_DEVICE_BYTES_INIT. x points
 *    right, y away from the person, z up. The force and the torque act on the tool.
 *  - A struct that a driver fills comes with its size set and everything else 0. A driver writes only members that the size covers.
 *  - No C++ exception and no longjmp crosses the interface: the program would end. A function that can fail returns TACTUS_DEVICE_FAILED and says
 *    why in `report`, in a sentence without a full stop.
 *  - Threads. No function is called on the thread that ticks the graph, so each may allocate, lock, and wait as long as its comment allows.
 *    [opening thread]: any thread; never two such calls at the same time for the same driver. [reading thread] and [writing thread]: threads that
 *    Tactus starts for each device. They run at the same time: `read` must not wait for a lock that `write` or `rest` holds while it waits.
 *    `close` comes when no other call for the device runs.
 *  - The guard of the run limits every effort. Tactus limits it once more by the wall clock before `write`. If no effort comes for longer than the
 *    `watchdog` of the limits, it calls `rest`. So a driver only passes on what it gets, and never repeats an effort by itself.
 */

#include "tactus.h"        /* tactus_reading, tactus_effort, TACTUS_CHANNELS */
#include "tactus_plugin.h" /* tactus_plugin_report, TACTUS_PLUGIN_EXTERN, TACTUS_PLUGIN_EXPORT, TACTUS_PLUGIN_NOEXCEPT */

/** The version of this interface. It grows only when drivers built for an older version can no longer be loaded. */
#define TACTUS_DEVICE_ABI 1

enum
{
    TACTUS_DEVICE_OK = 0,
    TACTUS_DEVICE_FAILED = 1,
    TACTUS_DEVICE_NONE = 2, /**< of read: no reading came in time */
    TACTUS_DEVICE_GONE = 3  /**< the device is not there any more: Tactus closes it, and tries to open it again, every half second */
};

/** What the person asks for. Valid until the function has returned and Tactus has copied what it has filled in. */
typedef struct tactus_device_description
{
    uint32_t size;
    const char* port; /**< the value of the key "port"; "" if it is not given */
    const char* json; /**< the keys of the driver as a JSON object, for drivers that have more than "port" */
} tactus_device_description;

#define TACTUS_DEVICE_DESCRIPTION_INIT           \
    {                                            \
        sizeof (tactus_device_description), 0, 0 \
    }

/** Bytes that are written at once. */
typedef struct tactus_device_bytes
{
    uint32_t size;
    const uint8_t* bytes;
    size_t count;
} tactus_device_bytes;

#define TACTUS_DEVICE_BYTES_INIT           \
    {                                      \
        sizeof (tactus_device_bytes), 0, 0 \
    }

/** What the tool of a device has. */
enum
{
    TACTUS_DEVICE_POSITION = 1,
    TACTUS_DEVICE_ROTATION = 2,
    TACTUS_DEVICE_PRESSURE = 4,
    TACTUS_DEVICE_FORCE = 8,
    TACTUS_DEVICE_TORQUE = 16
};

/** Directions of the force and the torque that no motor of the tool renders. */
enum
{
    TACTUS_DEVICE_NO_FORCE_X = 1,
    TACTUS_DEVICE_NO_FORCE_Y = 2,
    TACTUS_DEVICE_NO_FORCE_Z = 4,
    TACTUS_DEVICE_NO_TORQUE_X = 8,
    TACTUS_DEVICE_NO_TORQUE_Y = 16,
    TACTUS_DEVICE_NO_TORQUE_Z = 32
};

/** What the device says about every reading, in its tactus_device_stamp. */
enum
{
    TACTUS_DEVICE_NUMBERS = 1,
    TACTUS_DEVICE_TIMES = 2
};

/** What a device is. Tactus copies it when `open` has returned. It must be the same each time the same device is opened. */
typedef struct tactus_device_about
{
    uint32_t size;
    uint32_t tool;              /**< TACTUS_DEVICE_POSITION | … */
    const char* about;          /**< a sentence: "The lab arm at /dev/ttyACM0." */
    const char* const* axes;    /**< names of axes that can be read, in m or rad: a to z, digits and _ */
    size_t axis_count;          /**< of axes, efforts and buttons, there are at most 32 each */
    const char* const* efforts; /**< names of axes that can be pushed, in N or N m. Not those whose motors also render the force */
    size_t effort_count;
    const char* const* buttons; /**< by bit; "" for a button without a name */
    size_t button_count;
    int32_t signal_inputs, signal_outputs;
    double mass, damping; /**< of the tool, in kg and N s/m; 0: unknown */
    double rate_hz;       /**< of the readings; 0: not regular */

    /** JSON with the hard limits of the device, as in docs/safety.md: {"max_force": "3 N", "max_slew": "500 N/s", "watchdog": "20 ms"}. Nothing can
     *  loosen them. A device that takes a force needs max_force; likewise max_torque, max_axis_effort and max_signal. The default of `watchdog` is
     *  100 ms, that of `ramp` 200 ms. */
    const char* guard;

    /** If the program dies or freezes, another process writes these reports to this file, for example a tty, and so brings the device to rest. That
     *  process opens the file when the device is opened, so a driver must not claim it for itself alone (TIOCEXCL). The reports may come in the middle
     *  of what the program was writing, and twice. Begin them with what ends a message. NULL: there is no such file; then a device that takes efforts
     *  needs a watchdog of its own, or it is refused. */
    const char* rest_file;
    const tactus_device_bytes* const* rest_reports;
    size_t rest_report_count;

    double device_watchdog_s; /**< how long the device itself keeps an effort when nothing new comes, in s; 0: forever, or unknown. Without a rest_file,
                                   at most 0.5 s */
    uint32_t unrendered;      /**< TACTUS_DEVICE_NO_FORCE_X | …: these parts are 0 in all efforts, and the guard does not count them; otherwise a force
                                   without a motor could hide energy from it. 0: the motors render every direction */
    uint32_t stamps;          /**< TACTUS_DEVICE_NUMBERS | …: a reading without them is not used. 0: neither; then nothing shows that the device has stopped
                                   measuring and repeats a reading, so a device that takes a force along its position needs max_still and still_force in
                                   `guard`, and one that takes a torque along its rotation needs max_still and still_torque */
} tactus_device_about;

#define TACTUS_DEVICE_ABOUT_INIT                                                                         \
    {                                                                                                    \
        sizeof (tactus_device_about), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0, 0, 0, 0, 0.0, 0, 0 \
    }

/** Why a device cannot be trusted, by its own account. */
enum
{
    TACTUS_DEVICE_TOO_HOT = 1,
    TACTUS_DEVICE_TIMED_OUT = 2,  /**< its watchdog has released the motors */
    TACTUS_DEVICE_NOT_DRIVEN = 3, /**< its motors are not driven, although they should be */
    TACTUS_DEVICE_NOT_HOMED = 4,  /**< it does not know its position */
    TACTUS_DEVICE_STOPPED = 5,    /**< its own emergency stop is pressed */
    TACTUS_DEVICE_BROKEN = 6
};

/** What the device itself says about a reading. Whatever it does not say is 0. With a number or a time, Tactus finds readings that are repeated, lost,
 *  out of order, or older than they seem. */
typedef struct tactus_device_stamp
{
    uint32_t size;
    uint32_t fault;    /**< TACTUS_DEVICE_TOO_HOT, …: the reading is not used, and the force goes to zero; 0: none */
    uint64_t number;   /**< counted by the device from 1, one more for each reading, without wrapping around */
    double time_s;     /**< when it was measured, by a clock of the device that is right to 0.1 % and does not wrap around */
    double reached_hz; /**< how many new efforts per second have reached the device lately, as the driver measures it; for people to see */
} tactus_device_stamp;

#define TACTUS_DEVICE_STAMP_INIT                     \
    {                                                \
        sizeof (tactus_device_stamp), 0, 0, 0.0, 0.0 \
    }

/** How far a driver knows a device that it has found. */
enum
{
    TACTUS_DEVICE_IN_USE = 1, /**< another role or another program has it open */
    TACTUS_DEVICE_UNSEEN = 2  /**< it is known by its name only: whether it is connected shows when it is opened */
};

/** A device that a driver has found. */
typedef struct tactus_device_found
{
    uint32_t size;
    const char* port; /**< the value of "port" with which `open` opens it; "": the driver needs none */
    const char* name; /**< for people: "omega.3, serial number 10234" */
    uint32_t state;   /**< TACTUS_DEVICE_IN_USE | … */
} tactus_device_found;

#define TACTUS_DEVICE_FOUND_INIT              \
    {                                         \
        sizeof (tactus_device_found), 0, 0, 0 \
    }

/** Takes the devices that `find` finds. */
typedef struct tactus_device_finder
{
    uint32_t size;
    void* context;
    void (*add) (void* context, const tactus_device_found*); /**< copies what it gets [opening thread] */
} tactus_device_finder;

#define TACTUS_DEVICE_FINDER_INIT           \
    {                                       \
        sizeof (tactus_device_finder), 0, 0 \
    }

/** The type of the exported symbol `tactus_device_entry`. `device` is what `open` returned. */
typedef struct tactus_device_driver
{
    uint32_t size;
    uint32_t abi;            /**< TACTUS_DEVICE_ABI */
    const char* name;        /**< that of the file without its suffix: a to z, digits and _, beginning with a letter */
    const char* version;     /**< for people */
    const char* about;       /**< a sentence */
    const char* const* keys; /**< the keys of a description that the driver knows, such as "port". Tactus itself reads "driver", "guard", "about", "ui" */
    size_t key_count;        /**< and "workspace", and refuses all others */

    /** Optional. Checks what can be checked without the device, and reports the first mistake. [opening thread] */
    int32_t (*check) (const tactus_device_description*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;

    /** Opens a device, and says what it is. May wait for some seconds. NULL if it failed. What it reports although it has opened the device is shown
     *  to the person as a warning. [opening thread] */
    void* (*open) (const tactus_device_description*, tactus_device_about*, const tactus_plugin_report*)TACTUS_PLUGIN_NOEXCEPT;

    /** Waits for the next reading, `timeout_ms` at most. Also tells what the device says about it. Returns one reading per call. If some are waiting,
     *  as behind an adapter that passes on several at once, it returns the oldest of them, at once, and leaves out none: those that are left out count
     *  as lost. Tactus itself uses only the newest in a tick. Never returns the same reading twice, and does not return at once, again and again, while
     *  there is none. If it takes longer than twice the timeout and another 50 ms, the force goes to zero, if the age of the last reading has not done
     *  that already. [reading thread] */
    int32_t (*read) (void* device, int32_t timeout_ms, tactus_reading*, tactus_device_stamp*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;

    /** NULL if the device takes no efforts. Passes on an effort, and returns as soon as the device has it: what queues up on the way is a delay, and makes
     *  stiff walls buzz. While an earlier effort is on the way, a driver may leave a new one out; if that lasts, it fails. May wait for 20 ms. If it takes
     *  longer than the `watchdog` of the limits, the force goes to zero; after 100 ms, the program counts as frozen. [writing thread] */
    int32_t (*write) (void* device, const tactus_effort*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;

    /** NULL only if `write` is. Brings the device to rest: no force, whatever was written before. The first call for each device, and the last one before
     *  `close`. If it fails, it is called again. May wait for 20 ms. [opening thread the first time, then writing thread] */
    int32_t (*rest) (void* device, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;

    /** Called once. Not called if another function of the device never returns. [opening thread] */
    void (*close) (void* device) TACTUS_PLUGIN_NOEXCEPT;

    /** Optional. Finds the devices that `open` could open, each once, for lists that a person asks for. Pushes and moves nothing, and leaves devices alone
     *  that are in use. May open others for a moment, and wait for some seconds. TACTUS_DEVICE_FAILED, with the reason, if it cannot look; finding none
     *  is no failure. [opening thread] */
    int32_t (*find) (const tactus_device_finder*, const tactus_plugin_report*) TACTUS_PLUGIN_NOEXCEPT;
} tactus_device_driver;

#define TACTUS_DEVICE_DRIVER_INIT                                                            \
    {                                                                                        \
        sizeof (tactus_device_driver), TACTUS_DEVICE_ABI, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 \
    }

TACTUS_PLUGIN_EXTERN TACTUS_PLUGIN_EXPORT const tactus_device_driver tactus_device_entry;

#endif
