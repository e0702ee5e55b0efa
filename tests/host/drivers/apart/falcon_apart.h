/* SPDX-License-Identifier: MIT */
/* A second Falcon on a pty, written from the public facts and from nothing else: not from our driver, and not from the fake that is handed out. */
#ifndef FALCON_APART_H
#define FALCON_APART_H

/* The thread of the Falcon and that of the test use the same members. The two languages spell that differently, and mean the same. */
#ifdef __cplusplus
#include <atomic>
typedef std::atomic<int> shared_int;
typedef std::atomic<long> shared_long;
typedef std::atomic<double> shared_double;
extern "C"
{
#else
typedef _Atomic int shared_int;
typedef _Atomic long shared_long;
typedef _Atomic double shared_double;
#endif

    struct falcon_apart
    {
        /* The test sets these. */
        shared_int needs_firmware; /* until an image has been echoed */
        shared_int homed;          /* byte 13 tells three bits of it: top 1, right 2, left 4 */
        shared_int buttons;        /* plus 1, forward 2, center 4, minus 8 */
        shared_int shorten;        /* every so many answers, one has 14 bytes and a stray '>' */
        shared_int silent;         /* answers nothing */
        shared_double hand[3];     /* m: x right, y up, z away from the base */

        /* The Falcon tells these. */
        shared_double position[3];
        shared_double force[3]; /* what the motors give, from the torques by the transposed derivative */
        shared_int motors[3];   /* the last command */
        shared_long packets;
        shared_long broken;   /* bytes that belong to no packet */
        shared_long unhomed;  /* packets without a homing bit, or with motors on before the arm is homed */
        shared_long uploaded; /* bytes of an image */
        shared_int lights;    /* of the last packet: green 2, blue 4, red 8 */

        /* These stay as they are from the beginning on. */
        char port[64];
        int master;
    };

    /* Begins to answer in a thread of its own; returns 0, or -1. */
    int falcon_apart_begin (struct falcon_apart* falcon);
    /* Unplugs it: the port is closed and the thread ends. */
    void falcon_apart_end (struct falcon_apart* falcon);

#ifdef __cplusplus
}
#endif

#endif
