/* Any bytes at all must give a cage of finite-sized arrays or a reason, and leak nothing. */
#include "cage/cage_read.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* assert() is off in release builds. */
static void require(bool fact)
{
    if (!fact)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    if (text == NULL)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    for (int role = CAGE_SOURCE; role <= CAGE_TARGET; role++) {
        cage c;
        problem wrong = {.text = ""};
        bool good = cage_read(&c, (cage_role)role, 2, text, size, &wrong);
        require(good ? c.cells != NULL || c.n > c.dim : c.dim == 0 && c.points == NULL);
        require(good || (wrong.text[0] != '\0' && strpbrk(wrong.text, "\r\n") == NULL));
        require(strlen(wrong.text) < sizeof wrong.text);
        for (size_t i = 0; i < c.n; i++)
            require(c.lines[i] <= size + 1);
        cage_free(&c);
    }
    free(text);
    return 0;
}
