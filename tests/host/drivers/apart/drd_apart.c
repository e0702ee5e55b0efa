/* SPDX-License-Identifier: MIT */
/* A second libdrd.so, written from the public facts about these libraries and from nothing else: not from our driver, and not from the fake that is handed out.
   Whatever the driver assumes and the facts do not say shows when both meet. Its arm is a mass on the spring and damper of a hand, in the maker's axes:
   x towards the person, y to the right, z up. Where the facts leave a choice, this library takes the stricter one. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "drd_apart.h"
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

// clang-format off
typedef unsigned char uchar;
typedef unsigned int uint;
typedef unsigned short ushort;

enum { COM = 2, NO_DEVICE = 5, NOT_AVAILABLE = 6, TIMEOUT = 7, EXPERT_DISABLED = 9, BAD_INDEX = 15, NULL_ARGUMENT = 17, IN_USE = 20 };
enum { RESET = 0, IDLE = 1, FORCE = 2, BRAKE = 3 };

static struct drd_apart* a;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static __thread int last_error;
static int expert;
static struct arm
{
    int open, index, gravity;
    double x[3], v[3], f[3], t[3], g, told[3], told_at, fed_at, at, most;
} arms[2]; /* by id, which an open gives in the order of opening */

static int fail (int error) { return last_error = error, -1; }

static double now (void)
{
    if (a->clock_hz > 0.0)
        return (double) a->forces / a->clock_hz;
    struct timespec t;
    clock_gettime (CLOCK_MONOTONIC, &t);
    return (double) t.tv_sec + 1e-9 * (double) t.tv_nsec;
}

