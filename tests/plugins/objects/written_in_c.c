/* SPDX-License-Identifier: MIT */
/* A plugin in C that doubles its input. Each macro BAD_… makes it wrong in one way; GROWN makes it newer than this version,
   ALONE makes it notice two calls at the same time, and SAVES gives it a state: it adds the sum of the inputs before. */
#include <tactus/tactus_plugin.h>

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* SMALL: a size without the padding at the end of the struct. It must be accepted, because it covers all members. */
#ifdef SMALL
#define UNIT_SIZE (offsetof (tactus_plugin_unit, adds_up) + sizeof (int32_t))
#else
#define UNIT_SIZE sizeof (tactus_plugin_unit)
#endif
static const tactus_plugin_unit one = { UNIT_SIZE, TACTUS_PLUGIN_UNIT_FIXED, "any", 0, 0, 0, "1", "", "", 0 };
static const tactus_plugin_limits any = { sizeof any, 0, -1e300, 1e300, -1e300, 1e300 };

#ifdef BAD_OFFSET
#define OFFSET 4096
#else
#define OFFSET 0
#endif
#ifdef BAD_ID
#define ID "No Name"
#else
#define ID "c.twice"
#endif

static const tactus_plugin_port in = { sizeof in, TACTUS_PLUGIN_INPUT, "in", "a number", &one, &any, 0, 0, 1, 0, 0, { 0, 0, 0 } };
static const tactus_plugin_port out = { sizeof out, TACTUS_PLUGIN_OUTPUT, "out", "twice the number", &one, &any, 0, 0, 1, 0, OFFSET, { 0, 0, 0 } };
static const tactus_plugin_port* const ports[] = { &in, &out };

/* With ALONE: begins and ends a call that no other may overlap. */
#ifdef ALONE
static int calls;    /* running now */
static int overlaps; /* so far */
static void begin (void)
{
    if (__atomic_fetch_add (&calls, 1, __ATOMIC_SEQ_CST) != 0) __atomic_store_n (&overlaps, 1, __ATOMIC_SEQ_CST);
    usleep (100); /* long enough for another thread to get here */
}
static void end (void) { __atomic_fetch_sub (&calls, 1, __ATOMIC_SEQ_CST); }
#else
static void begin (void)
{
}
static void end (void) {}
#endif

static void* create (const tactus_plugin_report* report)
{
    (void)report;
    begin();
    end();
    return calloc (1, sizeof (double)); /* the sum, with SAVES */
}

static void destroy (void* node)
{
    begin();
    free (node);
    end();
}

static int32_t set (void* node, size_t setting, const tactus_plugin_value* value, const tactus_plugin_report* report)
{
    (void)node;
    (void)setting;
    (void)value;
    (void)report;
    return TACTUS_PLUGIN_FAILED;
}

static void* params (void* node) { return node; }
static void initialise (void* outputs) { *(double*)outputs = 0.0; }

#ifdef BAD_BITS
static double started; /* when the plugin was loaded, in ns */
#endif

#if defined(SAVES) || defined(BAD_STATE) || defined(BAD_NO_RESTORE)
#define HAS_STATE
static int32_t save (const void* node, const tactus_plugin_report* report)
{
    report->put (report->context, (const char*)node, sizeof (double));
    return TACTUS_PLUGIN_OK;
}
#endif
#if defined(SAVES) || defined(BAD_STATE)
static int32_t restore (void* node, const void* bytes, size_t size, const tactus_plugin_report* report)
{
#ifndef BAD_STATE /* which forgets it */
    if (size == sizeof (double))
    {
        memcpy (node, bytes, size);
        return TACTUS_PLUGIN_OK;
    }
    report->put (report->context, "another size", 12);
    return TACTUS_PLUGIN_FAILED;
#endif
    (void)node;
    (void)bytes;
    (void)size;
    (void)report;
    return TACTUS_PLUGIN_OK;
}
#endif

/* What one fault does in each tick; returns what the fault adds to the output. */
static double fault (double v, double* outputs)
{
    (void)v;
    (void)outputs;
#ifdef BAD_CRASH
    *(volatile int*)0 = 1;
#endif
#ifdef BAD_ENDLESS_TICK
    for (volatile double input = v; input > 1e100;)
        ;
#endif
#ifdef BAD_ALLOCATES
    void* volatile block = malloc (16);
    free (block);
#endif
#ifdef BAD_LOCKS
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock (&mutex);
    pthread_mutex_unlock (&mutex);
#endif
#ifdef BAD_CALLS
    return getppid() == 0;
#endif
#ifdef BAD_NAN
    return v < 0.0 ? 0.0 / (v - v) : 0.0;
#endif
#ifdef BAD_STATIC
    static double last;
    const double before = last;
    last = v - v == 0.0 && v < 1e100 && v > -1e100 ? v : 0.0;
    return before;
#endif
#ifdef BAD_BITS
    return started;
#endif
#ifdef BAD_OVERRUN
    outputs[1] = 1.0;
#endif
    return 0.0;
}

