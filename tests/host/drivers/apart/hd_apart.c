/* SPDX-License-Identifier: MIT */
/* A second libHD.so, written from the public facts about this library and from nothing else: not from our driver, and not from the fake that is handed
   out. Where the facts leave a choice, it takes the stricter one. Its arm is a mass on the spring and damper of a hand, in mm: x right, y up, z towards the
   person. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "hd_apart.h"
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

// clang-format off
typedef unsigned int uint;
typedef unsigned char uchar;
typedef uint (*callback) (void*);

struct error
{
    uint code;
    int internal;
    uint device;
};

enum
{
    INVALID_ENUM = 0x100, INVALID_VALUE, INVALID_OPERATION, INVALID_INPUT, BAD_HANDLE, DEVICE_FAULT = 0x300, ALREADY, COMM, ILLEGAL_BEGIN = 0x400, ILLEGAL_END,
    FULL = 0x501
};
#define NONE 0xFFFFFFFFU

static struct hd_apart* a;
static struct error stack[16];
static int depth;
static uint current = NONE;
static struct arm
{
    int open, frame, framed, set;
    double x[3], v[3], f[3], t[3], next[3], twist[3];
} arms[2];
static struct job
{
    callback call;
    void* user;
    ushort priority;
    int live;
} jobs[8];
static pthread_t servo;
static pthread_mutex_t turn = PTHREAD_MUTEX_INITIALIZER; /* held while callbacks run: who stops or unschedules waits for them */
static _Atomic int running;
static int force_output = 1;
static double began;

static double now (void)
{
    struct timespec t;
    clock_gettime (CLOCK_MONOTONIC, &t);
    return (double) t.tv_sec + 1e-9 * (double) t.tv_nsec;
}

static void raise_error (uint code)
{
    if (code < 0x200 || code == ILLEGAL_BEGIN || code == ILLEGAL_END)
        ++a->misuse;
    if (depth < 16)
        stack[depth++] = (struct error){code, code == COMM ? -28 : 0, current};
}

