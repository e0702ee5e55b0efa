/* SPDX-License-Identifier: MIT */
/* The header must be plain C99, so this file is compiled as such. */
#include <tactus/tactus.h>

int renderInC (const char* path, double* records, size_t ticks);

int renderInC (const char* path, double* records, size_t ticks)
{
    int failed = 1;
    tactus_messages* messages = tactus_messages_create();
    tactus_graph* graph = tactus_graph_load (path, messages);
    const char* ports[] = { "motor.force" };
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    tactus_run* run;
    options.records = ports;
    options.record_count = 1;
    run = tactus_run_create (graph, &options, messages);
    if (run != NULL && tactus_run_record_count (run) == 3 && tactus_run_open (run, messages) == TACTUS_OK)
        failed = tactus_run_steps (run, ticks, NULL, records) != TACTUS_OK;
    tactus_run_free (run);
    tactus_graph_free (graph);
    tactus_messages_free (messages);
    return failed;
}