static void tick (void* node, const double* const* sources, void* outputs)
{
    const double v = *sources[0];
    double sum = 2.0 * v + fault (v, outputs);
#ifdef HAS_STATE
    const double before = *(double*)node, after = before + v;
    sum += before;
    if (after - after == 0.0) *(double*)node = after;
#endif
    (void)node;
#ifdef BAD_NAN
    *(double*)outputs = v - v == 0.0 ? sum : 0.0;
#else
    *(double*)outputs = v - v == 0.0 && sum - sum == 0.0 ? sum : 0.0;
#endif
}

#ifdef BAD_ENDLESS
static int32_t prepare (void* node, const tactus_plugin_setup* setup, const tactus_plugin_report* report)
{
    volatile int waits = 1;
    (void)node;
    (void)setup;
    (void)report;
    while (waits)
        ;
    return TACTUS_PLUGIN_OK;
}
#endif

#ifdef ALONE
static int32_t problem (const void* node, const tactus_plugin_report* report)
{
    (void)node;
    begin();
    end();
    if (__atomic_load_n (&overlaps, __ATOMIC_SEQ_CST)) report->put (report->context, "two calls at the same time", 26);
    return TACTUS_PLUGIN_OK;
}
#endif

#ifdef BAD_CLAIM
static int32_t claims (const void* node, tactus_plugin_claims* to, const tactus_plugin_report* report)
{
    (void)node;
    (void)report;
    to->amplitude = 1.0;
    return TACTUS_PLUGIN_OK;
}
#endif

/* A later version of the interface, with one more member at the end of each of these structs. */
#ifdef GROWN
typedef struct grown_node
{
    tactus_plugin_node now;
    double more;
} grown_node;
typedef struct grown_plugin
{
    tactus_plugin now;
    double more;
} grown_plugin;
#else
typedef struct grown_node
{
    tactus_plugin_node now;
} grown_node;
typedef struct grown_plugin
{
    tactus_plugin now;
} grown_plugin;
#endif

static grown_node twice;

static int32_t init (const tactus_plugin_host* host, const tactus_plugin_report* report)
{
#ifdef BAD_INIT
    report->put (report->context, "no licence", 10);
    return TACTUS_PLUGIN_FAILED;
#endif
    (void)report;
    if (host->abi != TACTUS_PLUGIN_ABI) return TACTUS_PLUGIN_FAILED;
#ifdef BAD_NODE_SIZE
    twice.now.size = 24;
#else
    twice.now.size = sizeof twice;
#endif
    twice.now.id = ID;
    twice.now.name = "Twice";
    twice.now.summary = "Doubles a number.";
    twice.now.source = "definition";
    twice.now.ports = ports;
    twice.now.port_count = 2;
    twice.now.outputs_size = sizeof (double);
    twice.now.outputs_align = sizeof (double);
    twice.now.create = create;
    twice.now.destroy = destroy;
    twice.now.set = set;
    twice.now.params = params;
    twice.now.initialise_outputs = initialise;
#ifdef BAD_BITS
    struct timespec now;
    clock_gettime (CLOCK_MONOTONIC, &now);
    started = (double)now.tv_nsec;
#endif
#ifdef BAD_ENDLESS
    twice.now.prepare = prepare;
#endif
#ifdef ALONE
    twice.now.problem = problem;
#endif
#ifdef BAD_CLAIM
    twice.now.claims = claims;
#endif
#ifdef HAS_STATE
    twice.now.save = save;
#ifndef BAD_NO_RESTORE
    twice.now.restore = restore;
#endif
#endif
#ifndef BAD_NO_TICK
    twice.now.tick = tick;
#endif
    return TACTUS_PLUGIN_OK;
}

static void deinit (void) {}
#ifdef BAD_TWO_IDS
#define COUNT 2
#else
#define COUNT 1
#endif
static size_t count (void)
{
    return COUNT;
}
static const tactus_plugin_node* node (size_t i) { return i < COUNT ? &twice.now : 0; }
static const void* extension (const char* id)
{
    (void)id;
    return 0;
}

#ifdef BAD_ABI
#define ABI 99
#else
#define ABI TACTUS_PLUGIN_ABI
#endif
#ifdef BAD_SIZE
#define SIZE 16
#else
#define SIZE sizeof (grown_plugin)
#endif

#ifndef BAD_NO_ENTRY
/* The symbol has the type of a later version, so it cannot be declared as in the header. */
#define tactus_plugin_entry tactus_plugin_entry_of_this_file
TACTUS_PLUGIN_EXPORT extern const grown_plugin tactus_plugin_entry_of_this_file __asm__("tactus_plugin_entry");
const grown_plugin tactus_plugin_entry_of_this_file = { .now = { SIZE, ABI, "in C", "1", init, deinit, count, node, extension } };
#endif
