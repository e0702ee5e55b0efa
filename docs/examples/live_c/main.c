/* SPDX-License-Identifier: MIT */
/* Plays a graph on a device from C: live_c dry_wood stylus=hid:auto 10. Ctrl-C ends it, and so does anything else: a guardian process brings the
   device to rest. */
#include <tactus/tactus_live.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static volatile sig_atomic_t ends = 0;

static void end (int number)
{
    (void)number;
    ends = 1;
}

static void print (tactus_messages* messages)
{
    tactus_message m = TACTUS_MESSAGE;
    size_t i;
    for (i = 0; tactus_messages_get (messages, i, &m) == TACTUS_OK; ++i)
        fprintf (stderr, "%s: %s: %s; %s [%s]\n", m.is_error ? "error" : "warning", m.where, m.text, m.remedy, m.id);
    tactus_messages_clear (messages);
}

int main (int argc, char** argv)
{
    tactus_messages* messages = tactus_messages_create();
    char* file = tactus_graph_file (argc > 1 ? argv[1] : "dry_wood");
    tactus_graph* graph = tactus_graph_load (file, messages);
    tactus_session_options options = TACTUS_SESSION_OPTIONS;
    tactus_session* session;
    tactus_status status = TACTUS_STATUS;
    const char* devices[1];
    const struct timespec pause = { 0, 50000000 };
    int failed;

    devices[0] = argc > 2 ? argv[2] : "stylus=gesture:stroke";
    options.devices = devices;
    options.device_count = 1;
    options.duration_s = argc > 3 ? atof (argv[3]) : 2.0;
    session = tactus_session_open (graph, &options, messages);
    failed = session == NULL || tactus_session_start (session, messages) != TACTUS_OK;
    print (messages);

    signal (SIGINT, end);
    while (! failed && ! ends && status.phase != TACTUS_OVER)
    {
        nanosleep (&pause, NULL);
        if (tactus_session_events (session, messages) > 0) print (messages);
        tactus_session_status (session, &status);
    }
    if (! failed) printf ("%lu ticks, peak force %.3f N\n", (unsigned long)status.ticks, status.peak_force);

    tactus_session_close (session); /* all forces go to zero first */
    tactus_graph_free (graph);
    tactus_text_free (file);
    tactus_messages_free (messages);
    return failed;
}
