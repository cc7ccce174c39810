/* A program that uses the installed library, in the common subset of C and C++. */
#include <icc/icc.h>
#include <icc/kernel.h>
#include <icc/stages.h>

#include <stdio.h>
#include <string.h>

/* Maps the centre of a square onto a square of twice the size. */
static int use_library(const char *expected_version)
{
    const double small[] = {0, 0, 1, 0, 1, 1, 0, 1};
    const double large[] = {0, 0, 2, 0, 2, 2, 0, 2};
    const double corner[] = {1, 1};
    double image[2] = {0, 0};
    icc_domain *source = NULL, *target = NULL;
    icc_map *map = NULL;
    icc_error err = ICC_INIT(icc_error);
    icc_map_options options = ICC_INIT(icc_map_options);

    if (strcmp(icc_version(), expected_version) != 0) {
        printf("version %s, expected %s\n", icc_version(), expected_version);
        return 1;
    }
    if (icc_domain_create(&source, 2, 4, small, 0, NULL, NULL, &err) != ICC_OK ||
        icc_domain_create(&target, 2, 4, large, 0, NULL, NULL, &err) != ICC_OK ||
        icc_map_create(&map, source, target, &options, NULL, &err) != ICC_OK ||
        icc_map_apply(map, 1, corner, image, NULL, NULL, NULL) != ICC_OK) {
        printf("failed: %s\n", err.message);
        return 1;
    }
    icc_map_free(map);
    icc_domain_free(target);
    icc_domain_free(source);
    printf("%g %g -> %g %g\n", corner[0], corner[1], image[0], image[1]);
    return !(image[0] > 1.999 && image[0] < 2.001 && image[1] > 1.999 && image[1] < 2.001);
}
