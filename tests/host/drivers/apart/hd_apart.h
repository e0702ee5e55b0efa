/* SPDX-License-Identifier: MIT */
/* What a test and the library in hd_apart.c share: the file named by APART_HD, mapped by both. */
#ifndef HD_APART_H
#define HD_APART_H

struct hd_apart
{
    /* The test sets these. */
    int devices;      /* "Left" and "Right", of which the first is also the default */
    int refuses_null; /* some drivers open a device only by its name */
    int motors;       /* 3 or 6 */
    int calibration;  /* 0 good, 1 needs an update, 2 needs the inkwell */
    int style;        /* 1, 2 or 4, or several */
    int lenient;      /* values may be asked for outside a frame */
    int error;        /* an error to report once: 0x200 and so on */
    int stall_ms;     /* the servo thread waits so long, once */
    int buttons;
    int fast;       /* servo ticks follow each other without waiting */
    double hand[3]; /* mm: x right, y up, z towards the person */
    double turn;    /* of the stylus about its y, rad */
    double warm;    /* of the motors, 0 to 1 */

    /* The library tells these. */
    double position[3];
    double force[3];
    double torque[3];
    int rate_hz;
    long ticks;
    long forces; /* frames that set a force */
    long empty;  /* frames that set none, which therefore gave 0 */
    long misuse; /* calls that the library refuses: frames out of order, values outside a frame, a rate that is none */
    long late;   /* callbacks after they were unscheduled, or calls after the device was disabled */
    long disabled;
    long stopped;
    long calibrated;
};

#endif
