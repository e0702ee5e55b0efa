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

const char* playInC (const char* path, const char* log);

/* A loop with a device of its own that turns a control and a vector, probes, and logs. */
static const char* play (tactus_graph* graph, tactus_run* run, tactus_messages* messages)
{
    const double up[] = { 0.0, 0.0, 2.0 };
    const char* ports[] = { "motor.force", "drag.colour" };
    tactus_control control = TACTUS_CONTROL;
    tactus_reading reading = TACTUS_READING;
    tactus_effort effort = TACTUS_EFFORT;
    uint64_t ticks[100];
    double values[4], rows[400];
    int k;

    if (tactus_graph_control_count (graph) != 1 || tactus_graph_get_control (graph, "roughness", &control, messages) != TACTUS_OK) return "graph control";
    if (tactus_graph_set_control (graph, control.id, 0.9, messages) != TACTUS_OK || tactus_graph_undo (graph) != 1) return "set control";
    if (tactus_run_pushed_device (run, "stylus", NULL, messages) != TACTUS_OK || tactus_run_open (run, messages) != TACTUS_OK) return "open";
    if (tactus_run_turn (run, tactus_run_control_id (run, 0), 0.9, messages) != TACTUS_OK) return "turn";
    if (tactus_run_get_control (run, "roughness", &control, messages) != TACTUS_OK || control.value < 0.9) return "run control";
    if (tactus_run_set_vector (run, "board.normal", up, 3, messages) != TACTUS_OK) return "vector";
    if (tactus_run_set (run, "board.normal.x", 0.1, messages) != TACTUS_OK) return "component";
    if (tactus_run_set_value (run, "board.stiffness", "1 N/mm", messages) != TACTUS_OK) return "value with a unit";
    if (tactus_run_set_value (run, "board.stiffness", "soft", NULL) != TACTUS_FAILED) return "value without sense";
    if (tactus_run_probe (run, ports, 2, messages) != TACTUS_FAILED) return "a port that is not there";
    if (tactus_run_probe (run, ports, 1, messages) != TACTUS_OK || tactus_run_probe_count (run) != 3) return "probe";

    reading.valid = 1;
    reading.position[2] = -0.001;
    for (k = 0; k < 100; ++k)
        if (tactus_run_push (run, "stylus", &reading) != TACTUS_OK || tactus_run_tick (run) != TACTUS_OK) return "tick";
    if (tactus_run_take (run, "stylus", &effort) != TACTUS_OK || ! (effort.force[2] > 0.5)) return "effort";
    if (tactus_run_probed (run, values, 4) != TACTUS_OK || ! (values[2] > 0.5)) return "probed";
    if (tactus_run_collect_probes (run, ticks, rows, 100) != 25 || ticks[24] != 96) return "the queue, with every fourth tick";
    if (tactus_run_lost_probes (run) != 0) return "lost";
    reading.size = 0;
    if (tactus_run_push (run, "stylus", &reading) != TACTUS_MISUSE || tactus_last_misuse()[0] == '\0') return "a struct without its size";
    return tactus_run_stop (run) == TACTUS_OK ? NULL : "stop";
}

const char* playInC (const char* path, const char* log)
{
    const char* wrong = "create";
    tactus_messages* messages = tactus_messages_create();
    tactus_graph* graph = tactus_graph_load (path, messages);
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    tactus_run* run;
    options.log = log;
    run = tactus_run_create (graph, &options, messages);
    if (run != NULL) wrong = play (graph, run, messages);
    tactus_run_free (run);
    tactus_graph_free (graph);
    tactus_messages_free (messages);
    return wrong;
}
