/* SPDX-License-Identifier: MIT */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
/* A second Falcon: see falcon_apart.h. Where the facts leave a choice, it takes the stricter one. */
#include "falcon_apart.h"
#include <asm/termbits.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

static pthread_t server;
static int near_end = -1; /* open, so that the far end does not hang up while no program has it open */
static _Atomic int ends;
static double place[3]; /* of the grip; that of the thread */

/* The angle of each leg's thigh, from the position of the grip: the closed form. */
static void anglesOf (const double p[3], double angle[3])
{
    static const double at[3] = { 105.0, -15.0, -135.0 };
    const double a = .060, b = .1025, c = .01443, d = .01125, f = -.025, r = .0400, s = -.02309;
    for (int i = 0; i < 3; ++i)
    {
        const double phi = at[i] * M_PI / 180.0;
        const double u = p[0] * cos (phi) + p[1] * sin (phi) - r, v = -p[0] * sin (phi) + p[1] * cos (phi) - s, w = p[2];
        const double third = acos (fmin (1.0, fmax (-1.0, (v + f) / b))), l = 2.0 * d + b * sin (third);
        const double k = u * u + w * w + c * c + a * a + 2.0 * c * u - l * l;
        const double l0 = k - 2.0 * a * (u + c), l1 = -4.0 * a * w, l2 = k + 2.0 * a * (u + c);
        angle[i] = 2.0 * atan ((-l1 - sqrt (fmax (0.0, l1 * l1 - 4.0 * l0 * l2))) / (2.0 * l2));
    }
}

/* The force of three motors at a position: torques times the derivative of the angles. */
static void forceOf (const double p[3], const int motors[3], double force[3])
{
    for (int i = 0; i < 3; ++i)
    {
        double up[3] = { p[0], p[1], p[2] }, down[3] = { p[0], p[1], p[2] }, high[3], low[3];
        up[i] += 1e-6, down[i] -= 1e-6;
        anglesOf (up, high), anglesOf (down, low);
        force[i] = 0.0;
        for (int leg = 0; leg < 3; ++leg)
            force[i] += (high[leg] - low[leg]) / 2e-6 * (-motors[leg] / 10000.0);
    }
}

static void answer (struct falcon_apart* a, const unsigned char* packet)
{
    static double speed[3];
    int byte13 = packet[13] - 0x41, any = 0, motors[3];
    double force[3];
    for (int i = 0; i < 3; ++i)
    {
        unsigned value = 0;
        for (int n = 0; n < 4; ++n)
            value |= (unsigned)((packet[1 + 4 * i + n] - 0x41) & 15) << (4 * n);
        a->motors[i] = motors[i] = (short)value;
        any |= motors[i];
    }
    a->unhomed += ! (byte13 & 0x11) || (any && a->homed != 7);
    a->lights = byte13 & 14;
    forceOf (place, motors, force);
    for (int i = 0; i < 3; ++i)
    {
        speed[i] += 0.001 * (force[i] + 200.0 * (a->hand[i] - place[i]) - 15.0 * speed[i]) / 0.3;
        place[i] += 0.001 * speed[i];
        a->force[i] = force[i];
        a->position[i] = place[i];
    }
    double angle[3];
    anglesOf (place, angle);
    unsigned char out[16] = { '<' };
    for (int i = 0; i < 3; ++i)
    {
        const double counts = (angle[i] * 180.0 / M_PI - 35.0) / (.01425 / 1280.0 * 360.0 / .110);
        const unsigned value = (unsigned)(int)lround (counts);
        for (int n = 0; n < 4; ++n)
            out[1 + 4 * i + n] = (unsigned char)(0x41 + (value >> (4 * n) & 15));
    }
    out[13] = (unsigned char)(0x41 + a->buttons + (a->homed << 4)), out[14] = 0x41, out[15] = '>';
    ++a->packets;
    if (a->silent)
        return;
    const int shortened = a->shorten > 0 && a->packets % a->shorten == 0;
    if (shortened)
        out[12] = '>';
    if (write (a->master, out, shortened ? 14 : 16) < 0)
        ++a->broken;
}

static unsigned speedOf (int master)
{
    struct termios2 line;
    return ioctl (master, TCGETS2, &line) == 0 ? line.c_ospeed : 0;
}

static void* serve (void* pointer)
{
    struct falcon_apart* a = pointer;
    unsigned char held[16], in[256];
    int n = 0, loading = 0;
    while (! ends)
    {
        struct pollfd wait = { a->master, POLLIN, 0 };
        if (poll (&wait, 1, 50) <= 0)
            continue;
        const ssize_t got = read (a->master, in, sizeof in);
        if (got <= 0)
            continue;
        const unsigned speed = speedOf (a->master);
        if (a->needs_firmware && speed != 1500000)
        {
            if (speed == 9600 && got >= 3 && in[got - 1] == 0x0D)
                loading = 0, (void)! write (a->master, "\x0A\x44\x2C\x0D", 4);
            else if (speed > 9600)
            {
                a->uploaded += loading ? got : got - (in[0] == 0x41);
                loading = 1;
                (void)! write (a->master, in, (size_t)got);
            }
            continue;
        }
        if (a->needs_firmware && a->uploaded == 0)
            continue; /* no program runs on it: silence */
        a->needs_firmware = 0;
        for (ssize_t i = 0; i < got; ++i)
        {
            if (n == 0 && in[i] != '<')
            {
                ++a->broken;
                continue;
            }
            held[n++] = in[i];
            if (n == 16)
                n = 0, held[15] == '>' ? answer (a, held) : (void)(a->broken += 16);
        }
    }
    return NULL;
}

int falcon_apart_begin (struct falcon_apart* a)
{
    a->master = posix_openpt (O_RDWR | O_NOCTTY);
    if (a->master < 0 || grantpt (a->master) != 0 || unlockpt (a->master) != 0 || ptsname_r (a->master, a->port, sizeof a->port) != 0)
        return -1;
    struct termios2 line;
    ioctl (a->master, TCGETS2, &line);
    line.c_lflag = 0, line.c_iflag = 0, line.c_oflag = 0; /* raw, so that nothing is echoed before the driver has set the line itself */
    ioctl (a->master, TCSETS2, &line);
    near_end = open (a->port, O_RDWR | O_NOCTTY);
    for (int i = 0; i < 3; ++i)
        a->position[i] = place[i] = a->hand[i];
    ends = 0;
    return pthread_create (&server, NULL, serve, a) == 0 ? 0 : -1;
}

void falcon_apart_end (struct falcon_apart* a)
{
    ends = 1;
    pthread_join (server, NULL);
    close (a->master), close (near_end);
}
