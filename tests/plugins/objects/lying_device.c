/* SPDX-License-Identifier: MIT */
/* A driver of a device that is not there. It reports 1000 times a second, and takes a force. Its port says how it lies; "honest": not at all. The key
   "log" names a file that gets a line for each force, rest and close. The variable LYING_FIND says how its list of devices lies. Each macro BAD_…
   makes the driver itself wrong in one way. */
#include <tactus/tactus_device.h>

#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#ifndef NAME
#define NAME "lying"
#endif

typedef struct device
{
    char port[64];
    FILE* log;
    uint64_t number;
    int is_driven;
    struct timespec next;
    pthread_mutex_t held;
} device;

static int opened; /* so far */

static void say (const tactus_plugin_report* report, const char* text) { report->put (report->context, text, strlen (text)); }
static int lies (const device* d, const char* how) { return strcmp (d->port, how) == 0; }

static void wait_ms (long ms)
{
    const struct timespec time = { ms / 1000, ms % 1000 * 1000000 };
    nanosleep (&time, NULL);
}

static int32_t check (const tactus_device_description* given, const tactus_plugin_report* report)
{
#ifdef BAD_CHECK
    (void)given;
    (void)report;
    return TACTUS_DEVICE_FAILED;
#endif
    if (strchr (given->port, '%') == NULL) return TACTUS_DEVICE_OK;
    say (report, "a port has no %");
    return TACTUS_DEVICE_FAILED;
}

static void* later (void* nothing)
{
    wait_ms (1000);
    return nothing;
}

static void* open_device (const tactus_device_description* given, tactus_device_about* about, const tactus_plugin_report* report)
{
    static const char* axes[] = { "twist", "squeeze" };
    static const char* buttons[] = { "grip" };
    static const char* many[40];
    device* d = calloc (1, sizeof *d);
#ifdef BAD_CRASH
    d->number = (uint64_t) * (volatile int*)8;
#endif
    if (given->port[0] == '/' || strstr (given->json, "\"about\"") != NULL) /* a key that no driver gets */
    {
        say (report, "there is no such device");
        free (d);
        return NULL;
    }
    snprintf (d->port, sizeof d->port, "%s", given->port);
    pthread_mutex_init (&d->held, NULL);
    clock_gettime (CLOCK_MONOTONIC, &d->next);
    const char* log = strstr (given->json, "\"log\":\"");
    if (log != NULL)
    {
        char name[256] = { 0 };
        sscanf (log + 7, "%255[^\"]", name);
        d->log = fopen (name, "a");
    }
    about->about = "A device that is not there.";
    about->tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_FORCE;
    about->axes = axes;
    about->axis_count = 2;
    about->buttons = buttons;
    about->button_count = 1;
    about->rate_hz = lies (d, "fast") ? 100 : 1000;
    about->guard = "{\"max_force\": \"2 N\", \"max_slew\": \"500 N/s\", \"watchdog\": \"50 ms\"}";
    about->device_watchdog_s = 0.02;
    about->stamps = lies (d, "unstamped") ? 0 : TACTUS_DEVICE_NUMBERS;
    if (lies (d, "no_failsafe")) about->device_watchdog_s = 0;
    if (lies (d, "late_failsafe")) about->device_watchdog_s = 0.6;
    if (lies (d, "no_limits")) about->guard = "{\"watchdog\": 0.02}";
    if (lies (d, "no_json")) about->guard = "2 N";
    if (lies (d, "changes") && opened % 2 == 1) about->guard = "{\"max_force\": 20}";
    if (lies (d, "many"))
    {
        for (int i = 0; i < 40; ++i)
            many[i] = "a";
        about->axes = many;
        about->axis_count = 40;
    }
    if (lies (d, "twins")) axes[1] = "twist";
    if (lies (d, "no_file")) about->rest_file = "/nowhere/tty";
    if (lies (d, "leaks")) (void)! open ("/dev/null", O_RDONLY);
    if (lies (d, "past_about")) memset (about + 1, 0, 8);
    pthread_t thread;
    if (lies (d, "runs_on") && pthread_create (&thread, NULL, later, NULL) == 0) pthread_detach (thread);
    ++opened;
    return d;
}

static int32_t read_device (void* device_, int32_t timeout_ms, tactus_reading* reading, tactus_device_stamp* stamp, const tactus_plugin_report* report)
{
    device* d = device_;
    if (lies (d, "hangs"))
        for (;;)
            pause();
    if (lies (d, "early")) return TACTUS_DEVICE_NONE;
    if (lies (d, "late")) wait_ms (2 * timeout_ms + 200);
    if (lies (d, "blocks"))
    {
        pthread_mutex_lock (&d->held);
        wait_ms (timeout_ms);
        pthread_mutex_unlock (&d->held);
        return TACTUS_DEVICE_NONE;
    }
    if (lies (d, "fails")) return TACTUS_DEVICE_FAILED;
    if (lies (d, "gone"))
    {
        say (report, "nobody is there");
        return TACTUS_DEVICE_GONE;
    }
    const int batch = lies (d, "batches") ? 16 : 1; /* readings that come at once; only the last is returned */
    if (! lies (d, "spins"))
    {
        d->next.tv_nsec += batch * 1000000L;
        if (d->next.tv_nsec >= 1000000000)
        {
            d->next.tv_nsec -= 1000000000;
            ++d->next.tv_sec;
        }
        clock_nanosleep (CLOCK_MONOTONIC, TIMER_ABSTIME, &d->next, NULL);
    }
    d->number += (uint64_t)batch;
    reading->valid = lies (d, "not_homed") ? 0 : 1;
    reading->position[0] = lies (d, "nan") ? NAN : 1e-3 * (double)(d->number % 10);
    reading->age_s = lies (d, "old") ? -1 : 0;
    reading->axis_count = lies (d, "few") ? 1 : 2;
    if (lies (d, "past_end")) memset (reading + 1, 0, 8);
    stamp->number = lies (d, "no_number") ? 0 : lies (d, "repeats") ? 1
                                            : lies (d, "back")      ? 1000 - d->number % 100
                                                                    : d->number;
    return TACTUS_DEVICE_OK;
}

