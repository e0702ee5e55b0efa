/* SPDX-License-Identifier: MIT */
/* A loop of your own with a device of your own: loop_c dry_wood.json run.jsonl. Here, the device is a tool of 50 g that a hand holds by a spring and
   strokes to and fro. The loop turns the first control of the graph up, prints the largest force, and logs the run:
   `tactus render --replay run.jsonl` repeats it. */
#include <tactus/tactus.h>

#include <math.h>
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

/* Moves the tool for one period. */
static void move (tactus_reading* at, double* speed, const tactus_effort* effort, double time_s, double period_s)
{
    int i;
    for (i = 0; i < 3; ++i)
    {
        const double hand = i == 0 ? 0.03 * sin (6.0 * time_s) : i == 2 ? -0.001
                                                                        : 0.0;
        const double force = effort->force[i] + 600.0 * (hand - at->position[i]) - 6.0 * speed[i];
        speed[i] += period_s * force / 0.05;
        at->position[i] += period_s * speed[i];
    }
}

int main (int argc, char** argv)
{
    tactus_messages* messages = tactus_messages_create();
    tactus_graph* graph = tactus_graph_load (argc > 1 ? argv[1] : "dry_wood.json", messages);
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    tactus_device_options device = TACTUS_DEVICE_OPTIONS;
    tactus_reading reading = TACTUS_READING;
    tactus_effort effort = TACTUS_EFFORT;
    tactus_run* run;
    const char *control, *role, *ports[] = { "motor.force" };
    double speed[3] = { 0.0, 0.0, 0.0 }, samples[3 * 100], largest = 0.0, period_s;
    int k;

    options.log = argc > 2 ? argv[2] : NULL;
    device.guard = "{\"max_force\": \"6 N\", \"max_slew\": \"2000 N/s\", \"ramp\": \"100 ms\", \"watchdog\": \"20 ms\"}";
    run = tactus_run_create (graph, &options, messages);
    role = tactus_run_role (run, 0);
    if (tactus_run_pushed_device (run, role, &device, messages) != TACTUS_OK) return fail (messages);
    if (tactus_run_open (run, messages) != TACTUS_OK || tactus_run_probe (run, ports, 1, messages) != TACTUS_OK) return fail (messages);
    control = tactus_run_control_id (run, 0);
    period_s = 1.0 / tactus_run_rate (run);

    reading.valid = 1;
    for (k = 0; k < 8000; ++k)
    {
        tactus_run_push (run, role, &reading);
        if (tactus_run_tick (run) != TACTUS_OK) return fail (messages); /* tactus_run_tick_after, if your loop can be late */
        tactus_run_take (run, role, &effort);
        move (&reading, speed, &effort, k * period_s, period_s);
        if (k % 100 != 0) continue;

        /* Several times a second. This may be another thread than the one that ticks (docs/threads.md). */
        if (control != NULL && tactus_run_turn (run, control, k / 8000.0, messages) != TACTUS_OK) return fail (messages);
        if (tactus_run_attend (run, messages) != TACTUS_OK) return fail (messages);
        for (size_t i = 0, got = tactus_run_collect_probes (run, NULL, samples, 100); i < got; ++i)
            largest = fmax (largest, hypot (hypot (samples[3 * i], samples[3 * i + 1]), samples[3 * i + 2]));
    }
    printf ("largest force %.3f N, %lu samples lost\n", largest, (unsigned long)tactus_run_lost_probes (run));

    if (tactus_run_stop (run) != TACTUS_OK && tactus_run_attend (run, messages) != TACTUS_OK) return fail (messages);
    tactus_run_free (run);
    tactus_graph_free (graph);
    tactus_messages_free (messages);
    return 0;
}
