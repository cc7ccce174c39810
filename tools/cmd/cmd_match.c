/* libicc match: gives two outlines, or two surfaces, that do not correspond common vertices. */
#include "cmd/commands.h"

#include "job/cage_file.h"
#include "job/job.h"
#include "job/match_cages.h"
#include "job/output_name.h"

#include <math.h>
#include <string.h>

static bool is_standard(const char *name)
{
    return name != NULL && strcmp(name, "-") == 0;
}

/* Both may be written to the source's file. */
static int check_outputs(const args *a)
{
    if (is_standard(a->output) && is_standard(a->target_output))
        return misused(a->command, "source and target cannot both go to standard output");
    if (a->output == NULL && a->target_output != NULL)
        return misused(a->command, "--output FILE is missing, for the source");
    if (a->output == NULL || a->target_output != NULL)
        return DONE;
    return output_is_json(a->output)
               ? DONE
               : misused(a->command,
                         "--target-output FILE is missing; only GeoJSON (-o OUT.geojson) has both "
                         "in one file");
}

/* Text has no place for more than one ring. */
static int check_text(const job *j)
{
    const char *names[] = {j->args->output, j->args->target_output};
    for (size_t i = 0; i < 2; i++)
        if (names[i] != NULL && j->cages[0].n_features > 0 && !output_is_json(names[i]))
            return failed(names[i], 0,
                          "text holds one outline and no holes, lines or points, so nothing is "
                          "written; give a name that ends in .geojson");
    return DONE;
}

static int write_cages(const job *j)
{
    const args *a = j->args;
    const cage *source = &j->cages[0], *target = &j->cages[1];
    if (a->output == NULL)
        return DONE;
    if (a->target_output == NULL)
        return cages_write(a->output, source, target);
    int result = cages_write(a->output, source, NULL);
    return result == DONE ? cages_write(a->target_output, NULL, target) : result;
}

static void print_surfaces(const icc_match_info *info)
{
    printf("common      %zu vertices, of %zu before they were made fewer\n", info->n_vertices,
           info->n_overlay);
    printf("energy      %.6g (4: an isometry)\n", info->energy);
    printf("off         %.3g of the diagonal\n", info->off);
    printf("angles      %.3g degrees or more\n", info->least_angle);
    printf("slopes      %.6g to %.6g, a triangle's share of the target's area over the source's\n",
           info->least_slope, info->most_slope);
}

static void print(const icc_match_info *info)
{
    if (info->dim == 3) {
        print_surfaces(info);
        return;
    }
    printf("common      %zu vertices; %zu of them are of both outlines\n", info->n_vertices,
           info->n_joined);
    if (isfinite(info->cost))
        printf("cost        %.6g\n", info->cost);
    else
        puts("cost        none: paired by arc length");
    if (isfinite(info->second))
        printf("second      %.6g, of the best pairing elsewhere\n", info->second);
    if (isfinite(info->sure))
        printf("sure        %.6g (1: as good elsewhere)\n", info->sure);
    if (isfinite(info->cost))
        printf("turned      %.6g degrees\n", info->turn);
    if (info->mirrored)
        puts("mirrored    the mirror image fits better; a map cannot mirror");
    printf("slopes      %.6g to %.6g, an edge's share of the target's length over the source's\n",
           info->least_slope, info->most_slope);
}

static int tell(const job *j)
{
    const args *a = j->args;
    report r;
    if (a->json && (!report_open(&r, j) || !report_close(&r)))
        return FAILED;
    if (!a->json && !is_standard(a->output) && !is_standard(a->target_output))
        print(&j->matched);
    match_note(j);
    return DONE;
}

int run_match(const args *a)
{
    job j;
    int result = check_outputs(a);
    if (result != DONE)
        return result;
    job_start(&j, a);
    result = job_read_cages(&j);
    progress_end(&j.bar);
    if (result == DONE)
        result = check_text(&j);
    if (result == DONE)
        result = write_cages(&j);
    if (result == DONE)
        result = tell(&j);
    job_end(&j);
    return result;
}
