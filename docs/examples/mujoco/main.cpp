// SPDX-License-Identifier: MIT
// A peg is stroked over a board until it drops into a hole: peg_in_hole peg.xml dry_wood.json. MuJoCo moves the peg at 1 kHz and keeps it between the walls
// of the hole; the graph renders the wood, at 4 kHz. Its last line says how deep the peg is, and how hard the wall holds it.
#include <tactus/tactus.h>

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{
constexpr double clearance = 1e-3, depth = 8e-3;   // of the hole, which the peg fits into; m

int fail (tactus_messages* messages)
{
    tactus_message m = TACTUS_MESSAGE;
    for (size_t i = 0; tactus_messages_get (messages, i, &m) == TACTUS_OK; ++i)
        std::fprintf (stderr, "%s: %s; %s [%s]\n", m.where, m.text, m.remedy, m.id);
    return 1;
}

/// The height of the peg's tip over the wood below it. The wood does not reach into the hole, up to its floor.
double heightOver (const double* tip)
{
    const bool is_over_hole = std::abs (tip[0]) < clearance && std::abs (tip[1]) < clearance;
    const bool is_in_hole = tip[2] < -1e-3;
    return is_over_hole || is_in_hole ? std::min (tip[2] + depth, 0.2e-3) : tip[2];
}

/// The hand presses with 0.8 N, and after half a second pulls the peg along x, as a spring does.
void pull (double time, const double* at, const double* speed, double* force)
{
    const double x = -0.015 + 0.02 * std::clamp (time - 0.5, 0.0, 1.5);
    force[0] = 200.0 * (x - at[0]) - 2.0 * speed[0];
    force[1] = -200.0 * at[1] - 2.0 * speed[1];
    force[2] = -0.8 - 2.0 * speed[2];
}

/// The sum of what the walls push along x, in N.
double wallForce (const mjModel* model, const mjData* data)
{
    double sum = 0.0;
    for (int i = 0; i < data->ncon; ++i)
    {
        mjtNum local[6];
        mj_contactForce (model, data, i, local);
        sum += std::abs (local[0] * data->contact[i].frame[0]);
    }
    return sum;
}
}   // namespace

int main (int argc, char** argv)
{
    char why[500] = "";
    mjModel* model = mj_loadXML (argc > 1 ? argv[1] : "peg.xml", nullptr, why, sizeof why);
    if (model == nullptr)
    {
        std::fprintf (stderr, "%s\n", why);
        return 1;
    }
    mjData* data = mj_makeData (model);

    tactus_messages* messages = tactus_messages_create();
    tactus_graph* graph = tactus_graph_load (argc > 2 ? argv[2] : "dry_wood.json", messages);
    const tactus_run_options options = TACTUS_RUN_OPTIONS;
    tactus_run* run = tactus_run_create (graph, &options, messages);
    tactus_device_options tool = TACTUS_DEVICE_OPTIONS;
    tool.between = TACTUS_LINEAR;   // no delay with this integrator: docs/steps.md
    tool.step_effort = TACTUS_LAST_TICK;
    tool.simulated = 1;
    const char* role = tactus_run_role (run, 0);
    if (tactus_run_pushed_device (run, role, &tool, messages) != TACTUS_OK || tactus_run_open (run, messages) != TACTUS_OK) return fail (messages);

    tactus_reading reading = TACTUS_READING;
    tactus_effort wood = TACTUS_EFFORT;
    tactus_guard guard = TACTUS_GUARD;
    reading.valid = 1;
    data->qpos[0] = -0.015;
    data->qpos[2] = 0.5e-3;
    for (int k = 0; k < 3000; ++k)
    {
        std::copy_n (data->qpos, 3, reading.position);
        reading.position[2] = heightOver (data->qpos);
        tactus_run_push (run, role, &reading);
        tactus_run_step_for (run, model->opt.timestep);
        tactus_run_take (run, role, &wood);
        if (tactus_run_guard (run, role, &guard) == TACTUS_OK && guard.is_latched != 0)
        {
            std::fprintf (stderr, "the guard has stopped the force: %s\n", tactus_stop_name (guard.stop));
            return 1;
        }

        pull (data->time, data->qpos, data->qvel, data->qfrc_applied);
        for (int i = 0; i < 3; ++i)
            data->qfrc_applied[i] += wood.force[i];
        mj_step (model, data);
        if (k % 250 == 249)
            std::printf ("%4.2f s  x %6.2f mm  z %6.2f mm  wood %6.3f %6.3f %6.3f N  walls %5.2f N\n", data->time, 1e3 * data->qpos[0], 1e3 * data->qpos[2],
                         wood.force[0], wood.force[1], wood.force[2], wallForce (model, data));
    }
    const bool is_in = data->qpos[2] < -0.9 * depth && std::abs (data->qpos[0]) < 2.0 * clearance;
    std::printf ("%s, %.2f mm deep; the wall holds it with %.2f N\n", is_in ? "in the hole" : "not in the hole", -1e3 * data->qpos[2], wallForce (model, data));

    tactus_run_free (run);
    tactus_graph_free (graph);
    tactus_messages_free (messages);
    mj_deleteData (data);
    mj_deleteModel (model);
    return is_in ? 0 : 1;
}
