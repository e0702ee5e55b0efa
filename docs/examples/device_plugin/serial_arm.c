/* SPDX-License-Identifier: MIT */
/* A driver of an arm at a serial port. A thousand times a second, its board sends a line with a count and its position in nm, such as "17 1500 -200 80",
 * and takes a line with a force in uN, such as "250000 0 -90000". It releases the motors after 20 ms without a line, and ignores any other line. */
#define _GNU_SOURCE
#include <tactus/tactus_device.h>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

typedef struct arm
{
    int port;
    double empty_at; /* when nothing waited to be sent, in s */
    size_t length;   /* of what has come */
    char text[4096];
} arm;

static const char no_force[] = "\n0 0 0\n"; /* the first line break ends what may have been left unfinished */
static const tactus_device_bytes last = { sizeof last, (const uint8_t*)no_force, sizeof no_force - 1 };
static const tactus_device_bytes* const last_reports[] = { &last };

static double now_s (void)
{
    struct timespec now;
    clock_gettime (CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int32_t fail (const tactus_plugin_report* report, const char* why)
{
    report->put (report->context, why, strlen (why));
    return TACTUS_DEVICE_FAILED;
}

static void* open_arm (const tactus_device_description* given, tactus_device_about* about, const tactus_plugin_report* report)
{
    struct termios how = { 0 };
    const int port = open (given->port, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    const int is_tty = port >= 0 && tcgetattr (port, &how) == 0;
    cfmakeraw (&how);
    cfsetspeed (&how, B921600);
    how.c_cflag = (how.c_cflag | CLOCAL | CREAD) & ~(tcflag_t)(CRTSCTS | CSTOPB);
    how.c_iflag &= ~(tcflag_t)IXOFF;
    arm* a = is_tty && tcsetattr (port, TCSANOW, &how) == 0 && tcflush (port, TCIOFLUSH) == 0 ? calloc (1, sizeof *a) : NULL;
    if (a == NULL)
    {
        fail (report, strerror (errno));
        if (port >= 0) close (port);
        return NULL;
    }
    a->port = port;
    a->text[a->length++] = '?'; /* the first line may lack its beginning, so it must not count */
    about->about = "An arm at a serial port.";
    about->tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_FORCE;
    about->rate_hz = 1000;
    about->guard = "{\"max_force\": \"3 N\", \"max_slew\": \"500 N/s\", \"max_speed\": \"2 m/s\", \"watchdog\": \"20 ms\"}";
    about->rest_file = given->port;
    about->rest_reports = last_reports, about->rest_report_count = 1;
    about->device_watchdog_s = 0.02;
    about->stamps = TACTUS_DEVICE_NUMBERS;
    return a;
}

static int32_t read_arm (void* device, int32_t timeout_ms, tactus_reading* to, tactus_device_stamp* stamp, const tactus_plugin_report* report)
{
    arm* a = device;
    const double until = now_s() + 1e-3 * timeout_ms;
    for (;;)
    {
        unsigned long long count;
        double x, y, z;
        char* const end = memchr (a->text, '\n', a->length); /* of the oldest line */
        if (end != NULL)
        {
            *end = 0;
            const int is_reading = sscanf (a->text, "%llu %lf %lf %lf", &count, &x, &y, &z) == 4;
            a->length -= (size_t)(end + 1 - a->text);
            memmove (a->text, end + 1, a->length);
            if (! is_reading) continue;
            stamp->number = count, to->valid = 1;
            to->position[0] = 1e-9 * x, to->position[1] = 1e-9 * y, to->position[2] = 1e-9 * z;
            return TACTUS_DEVICE_OK;
        }
        if (a->length == sizeof a->text) a->length = 0; /* no line is that long */
        const double left = until - now_s();
        struct pollfd wait = { a->port, POLLIN, 0 };
        if (left < 0 || poll (&wait, 1, (int)(1e3 * left) + 1) <= 0) return TACTUS_DEVICE_NONE;
        const ssize_t got = read (a->port, a->text + a->length, sizeof a->text - a->length);
        if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) return TACTUS_DEVICE_GONE;
        if (got > 0) a->length += (size_t)got;
    }
}

static int32_t send_line (arm* a, const char* line, const tactus_plugin_report* report)
{
    const ssize_t sent = write (a->port, line, strlen (line));
    if (sent == (ssize_t)strlen (line)) return TACTUS_DEVICE_OK;
    return fail (report, sent < 0 ? strerror (errno) : "the port has taken only a part of a line");
}

static int32_t write_arm (void* device, const tactus_effort* effort, const tactus_plugin_report* report)
{
    arm* a = device;
    char line[80];
    int waiting = 0;
    if (ioctl (a->port, TIOCOUTQ, &waiting) != 0 || waiting == 0) a->empty_at = now_s();
    if (now_s() - a->empty_at > 0.02) return fail (report, "what was written 20 ms ago has not been sent");
    if (waiting > 0) return TACTUS_DEVICE_OK; /* lines that queue up are a delay: this one is left out */
    snprintf (line, sizeof line, "\n%.0f %.0f %.0f\n", 1e6 * effort->force[0], 1e6 * effort->force[1], 1e6 * effort->force[2]);
    return send_line (a, line, report);
}

static int32_t rest_arm (void* device, const tactus_plugin_report* report)
{
    arm* a = device;
    tcflush (a->port, TCOFLUSH);
    a->empty_at = now_s();
    return send_line (a, no_force, report);
}

static void close_arm (void* device) { close (((arm*)device)->port), free (device); }

static const char* const keys[] = { "port" };
const tactus_device_driver tactus_device_entry = { sizeof (tactus_device_driver), TACTUS_DEVICE_ABI, "serial_arm", "1.0.0", "An arm at a serial port.",
                                                   keys, 1, NULL, open_arm, read_arm, write_arm, rest_arm, close_arm, NULL };
