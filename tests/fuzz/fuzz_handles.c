/* Any bytes at all must give handles or a pose with numbers that are finite and in range, or a
 * reason; and leak nothing. */
#include "fuzz.h"
#include "kernel/handle_set.h"

#include <math.h>

static void require_finite(size_t n, const double *numbers)
{
    for (size_t i = 0; i < n; i++)
        require(isfinite(numbers[i]) != 0);
}

static void require_below(size_t n, const uint32_t *indices, size_t limit)
{
    for (size_t i = 0; i < n; i++)
        require(indices[i] < limit);
}

static void require_reason(const problem *wrong)
{
    require(wrong->text[0] != '\0' && strpbrk(wrong->text, "\r\n") == NULL);
    require(strlen(wrong->text) < sizeof wrong->text);
}

static void try_handles(const char *text, size_t size)
{
    handle_set set;
    problem wrong = {.text = ""};
    if (!handle_set_read(&set, text, size, &wrong)) {
        require_reason(&wrong);
        require(set.dim == 0 && set.handles == NULL);
        return;
    }
    require((set.dim == 2 || set.dim == 3) && set.n_handles > 0);
    require_finite(set.n_handles * set.dim, set.handles);
    require_finite(set.n_vertices * set.dim, set.vertices);
    require_below(2 * set.n_edges, set.edges, set.n_handles);
    require_below(2 * set.n_segments, set.segments, set.n_vertices);
    for (size_t i = 0; i < set.n_lines; i++) {
        require_finite(3, set.lines[i].from);
        require_finite(3, set.lines[i].to);
        require(set.lines[i].parallel >= 0 && (size_t)set.lines[i].parallel <= i);
    }
    for (size_t i = 0; i < set.n_regions; i++) {
        require(set.regions[i].n >= 3 && set.dim == 2);
        require_finite(2 * set.regions[i].n, set.regions[i].points);
    }
    for (size_t i = 0; i < set.n_strokes; i++) {
        require(set.strokes[i].handle < set.n_handles && set.strokes[i].radius > 0);
        require_finite(set.dim, set.strokes[i].centre);
        require_finite(1, &set.strokes[i].amount);
    }
    for (size_t i = 0; i < set.n_rigid; i++)
        require(set.rigid[i].rigidity > 0 &&
                (set.rigid[i].region.n > 0 || set.rigid[i].radius > 0));
    handle_set_free(&set);
}

static void try_pose(size_t dim, const char *text, size_t size)
{
    enum { HANDLES = 2 };
    const double handles[3 * HANDLES] = {0, 1, 2, 3, 4, 5};
    problem wrong = {.text = ""};
    double *transforms = pose_read(dim, HANDLES, handles, text, size, &wrong);
    if (transforms == NULL)
        require_reason(&wrong);
    else
        require_finite(HANDLES * dim * (dim + 1), transforms);
    free(transforms);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = text_of(data, size);
    if (text == NULL)
        return 0;
    try_handles(text, size);
    try_pose(2, text, size);
    try_pose(3, text, size);
    free(text);
    return 0;
}
