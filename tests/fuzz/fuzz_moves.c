/* Any bytes at all must give moves of vertices that exist, or a reason. */
#include "fit/moves_file.h"
#include "fuzz.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const size_t n_vertices = 100;
    moves m;
    problem wrong = {.text = ""};
    char *text = text_of(data, size);
    if (text == NULL)
        return 0;
    bool good = moves_decode(&m, text, size, n_vertices, &wrong);
    require(good || (wrong.text[0] != '\0' && strlen(wrong.text) < sizeof wrong.text));
    for (size_t i = 0; i < m.n && good; i++) {
        require(m.vertices[i] < n_vertices && m.lines[i] > 0 && m.lines[i] <= size + 1);
        require(isnan(m.to[2 * i]) == isnan(m.to[2 * i + 1]) && !isinf(m.to[2 * i]));
    }
    for (size_t i = 0; i < 2 * m.points.n && good; i++)
        require(isfinite(m.points.from[i]) && isfinite(m.points.to[i]));
    moves_free(&m);
    free(text);
    return 0;
}
