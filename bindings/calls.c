/* What calls cost in C, for the other languages to compare with: an empty one, and one that maps
 * one point.
 *
 *     calls
 *
 * prints nanoseconds of both: the least of many means, since whatever else runs makes them longer,
 * never shorter. */
#include <icc/icc.h>

#include <stdio.h>
#include <time.h>

enum { CALLS = 20000, MEANS = 50 };

static double nanoseconds(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}

/* Sums what the calls return, so that they cannot be left out. */
static double empty(const icc_map *map, double *sum)
{
    (void)map;
    const double start = nanoseconds();
    for (int i = 0; i < CALLS; ++i)
        *sum += icc_version_number();
    return nanoseconds() - start;
}

static double one_point(const icc_map *map, double *sum)
{
    const double point[] = {1, 1};
    double image[2];
    const double start = nanoseconds();
    for (int i = 0; i < CALLS; ++i)
        *sum += icc_map_apply(map, 1, point, image, NULL, NULL, NULL);
    const double time = nanoseconds() - start;
    *sum += image[0];
    return time;
}

static double least(double (*calls)(const icc_map *, double *), const icc_map *map, double *sum)
{
    double best = calls(map, sum);
    for (int i = 1; i < MEANS; ++i) {
        const double time = calls(map, sum);
        best = time < best ? time : best;
    }
    return best / CALLS;
}

int main(void)
{
    const double before[] = {0, 0, 4, 0, 4, 3, 0, 3}, after[] = {0, 0, 4, 1, 4, 4, 0, 3};
    icc_domain *source = NULL, *target = NULL;
    icc_map *map = NULL;
    double sum = 0;
    const int made = icc_domain_create(&source, 2, 4, before, 0, NULL, NULL, NULL) == ICC_OK &&
                     icc_domain_create(&target, 2, 4, after, 0, NULL, NULL, NULL) == ICC_OK &&
                     icc_map_create(&map, source, target, NULL, NULL, NULL) == ICC_OK;
    if (made)
        printf("%.1f %.1f\n", least(empty, map, &sum), least(one_point, map, &sum));
    icc_map_free(map);
    icc_domain_free(target);
    icc_domain_free(source);
    return made && sum > 0 ? 0 : 1;
}