static int32_t write_device (void* device_, const tactus_effort* effort, const tactus_plugin_report* report)
{
    device* d = device_;
    d->is_driven = 1;
    if (lies (d, "slow")) wait_ms (150);
    if (lies (d, "blocks"))
    {
        pthread_mutex_lock (&d->held);
        pthread_mutex_unlock (&d->held);
    }
    if (lies (d, "mute")) return TACTUS_DEVICE_FAILED;
    if (lies (d, "refuses") || lies (d, "dead"))
    {
        say (report, "no");
        return TACTUS_DEVICE_FAILED;
    }
    if (d->log != NULL) fprintf (d->log, "force %g\n", effort->force[0]);
    return TACTUS_DEVICE_OK;
}

static int32_t rest_device (void* device_, const tactus_plugin_report* report)
{
    device* d = device_;
    if (lies (d, "slow_rest")) wait_ms (60);
    if ((lies (d, "no_rest") || lies (d, "dead")) && d->is_driven)
    {
        say (report, "it is stuck");
        return TACTUS_DEVICE_FAILED;
    }
    if (d->log != NULL) fprintf (d->log, "rest\n");
    return TACTUS_DEVICE_OK;
}

static const tactus_device_finder* kept;

static void* add_later (void* nothing)
{
    static const tactus_device_found late = { sizeof late, "late", "a device", 0 };
    wait_ms (5);
    kept->add (kept->context, &late);
    return nothing;
}

static int32_t find_devices (const tactus_device_finder* finder, const tactus_plugin_report* report)
{
    static char endless[8192];
    static int calls;
    static tactus_device_finder copy;
    const char* lie = getenv ("LYING_FIND");
    if (lie == NULL) lie = "";
    tactus_device_found found = { sizeof found, "honest", "a device", 0 };
    ++calls;
    if (strcmp (lie, "mute") == 0) return TACTUS_DEVICE_FAILED;
    if (strcmp (lie, "away") == 0)
    {
        say (report, "the library is missing");
        return TACTUS_DEVICE_FAILED;
    }
    if (strcmp (lie, "answer") == 0) return TACTUS_DEVICE_NONE;
    if (strcmp (lie, "crash") == 0) found.port = (const char*)8;
    if (strcmp (lie, "size") == 0) found.size = 4;
    if (strcmp (lie, "no_port") == 0) found.port = NULL;
    if (strcmp (lie, "no_name") == 0) found.name = NULL;
    if (strcmp (lie, "empty_name") == 0) found.name = "";
    if (strcmp (lie, "state") == 0) found.state = 64;
    if (strcmp (lie, "bytes") == 0) found.name = "\x1b[2J\xff";
    if (strcmp (lie, "refused") == 0) found.port = "50%";
    if (strcmp (lie, "endless") == 0)
    {
        memset (endless, 'x', sizeof endless);
        found.port = endless;
    }
    if (strcmp (lie, "changes") == 0 && calls % 2 == 0) found.port = "other";
    finder->add (finder->context, strcmp (lie, "null") == 0 ? NULL : &found);
    if (strcmp (lie, "twice") == 0) finder->add (finder->context, &found);
    for (int i = 0; i < 2000 && strcmp (lie, "many") == 0; ++i)
    {
        char port[16];
        snprintf (port, sizeof port, "%d", i);
        found.port = port;
        finder->add (finder->context, &found);
    }
    copy = *finder;
    kept = &copy;
    pthread_t thread;
    if (strcmp (lie, "later") == 0 && pthread_create (&thread, NULL, add_later, NULL) == 0) pthread_detach (thread);
    return TACTUS_DEVICE_OK;
}

static void close_device (void* device_)
{
    device* d = device_;
    if (d->log != NULL)
    {
        fprintf (d->log, "close\n");
        fclose (d->log);
    }
    pthread_mutex_destroy (&d->held);
    free (d);
}

#ifdef BAD_ABI
#define ABI 99
#else
#define ABI TACTUS_DEVICE_ABI
#endif
#ifdef BAD_SIZE
#define SIZE 16
#else
#define SIZE sizeof (tactus_device_driver)
#endif
#ifdef BAD_REST
#define REST NULL
#else
#define REST rest_device
#endif
#ifdef BAD_KEY
#define KEY "guard"
#else
#define KEY "log"
#endif

static const char* const keys[] = { "port", KEY };

#ifndef BAD_NO_ENTRY
const tactus_device_driver tactus_device_entry = { SIZE, ABI, NAME, "1", "A driver for tests.", keys, 2, check, open_device, read_device, write_device, REST,
                                                   close_device, find_devices };
#endif
