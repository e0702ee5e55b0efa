/* SPDX-License-Identifier: MIT */
/* Renders a graph from C, and supplies its pictures: for skin.png, the pixels of skin.pgm, a format that needs no decoder. */
#include <tactus/tactus.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static tactus_asset_answer readPicture (void* context, tactus_asset_kind kind, const char* path, tactus_asset* asset)
{
    double** pixels = context;
    const char* dot = strrchr (path, '.');
    char name[1024];
    unsigned columns = 0, rows = 0;
    size_t i;
    FILE* file;
    if (kind != TACTUS_ASSET_IMAGE) return TACTUS_ASSET_FROM_FILE; /* the library reads tables and meshes */
    snprintf (name, sizeof name, "%.*s.pgm", (int)(dot != NULL ? dot - path : (long)strlen (path)), path);
    asset->problem = "there is no such file with 8 bits per pixel: save the picture as .pgm next to it";
    file = fopen (name, "rb");
    if (file == NULL) return TACTUS_ASSET_REFUSED;
    if (fscanf (file, "P5 %u %u 255%*c", &columns, &rows) == 2 && columns > 0 && columns < 10000 && rows > 0 && rows < 10000)
    {
        *pixels = realloc (*pixels, (size_t)columns * rows * sizeof (double));
        for (i = 0; i < (size_t)columns * rows; ++i)
            (*pixels)[i] = fgetc (file) / 255.0;
        asset->columns = columns;
        asset->rows = rows;
        asset->values = *pixels;
    }
    fclose (file);
    return asset->values != NULL ? TACTUS_ASSET_SUPPLIED : TACTUS_ASSET_REFUSED;
}

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
    tactus_graph* graph = tactus_graph_load (argc > 1 ? argv[1] : "pebbled_leather.json", messages);
    const double seconds = argc > 2 ? atof (argv[2]) : 1.0;
    double *pixels = NULL, *values;
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    tactus_run* run;
    size_t width, k, i;
    options.assets = readPicture;
    options.asset_context = &pixels; /* also used by tactus_run_edit */
    run = tactus_run_create (graph, &options, messages);
    if (tactus_run_open (run, messages) != TACTUS_OK) return fail (messages);

    width = tactus_run_record_count (run);
    values = malloc (width * sizeof (double));
    printf ("t");
    for (i = 0; i < width; ++i)
        printf (",%s", tactus_run_record_name (run, i));
    for (k = 0; (double)k < seconds * tactus_run_rate (run); ++k)
    {
        tactus_run_tick (run);
        tactus_run_get_records (run, values);
        printf ("\n%.17g", (double)k / tactus_run_rate (run));
        for (i = 0; i < width; ++i)
            printf (",%.17g", values[i]);
    }
    printf ("\n");

    tactus_run_free (run);
    tactus_graph_free (graph);
    tactus_messages_free (messages);
    free (values);
    free (pixels);
    return 0;
}