/* Maps the arm of this test: a program loads the library once, and it stays. */
static void begin (void)
{
    static struct drd_apart none;
    const char* name = getenv ("APART_DRD");
    const int file = name == NULL ? -1 : open (name, O_RDWR);
    void* at = file < 0 ? MAP_FAILED : mmap (NULL, sizeof *a, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    a = at == MAP_FAILED ? &none : at;
    if (file >= 0)
        close (file);
}

static void brake (int cause) { a->mode = BRAKE, a->off_cause = cause; }

/* Moves the arm up to now, in steps of at most 0.2 ms. */
static void advance (struct arm* m)
{
    const double t = now(), window = a->watchdog * 125e-6;
    const double kg = a->mass > 0.0 ? a->mass : 0.2;
    if (a->mode == FORCE && a->cause)
        brake (a->cause);
    if (a->mode == FORCE && window > 0.0 && t - m->fed_at > window)
        brake (3);
    const bool on = a->mode == FORCE;
    const double sag = on && m->gravity && t - m->fed_at < 0.02 ? 0.0 : -9.81 * kg;
    if (t - m->at > 0.5)
        m->at = t - 0.5;
    while (m->at < t)
    {
        const double h = fmin (2e-4, t - m->at);
        for (int i = 0; i < 3; ++i)
        {
            const double motor = on ? m->f[i] : 0.0, loss = 15.0 + (a->mode == BRAKE ? 20.0 : 0.0);
            m->v[i] += h * (motor + 300.0 * (a->hand[i] - m->x[i]) - loss * m->v[i] + (i == 2 ? sag : 0.0)) / kg;
            m->x[i] += h * m->v[i];
        }
        m->at += h;
        if (h < 1e-9)
            break;
    }
    for (int i = 0; i < 3; ++i)
    {
        a->position[i] = m->x[i];
        a->force[i] = on ? m->f[i] : 0.0;
        a->torque[i] = on ? m->t[i] : 0.0;
    }
    a->grip = on ? m->g : 0.0;
}

/* The arm that an id means, or NULL with the error set. The lock is held if there is one. */
static struct arm* enter (char id)
{
    pthread_mutex_lock (&lock);
    const int i = (signed char) id == -1 ? 0 : (signed char) id;
    if (i < 0 || i > 1 || !arms[i].open)
    {
        ++a->after_close;
        pthread_mutex_unlock (&lock);
        fail (NO_DEVICE);
        return NULL;
    }
    if (a->gone)
    {
        brake (5);
        for (int k = 0; k < 3; ++k)
            a->force[k] = 0.0;
        pthread_mutex_unlock (&lock);
        fail (COM);
        return NULL;
    }
    if (a->stall_ms > 0)
    {
        const struct timespec wait = {a->stall_ms / 1000, (a->stall_ms % 1000) * 1000000L};
        a->stall_ms = 0;
        nanosleep (&wait, NULL);
    }
    advance (&arms[i]);
    return &arms[i];
}

static int leave (int result) { return pthread_mutex_unlock (&lock), result < 0 ? fail (-result) : result; }

#define WITH(id) struct arm* m = enter (id); if (m == NULL) return -1;
#define ASK(name, value) bool name (char id) { struct arm* m = enter (id); return m != NULL && (leave (0), (value)); }
#define TAKES(name, type) int name (type value, char id) { WITH (id) (void) value; return leave (0); }
#define EXPERT if (!expert) { ++a->outside; return fail (EXPERT_DISABLED); }

int dhdErrorGetLast (void) { return last_error; }
const char* dhdErrorGetStr (int error)
{
    return error == 0 ? "no error" : error == COM ? "communication error" : error == IN_USE ? "device in use" : "some error";
}
const char* dhdErrorGetLastStr (void) { return dhdErrorGetStr (last_error); }
void dhdGetSDKVersion (int* major, int* minor, int* release, int* revision) { *major = 3, *minor = 17, *release = 5, *revision = 0; }
int dhdGetDeviceCount (void) { return begin(), a->gone ? 0 : a->devices; }
int dhdGetAvailableCount (void) { return begin(), a->gone ? 0 : a->devices - arms[0].open - arms[1].open - (a->busy ? 1 : 0); }

static int openIndex (int index)
{
    begin();
    if (a->gone || index < 0 || index >= a->devices)
        return fail (a->gone || a->devices == 0 ? NO_DEVICE : BAD_INDEX);
    pthread_mutex_lock (&lock);
    for (int i = 0; i < 2; ++i)
        if ((arms[i].open && arms[i].index == index) || (index == 0 && a->busy))
            return leave (-IN_USE);
    const int id = arms[0].open ? 1 : 0;
    struct arm* m = &arms[id];
    memset (m, 0, sizeof *m);
    m->open = 1, m->index = index, m->gravity = 1, m->at = m->fed_at = now(), m->told_at = -1.0;
    memcpy (m->x, a->hand, sizeof m->x);
    a->mode = BRAKE, a->off_cause = 0;
    return leave (id);
}

int dhdOpenID (char index) { return openIndex ((signed char) index); }
int dhdOpen (void)
{
    const int id = openIndex (0);
    return id >= 0 || last_error != IN_USE ? id : openIndex (1);
}
static int typeOf (void) { return a->wrist == 2 ? 104 + a->left : a->gripper ? 35 + 2 * a->left : a->wrist ? 34 + 2 * a->left : 33; }
int dhdOpenType (int type) { return begin(), type == typeOf() ? dhdOpen() : fail (NO_DEVICE); }
int dhdOpenSerial (int serial) { return begin(), serial >= a->serial && serial < a->serial + a->devices ? openIndex (serial - a->serial) : fail (NO_DEVICE); }
int drdOpen (void) { return dhdOpen(); }
int drdOpenID (char index) { return dhdOpenID (index); }

int dhdClose (char id)
{
    const int i = (signed char) id == -1 ? 0 : (signed char) id;
    if (i < 0 || i > 1 || !arms[i].open)
        return fail (NO_DEVICE);
    arms[i].open = 0; /* nobody knows what closing does to the motors: here it leaves them as they are, so that the order shows */
    ++a->closed;
    return 0;
}
int drdClose (char id) { return dhdClose (id); }

static int halt (struct arm* m)
{
    ++a->stopped;
    memset (m->f, 0, sizeof m->f), memset (m->t, 0, sizeof m->t), m->g = 0.0;
    brake (4);
    advance (m);
    return leave (0);
}
static int force (struct arm* m, int on)
{
    a->mode = on ? FORCE : BRAKE, a->off_cause = on ? 0 : 4, a->enabled += on, m->fed_at = now();
    return leave (0);
}
int dhdStop (char id) { WITH (id) return halt (m); }
int drdStop (bool on, char id) { WITH (id) return on ? force (m, 1) : halt (m); }
int drdAutoInit (char id) { WITH (id) ++a->calibrated, a->homed = 1; return force (m, 1); }
int drdCheckInit (char id) { return drdAutoInit (id); }
int dhdEnableForce (uchar on, char id) { WITH (id) return force (m, on != 0); }
int dhdEnableGripperForce (uchar on, char id) { WITH (id) (void) on; return leave (a->gripper == 2 ? 0 : -NOT_AVAILABLE); }
int dhdSetBrakes (int on, char id) { WITH (id) if (a->mode != FORCE) a->mode = on ? BRAKE : IDLE; return leave (0); }
int dhdSetGravityCompensation (int on, char id) { WITH (id) m->gravity = on != 0; return leave (0); }
int dhdSetMaxForce (double most, char id) { WITH (id) m->most = most; return leave (0); }
TAKES (dhdSetStandardGravity, double) TAKES (dhdSetEffectorMass, double) TAKES (dhdSetMaxTorque, double) TAKES (dhdSetMaxGripperForce, double)
ASK (drdIsInitialized, a->homed != 0) ASK (drdIsRunning, false) ASK (drdIsMoving, false) ASK (drdIsSupported, true) ASK (dhdIsLeftHanded, a->left != 0)
ASK (dhdHasBase, true) ASK (dhdHasWrist, a->wrist != 0) ASK (dhdHasActiveWrist, a->wrist == 2) ASK (dhdHasGripper, a->gripper != 0)
ASK (dhdHasActiveGripper, a->gripper == 2)

int dhdGetSerialNumber (ushort* serial, char id) { WITH (id) *serial = (ushort) (a->serial + m->index); return leave (0); }
int dhdGetSystemType (char id) { WITH (id) return leave (typeOf()); }
int dhdGetVersion (double* version, char id) { WITH (id) *version = a->watchdog ? 3.1 : 2.2; return leave (0); }
const char* dhdGetSystemName (char id)
{
    return enter (id) == NULL ? NULL : (leave (0), a->wrist == 2 ? "sigma.7" : a->gripper ? "omega.7" : a->wrist ? "omega.6" : "omega.3");
}
int dhdGetStatus (int* status, char id)
{
    const int i = (signed char) id == -1 ? 0 : (signed char) id;
    const bool unplugged = i >= 0 && i < 2 && arms[i].open && a->gone;
    struct arm* m = enter (id);
    if (m == NULL && !unplugged)
        return -1;
    const int all[17] = {1, !unplugged, 1, a->mode == RESET, a->mode == IDLE, a->mode == FORCE, a->mode == BRAKE, a->wrist == 2 && a->mode == FORCE,
        a->wrist != 0, unplugged, m != NULL && m->gravity, 1, a->wrist != 0, 0, unplugged ? 5 : a->off_cause, 0, a->homed};
    memcpy (status, all, (size_t) (a->status_entries ? a->status_entries : 17) * sizeof (int));
    return unplugged ? fail (COM) : leave (0);
}

static int tell (char id, double* x, double* y, double* z, double frame[3][3])
{
    WITH (id)
    if (x == NULL || y == NULL || z == NULL)
        return leave (-NULL_ARGUMENT);
    const double t = now();
    const bool old = m->told_at >= 0.0 && t - m->told_at < a->guard_us * 1e-6;
    if (!old)
        memcpy (m->told, m->x, sizeof m->told), m->told_at = t, ++a->fresh;
    *x = m->told[0], *y = m->told[1], *z = m->told[2];
    for (int i = 0; frame != NULL && i < 9; ++i)
        frame[i / 3][i % 3] = a->wrist ? a->frame[i] : i % 4 == 0 ? 1.0 : 0.0;
    return leave (old ? 1 : 0);
}
int dhdGetPosition (double* x, double* y, double* z, char id) { return tell (id, x, y, z, NULL); }
int dhdGetPositionAndOrientationFrame (double* x, double* y, double* z, double f[3][3], char id) { return tell (id, x, y, z, f); }
int dhdGetOrientationFrame (double f[3][3], char id)
{
    double x, y, z;
    return tell (id, &x, &y, &z, f);
}
static int gripper (double* value, double is, char id) { WITH (id) *value = a->left ? -is : is; return leave (a->gripper ? 0 : -NOT_AVAILABLE); }
int dhdGetGripperAngleRad (double* angle, char id) { return gripper (angle, a->angle, id); }
int dhdGetGripperGap (double* gap, char id) { return gripper (gap, a->angle * 0.05, id); }
int dhdGetButton (int index, char id) { WITH (id) return leave (a->buttons >> index & 1); }
uint dhdGetButtonMask (char id)
{
    struct arm* m = enter (id);
    return m == NULL ? 0U : (leave (0), (uint) a->buttons);
}

static int command (const double f[3], const double* t, double g, char id)
{
    WITH (id)
    double length = sqrt (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]), most = a->strongest > 0.0 ? a->strongest : 12.0, by = 1.0;
    if (m->most > 0.0)
        most = fmin (most, m->most);
    if (length > most)
        by = most / length;
    for (int i = 0; i < 3; ++i)
        m->f[i] = by * f[i], m->t[i] = t != NULL && a->wrist == 2 ? t[i] : 0.0, a->commanded[i] = f[i];
    m->g = a->gripper == 2 ? (a->left ? -g : g) : 0.0;
    ++a->forces;
    m->fed_at = now();
    advance (m);
    return leave (by < 1.0 ? 2 : 0);
}
int dhdSetForce (double x, double y, double z, char id) { return command ((double[3]){x, y, z}, NULL, 0.0, id); }
int dhdSetForceAndTorque (double x, double y, double z, double u, double v, double w, char id)
{
    return command ((double[3]){x, y, z}, (double[3]){u, v, w}, 0.0, id);
}
int dhdSetForceAndGripperForce (double x, double y, double z, double g, char id) { return command ((double[3]){x, y, z}, NULL, g, id); }
int dhdSetForceAndTorqueAndGripperForce (double x, double y, double z, double u, double v, double w, double g, char id)
{
    return command ((double[3]){x, y, z}, (double[3]){u, v, w}, g, id);
}

int dhdEnableExpertMode (void) { return expert = 1, 0; }
int dhdDisableExpertMode (void) { return expert = 0, 0; }
int dhdSetTimeGuard (int us, char id) { EXPERT WITH (id) a->guard_us = us < 0 ? 250 : us; return leave (0); }
int dhdSetWatchdog (uchar units, char id) { EXPERT WITH (id) a->watchdog = units; return leave (0); }
int dhdGetWatchdog (uchar* units, char id) { EXPERT WITH (id) *units = (uchar) a->watchdog; return leave (a->watchdog ? 0 : -NOT_AVAILABLE); }
int dhdSetVelocityThreshold (uint threshold, char id) { EXPERT WITH (id) (void) threshold; return leave (0); }
int dhdGetVelocityThreshold (uint* threshold, char id) { EXPERT WITH (id) *threshold = 60; return leave (0); }
// clang-format on
