/* SPDX-License-Identifier: MIT */
/* A device driver of somebody else for the board of docs/devices.md, which reads and writes its hidraw file without Tactus. If its environment has
   TACTUS_TEST_HANG, `write` does not return once a force has been on the board for a while. */
#include <tactus/tactus_device.h>

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct board
{
    int file;
    _Atomic uint32_t sequence; /* of the latest reading; `write` answers it on another thread */
    unsigned pushed, hangs_after;
} board;

static const uint8_t at_rest[65] = { 0, 0x54, 1 }; /* after a report id of 0 */
static const tactus_device_bytes last = { sizeof last, at_rest, sizeof at_rest };
static const tactus_device_bytes* const last_reports[] = { &last };
static char file_name[256];

static uint32_t get32 (const uint8_t* from) { return from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24; }

static void put32 (uint8_t* to, uint32_t v)
{
    int i;
    for (i = 0; i < 4; ++i)
        to[i] = (uint8_t)(v >> (8 * i));
}

static uint32_t crc32 (const uint8_t* bytes, size_t count)
{
    uint32_t crc = 0xffffffff;
    size_t i;
    int bit;
    for (i = 0; i < count; ++i)
        for (crc ^= bytes[i], bit = 0; bit < 8; ++bit)
            crc = (crc & 1) != 0 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    return ~crc;
}

static void* open_board (const tactus_device_description* given, tactus_device_about* about, const tactus_plugin_report* report)
{
    const int file = open (given->port, O_RDWR | O_CLOEXEC);
    board* b = file >= 0 ? calloc (1, sizeof *b) : NULL;
    if (b == NULL)
    {
        report->put (report->context, strerror (errno), strlen (strerror (errno)));
        return NULL;
    }
    b->file = file;
    b->hangs_after = getenv ("TACTUS_TEST_HANG") != NULL ? 1000 : 0;
    strncpy (file_name, given->port, sizeof file_name - 1);
    about->about = "The board of docs/devices.md.";
    about->tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_FORCE;
    about->rate_hz = 1000;
    about->guard = "{\"max_force\": \"2 N\", \"max_slew\": \"500 N/s\", \"max_speed\": \"100 m/s\", \"watchdog\": \"20 ms\"}";
    about->rest_file = file_name;
    about->rest_reports = last_reports;
    about->rest_report_count = 1;
    about->device_watchdog_s = 0.02;
    about->stamps = TACTUS_DEVICE_NUMBERS;
    return b;
}

static int32_t read_board (void* device, int32_t timeout_ms, tactus_reading* to, tactus_device_stamp* stamp, const tactus_plugin_report* report)
{
    board* b = device;
    uint8_t in[65];
    int axis;
    struct pollfd wait = { b->file, POLLIN, 0 };
    (void)report;
    if (poll (&wait, 1, timeout_ms) <= 0) return TACTUS_DEVICE_NONE;
    const ssize_t got = read (b->file, in, sizeof in);
    if (got < 0) return errno == EAGAIN || errno == EINTR ? TACTUS_DEVICE_NONE : TACTUS_DEVICE_GONE;
    if (got != 64 || in[0] != 0x54 || in[1] != 1) return TACTUS_DEVICE_NONE;
    b->sequence = get32 (in + 4);
    stamp->number = b->sequence + 1ull;
    to->valid = in[2] & 1;
    for (axis = 0; axis < 3; ++axis)
        to->position[axis] = 1e-9 * (int32_t)get32 (in + 12 + 4 * axis);
    return TACTUS_DEVICE_OK;
}

static int32_t send (const board* b, const uint8_t* report) { return write (b->file, report, 65) == 65 ? TACTUS_DEVICE_OK : TACTUS_DEVICE_FAILED; }

static int32_t write_board (void* device, const tactus_effort* effort, const tactus_plugin_report* report)
{
    board* b = device;
    uint8_t out[65] = { 0, 0x54, 1, 1 };
    int axis;
    (void)report;
    put32 (out + 5, b->sequence);
    for (axis = 0; axis < 3; ++axis)
        put32 (out + 9 + 4 * axis, (uint32_t)(int32_t)lround (1e6 * effort->force[axis]));
    put32 (out + 61, crc32 (out + 1, 60));
    if (effort->force[2] != 0 && b->hangs_after > 0 && ++b->pushed > b->hangs_after)
        for (;;)
            sleep (1);
    return send (b, out);
}

static int32_t rest_board (void* device, const tactus_plugin_report* report)
{
    (void)report;
    return send (device, at_rest);
}

static void close_board (void* device)
{
    close (((board*)device)->file);
    free (device);
}

static const char* const keys[] = { "port" };
const tactus_device_driver tactus_device_entry = { sizeof (tactus_device_driver), TACTUS_DEVICE_ABI, "hidraw_board", "1.0.0", "The board of docs/devices.md.",
                                                   keys, 1, NULL, open_board, read_board, write_board, rest_board, close_board, NULL };
