/* SPDX-License-Identifier: MIT */
/* What a test and the library in drd_apart.c share: the file named by APART_DRD, mapped by both. */
#ifndef DRD_APART_H
#define DRD_APART_H

struct drd_apart
{
    /* The test sets these before the library is loaded, or while it runs. */
    int devices;        /* how many are plugged in, 1 or 2 */
    int wrist;          /* 0 none, 1 without motors, 2 with motors */
    int gripper;        /* 0 none, 1 without motor, 2 with motor */
    int left;           /* left-handed: the angle and force of the gripper are negative */
    int status_entries; /* 12 to 17, as versions of the library differ */
    int watchdog;       /* in units of 125 us; 0: the firmware is too old to have one */
    int homed;          /* has been calibrated since it was switched on */
    int serial;         /* of the first; the second's is one more */
    int busy;           /* another program has opened the first */
    int gone;           /* unplugged */
    int cause;          /* a reason why the controller takes the force away now: 1 button, 2 velocity, 6 deadman */
    int buttons;        /* bit per button */
    int stall_ms;       /* the next call that reads waits so long, once */
    int guard_us;       /* positions younger than this are told again, result 1 */
    double clock_hz;    /* above 0: time advances by 1/clock_hz with each force, and not by itself */
    double hand[3];     /* where the hand holds the tool, in the maker's axes, m */
    double frame[9];    /* of the wrist, row by row */
    double angle;       /* of the gripper, rad, as a right-handed device has it */
    double strongest;   /* N: above it the motors saturate */
    double mass;        /* kg */

    /* The library tells these. */
    double position[3];
    double force[3]; /* what the motors give now */
    double torque[3];
    double grip;
    double commanded[3]; /* the last command, whether or not the motors give it */
    int mode;            /* 0 reset, 1 idle, 2 force, 3 brake */
    int off_cause;
    long forces;      /* calls that set a force */
    long fresh;       /* positions that were new */
    long after_close; /* calls for a device that is not open */
    long outside;     /* expert calls outside the expert mode */
    long enabled;     /* how often forces were enabled */
    long calibrated;  /* how often the arm moved by motor */
    long stopped;     /* calls of dhdStop and drdStop */
    long closed;
};

#endif