__attribute__ ((constructor)) static void begin (void)
{
    const char* name = getenv ("APART_HD");
    const int file = name == NULL ? -1 : open (name, O_RDWR);
    a = file < 0 ? MAP_FAILED : mmap (NULL, sizeof *a, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (a == MAP_FAILED)
        a = calloc (1, sizeof *a);
    if (file >= 0)
        close (file);
}

struct error hdGetError (void) { return depth > 0 ? stack[--depth] : (struct error){0, 0, NONE}; }

const char* hdGetErrorString (uint code)
{
    return code == 0x200 ? "Warm motors" : code == COMM ? "Communication error" : code == DEVICE_FAULT ? "Device fault" : code == 0 ? "Success" : "Other error";
}

uint hdInitDevice (const char* name)
{
    const char* is = name != NULL ? name : a->refuses_null ? "" : "Left";
    const int which = !strcmp (is, "Left") || !strcmp (is, "Default Device") ? 0 : !strcmp (is, "Right") ? 1 : -1;
    if (which < 0 || which >= a->devices)
        return raise_error (DEVICE_FAULT), NONE;
    if (arms[which].open)
        return raise_error (ALREADY), NONE;
    memset (&arms[which], 0, sizeof arms[which]);
    memcpy (arms[which].x, a->hand, sizeof a->hand);
    arms[which].open = 1;
    return current = (uint) which;
}

static struct arm* of (uint device)
{
    if (device < 2 && arms[device].open)
        return &arms[device];
    ++a->late;
    raise_error (BAD_HANDLE);
    return NULL;
}

void hdDisableDevice (uint device)
{
    struct arm* m = of (device);
    if (m == NULL)
        return;
    m->open = 0;
    ++a->disabled;
    memset (a->force, 0, sizeof a->force);
}
uint hdGetCurrentDevice (void) { return current; }
void hdMakeCurrentDevice (uint device) { current = of (device) != NULL ? device : current; }

void hdBeginFrame (uint device)
{
    struct arm* m = of (device);
    if (m == NULL)
        return;
    if (m->frame || m->framed)
        { raise_error (ILLEGAL_BEGIN); return; }
    current = device;
    m->frame = m->framed = 1, m->set = 0;
    memset (m->next, 0, sizeof m->next), memset (m->twist, 0, sizeof m->twist);
}

void hdEndFrame (uint device)
{
    struct arm* m = of (device);
    if (m == NULL)
        return;
    if (!m->frame)
        { raise_error (ILLEGAL_END); return; }
    m->frame = 0;
    ++*(m->set ? &a->forces : &a->empty);
    for (int i = 0; i < 3; ++i)
        m->f[i] = force_output ? m->next[i] : 0.0, m->t[i] = force_output ? m->twist[i] : 0.0;
}

static struct arm* inside (void)
{
    struct arm* m = of (current);
    if (m != NULL && !m->frame && !a->lenient)
        return raise_error (INVALID_OPERATION), NULL;
    return m;
}

/* What stands still may be asked for at any time; what moves only within a frame. */
static int values (uint what, double* out)
{
    struct arm* m = what < 0x2500 || what == 0x2700 ? inside() : of (current);
    const double box[6] = {-210.0, -110.0, -85.0, 210.0, 205.0, 130.0};
    if (m == NULL)
        return 0;
    switch (what)
    {
        case 0x2000: return *out = a->buttons, 1;
        case 0x2002: return *out = a->calibration == 2 ? 0.0 : 1.0, 1;
        case 0x2050: return memcpy (out, m->x, sizeof m->x), 3;
        case 0x2051: return memcpy (out, m->v, sizeof m->v), 3;
        case 0x2052:
            memset (out, 0, 16 * sizeof *out);
            out[0] = out[10] = cos (a->turn), out[8] = sin (a->turn), out[2] = -out[8], out[5] = out[15] = 1.0;
            memcpy (out + 12, m->x, sizeof m->x);
            return 16;
        case 0x2100: case 0x2150: return memset (out, 0, 3 * sizeof *out), 3;
        case 0x2700: return memcpy (out, m->next, sizeof m->next), 3;
        case 0x2550: case 0x2551: return memcpy (out, box, sizeof box), 6;
        case 0x2552: return *out = 168.0, 1;
        case 0x2553: return *out = 6.0, 1;
        case 0x2554: return *out = a->motors, 1;
        case 0x2555: return *out = a->style, 1;
        case 0x2600:
        case 0x2601: return *out = a->rate_hz ? a->rate_hz : 1000, 1;
        case 0x2602: return *out = 1.02, 1;
        case 0x2603: return *out = 3.3, 1;
        case 0x2604: return *out = 0.88, 1;
        case 0x2605:
            for (int i = 0; i < a->motors; ++i)
                out[i] = a->warm;
            return a->motors;
        case 0x2606: return *out = 1000.0, 1;
        case 0x2607: return *out = 1.0, 1;
        case 0x2608: return *out = 100.0, 1;
        case 0x2609: return *out = 0.002, 1;
        default: return raise_error (INVALID_ENUM), 0;
    }
}

#define GET(name, type) \
    void name (uint what, type* out) { double all[16]; for (int i = 0, n = values (what, all); i < n; ++i) out[i] = (type) all[i]; }
GET (hdGetBooleanv, uchar) GET (hdGetIntegerv, int) GET (hdGetFloatv, float) GET (hdGetDoublev, double) GET (hdGetLongv, long)

static void put (uint what, const double* in)
{
    struct arm* m = inside();
    if (m == NULL)
        return;
    if (what == 0x2700)
        memcpy (m->next, in, sizeof m->next), m->set = 1;
    else if (what == 0x2701 && a->motors == 6)
        memcpy (m->twist, in, sizeof m->twist);
    else
        raise_error (what == 0x2701 ? INVALID_OPERATION : INVALID_ENUM);
}
void hdSetDoublev (uint what, const double* in) { put (what, in); }
void hdSetFloatv (uint what, const float* in) { put (what, (double[3]){in[0], in[1], in[2]}); }
void hdSetBooleanv (uint what, const uchar* in) { (void) what, (void) in, raise_error (INVALID_INPUT); }
void hdSetIntegerv (uint what, const int* in) { (void) what, (void) in, raise_error (INVALID_INPUT); }
void hdSetLongv (uint what, const long* in) { (void) what, (void) in, raise_error (INVALID_INPUT); }

const char* hdGetString (uint what)
{
    static const char* const texts[] = {"3.40.0", "Touch", "2023.11.15", "apart", "S0000123", "192"};
    return what >= 0x2500 && what <= 0x2505 ? texts[what - 0x2500] : (raise_error (INVALID_ENUM), (const char*) NULL);
}

void hdEnable (uint what) { force_output = what == 0x4000 ? 1 : force_output; }
void hdDisable (uint what) { force_output = what == 0x4000 ? 0 : force_output; }
uchar hdIsEnabled (uint what) { return what == 0x4000 ? (uchar) force_output : what >= 0x4001 && what <= 0x4004; }

uint hdCheckCalibration (void) { return 0x5000U + (uint) a->calibration; }
uint hdCheckCalibrationStyle (void) { return (uint) a->style; }
void hdUpdateCalibration (uint style)
{
    struct arm* m = of (current);
    if (m == NULL || m->frame || !(style & (uint) a->style) || (style != 1 && !running) || (style == 1 && running))
        { raise_error (INVALID_OPERATION); return; }
    if (a->calibration == 1)
        a->calibration = 0, ++a->calibrated;
}

static void move (struct arm* m, double h)
{
    for (int i = 0; i < 3; ++i)
    {
        m->v[i] += h * (1000.0 * m->f[i] + 300.0 * (a->hand[i] - m->x[i]) - 15.0 * m->v[i]) / 0.2;
        m->x[i] += h * m->v[i];
    }
}

/* The callbacks, those of a higher priority first. */
static void run (void)
{
    for (int p = 65535, next; p >= 0; p = next)
    {
        next = -1;
        for (struct job* j = jobs; j < jobs + 8; ++j)
            if (j->live && j->priority == p && j->call (j->user) == 0)
                j->live = 0;
            else if (j->live && j->priority < p && j->priority > next)
                next = j->priority;
    }
}

static void nap (double s)
{
    const struct timespec t = {(time_t) s, (long) (1e9 * (s - floor (s)))};
    nanosleep (&t, NULL);
}

static void* serve (void* unused)
{
    double due = now();
    while (running)
    {
        const double h = 1.0 / (a->rate_hz ? a->rate_hz : 1000);
        if (!a->fast)
        {
            due = fmax (due + h, now() - 0.1);
            nap (fmax (0.0, due - now()));
        }
        if (a->stall_ms)
        {
            const double wait = 1e-3 * a->stall_ms;
            a->stall_ms = 0;
            nap (wait);
        }
        pthread_mutex_lock (&turn);
        if (a->error)
            raise_error ((uint) a->error), a->error = 0;
        ++a->ticks;
        for (int i = 0; i < 2; ++i)
            arms[i].framed = 0;
        run();
        for (int i = 0; i < 2; ++i)
            if (arms[i].open)
                move (&arms[i], h);
        memcpy (a->position, arms[0].x, sizeof a->position);
        memcpy (a->force, arms[0].f, sizeof a->force), memcpy (a->torque, arms[0].t, sizeof a->torque);
        pthread_mutex_unlock (&turn);
    }
    return unused;
}

void hdStartScheduler (void)
{
    if (running)
        { raise_error (COMM + 2); return; }
    running = 1;
    began = now();
    pthread_create (&servo, NULL, serve, NULL);
}
void hdStopScheduler (void)
{
    if (!running)
        return;
    running = 0;
    pthread_join (servo, NULL);
    ++a->stopped;
    memset (a->force, 0, sizeof a->force);
}
void hdSetSchedulerRate (unsigned long hz)
{
    if (hz != 500 && hz != 1000)
        { raise_error (INVALID_VALUE); return; }
    a->rate_hz = (int) hz;
}
unsigned long hdScheduleAsynchronous (callback call, void* user, ushort priority)
{
    for (unsigned long i = 0; i < 8; ++i)
        if (!jobs[i].live)
            return jobs[i] = (struct job){call, user, priority, 1}, i + 1;
    return raise_error (FULL), 0UL;
}
static int take (void) { return running && !pthread_equal (pthread_self(), servo) && pthread_mutex_lock (&turn) == 0; }
static void give (int taken) { if (taken) pthread_mutex_unlock (&turn); }
void hdScheduleSynchronous (callback call, void* user, ushort priority)
{
    const int taken = take();
    for (uint again = 1; again; (void) priority)
        again = call (user);
    give (taken);
}
void hdUnschedule (unsigned long handle)
{
    const int taken = take();
    if (handle >= 1 && handle <= 8)
        jobs[handle - 1].live = 0;
    give (taken);
}
uchar hdWaitForCompletion (unsigned long handle, uint wait) { return (void) wait, handle >= 1 && handle <= 8 && jobs[handle - 1].live; }
double hdGetSchedulerTimeStamp (void) { return now() - began; }
// clang-format on
