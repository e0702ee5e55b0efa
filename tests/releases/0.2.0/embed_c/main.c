/* SPDX-License-Identifier: MIT */
/* Renders a graph from C, and prints what it records as CSV. */
#include <tactus/tactus.h>

#include <stdio.h>
#include <stdlib.h>

static int fail (tactus_messages* messages)
{
    tactus_message m = TACTUS_MESSAGE;
    size_t i;
    for (i = 0; tactus_messages_get (messages, i, &m) == TACTUS_OK; ++i)
        fprintf (stderr, "%s: %s; %s [%s]\n", m.where, m.text, m.remedy, m.id);
    return 1;
}

int main (int argc, char** argv)
{
    tactus_messages* messages = tactus_messages_create();
    tactus_graph* graph = tactus_graph_load (argc > 1 ? argv[1] : "dry_wood.json", messages);
    tactus_run* run = tactus_run_create (graph, NULL, messages);
    const size_t ticks = argc > 2 ? (size_t)atol (argv[2]) : 4000, width = tactus_run_record_count (run);
    size_t k, i;
    double* values;
    if (tactus_run_open (run, messages) != TACTUS_OK) return fail (messages);

    printf ("t");
    for (i = 0; i < width; ++i)
        printf (",%s", tactus_run_record_name (run, i));
    values = malloc (width * sizeof (double));
    for (k = 0; k < ticks; ++k)
    {
        tactus_run_tick (run);
        tactus_run_get_records (run, values);
        printf ("\n%.17g", (double)k / tactus_run_rate (run));
        for (i = 0; i < width; ++i)
            printf (",%.17g", values[i]);
    }
    printf ("\n");

    free (values);
    tactus_run_free (run);
    tactus_graph_free (graph);
    tactus_messages_free (messages);
    return 0;
}
