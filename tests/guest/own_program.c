/* SPDX-License-Identifier: MIT */
/* own_program GRAPH WHAT: a program of somebody else that plays a graph on the board through libtactus_live, and then does something that a program
   should not do. */
#include <tactus/tactus_live.h>

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static tactus_session* session;

static void print (tactus_messages* messages)
{
    tactus_message m = TACTUS_MESSAGE;
    size_t i;
    for (i = 0; tactus_messages_get (messages, i, &m) == TACTUS_OK; ++i)
        fprintf (stderr, "%s %s: %s\n", m.id, m.where, m.text);
    tactus_messages_clear (messages);
}

/* A function of the program that never returns. */
static void hang (void)
{
    for (;;)
        sleep (1);
}

/* A handler of the program for a fault. The library's own handler must call it. */
static void onFault (int number)
{
    (void)number;
    if (write (2, "the handler of the program ran\n", 31) < 0) _exit (8);
    _exit (7);
}

static void* stopLater (void* unused)
{
    (void)unused;
    sleep (1);
    fprintf (stderr, "emergency stop: %d\n", tactus_session_emergency_stop (session));
    return NULL;
}

static tactus_session* open (const char* graph_file, const char* device, tactus_messages* messages)
{
    tactus_session_options options = TACTUS_SESSION_OPTIONS;
    tactus_graph* graph = tactus_graph_load (graph_file, messages);
    tactus_session* opened;
    options.devices = &device;
    options.device_count = 1;
    options.session = "off";
    opened = tactus_session_open (graph, &options, messages);
    tactus_graph_free (graph);
    if (opened != NULL) tactus_session_start (opened, messages);
    print (messages);
    return opened;
}

int main (int argc, char** argv)
{
    const char* what = argc > 2 ? argv[2] : "play";
    tactus_messages* messages = tactus_messages_create();
    tactus_status status = TACTUS_STATUS;
    tactus_session* other = NULL;
    pthread_t thread;
    int i;

    signal (SIGSEGV, onFault);
    session = open (argv[1], "stylus=hid:tactus_board", messages);
    if (session == NULL) return 1;
    if (strcmp (what, "two") == 0) other = open (argv[1], "stylus=gesture:circle", messages);
    if (strcmp (what, "fork") == 0 && fork() == 0)
    {
        sleep (600); /* the child outlives its parent, with copies of all that it had open */
        return 0;
    }

    for (i = 0; i < 6000 && status.force == 0.0; ++i)
    {
        usleep (10000);
        tactus_session_status (session, &status);
    }
    if (strcmp (what, "fault") == 0)
    {
        usleep (300000);
        raise (SIGSEGV);
    }
    if (strcmp (what, "abort") == 0)
    {
        usleep (300000);
        abort();
    }
    if (strcmp (what, "hang") == 0)
    {
        pthread_create (&thread, NULL, stopLater, NULL);
        hang();
    }
    for (;;)
    {
        usleep (50000);
        if (tactus_session_events (session, messages) > 0) print (messages);
        tactus_session_status (session, &status);
        if (strcmp (what, "close") == 0 && status.ticks > 1000) break;
    }
    tactus_session_close (other);
    tactus_session_close (session);
    signal (SIGSEGV, SIG_DFL);
    tactus_messages_free (messages);
    return 0;
}
