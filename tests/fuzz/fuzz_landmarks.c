/* Any bytes at all must give landmarks of finite numbers, or a reason: rows, and the files of
 * control points. */
#include "fuzz.h"
#include "job/landmark_file.h"

#include <math.h>

static void try_landmarks(const char *text, size_t size, size_t dim)
{
    table t = {0};
    problem wrong = {.text = ""};
    if (landmarks_decode(&t, text, size, dim, &wrong)) {
        require(t.n == 0 || t.columns == 2 * dim);
        for (size_t i = 0; i < t.n * t.columns; i++)
            require(isfinite(t.values[i]));
        for (size_t i = 0; i < t.n; i++)
            require(t.lines[i] > 0 && t.lines[i] <= size + 1);
    } else {
        require(wrong.text[0] != '\0' && strlen(wrong.text) < sizeof wrong.text);
    }
    table_free(&t);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = text_of(data, size);
    if (text == NULL)
        return 0;
    try_landmarks(text, size, 2);
    try_landmarks(text, size, 3);
    free(text);
    return 0;
}
