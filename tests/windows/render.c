/* SPDX-License-Identifier: MIT */
/* render_dll.exe GRAPH TICKS: a program in C that uses libtactus.dll. It prints the names of the records, and then their bits, one line for each tick. */
#include <tactus/tactus.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int refuse (const tactus_messages* messages)
{
    for (size_t i = 0; i < tactus_messages_count (messages); ++i)
    {
        tactus_message message = TACTUS_MESSAGE;
        if (tactus_messages_get (messages, i, &message) == TACTUS_OK) fprintf (stderr, "%s [%s]\n", message.text, message.id);
    }
    return 1;
}

int main (int argc, char** argv)
{
    tactus_messages* messages = tactus_messages_create();
    tactus_graph* graph = argc == 3 ? tactus_graph_load (argv[1], messages) : NULL;
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    tactus_run* run = graph != NULL ? tactus_run_create (graph, &options, messages) : NULL;
    if (run == NULL || tactus_run_open (run, messages) != TACTUS_OK) return refuse (messages);

    const size_t ticks = (size_t)strtoul (argv[2], NULL, 10), width = tactus_run_record_count (run);
    double* records = malloc (ticks * width * sizeof *records);
    if (records == NULL || tactus_run_steps (run, ticks, NULL, records) != TACTUS_OK) return refuse (messages);
    for (size_t i = 0; i < width; ++i)
        printf ("%s%c", tactus_run_record_name (run, i), i + 1 < width ? ' ' : '\n');
    for (size_t i = 0; i < ticks * width; ++i)
    {
        uint64_t bits;
        memcpy (&bits, &records[i], sizeof bits);
        printf ("%016" PRIx64 "%c", bits, (i + 1) % width != 0 ? ' ' : '\n');
    }
    free (records);
    tactus_run_free (run);
    tactus_graph_free (graph);
    tactus_messages_free (messages);
    return 0;
}
