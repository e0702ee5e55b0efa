/* SPDX-License-Identifier: MIT */
/* A second Falcon on a pty, written from the public facts and from nothing else: not from our driver, and not from the fake that is handed out. */
#ifndef FALCON_APART_H
#define FALCON_APART_H

#ifdef __cplusplus
extern "C"
{
#endif

    struct falcon_apart
    {
        /* The test sets these. */
        volatile int needs_firmware; /* until an image has been echoed */
        volatile int homed;          /* byte 13 tells three bits of it: top 1, right 2, left 4 */
        volatile int buttons;        /* plus 1, forward 2, center 4, minus 8 */
        volatile int shorten;        /* every so many answers, one has 14 bytes and a stray '>' */
        volatile int silent;         /* answers nothing */
        double hand[3];              /* m: x right, y up, z away from the base */

        /* The Falcon tells these. */
        double position[3];
        double force[3]; /* what the motors give, from the torques by the transposed derivative */
        int motors[3];   /* the last command */
        volatile long packets;
        volatile long broken;   /* bytes that belong to no packet */
        volatile long unhomed;  /* packets without a homing bit, or with motors on before the arm is homed */
        volatile long uploaded; /* bytes of an image */
        volatile int lights;    /* of the last packet: green 2, blue 4, red 8 */
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
