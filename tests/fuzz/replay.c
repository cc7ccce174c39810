/* Runs a fuzzer without libFuzzer: on every file of its corpus, and on a fixed number of random
 * variations of them: a share of these, times ICC_FUZZ_TIMES. usage: replay CORPUS_DIR [ROUNDS] */
#define _POSIX_C_SOURCE 200809L

#include "../share.h"

#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MAX_FILES = 4096, MAX_SIZE = 1 << 16 };

typedef struct input {
    uint8_t *data;
    size_t size;
} input;

/* xorshift64*, so that every machine runs the same inputs. */
static uint64_t random_below(uint64_t *state, uint64_t limit)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (*state * UINT64_C(2685821657736338717) >> 33) % limit;
}

/* An exactly sized copy, so that a sanitizer sees the first byte read beyond the end. */
static void run(const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size > 0 ? size : 1);
    if (copy == NULL)
        exit(2);
    memcpy(copy, data, size);
    (void)LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

static input read_file(const char *directory, const char *name)
{
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE *file = fopen(path, "rb");
    input in = {malloc(MAX_SIZE), 0};
    if (file == NULL || in.data == NULL) {
        perror(path);
        exit(2);
    }
    in.size = fread(in.data, 1, MAX_SIZE, file);
    (void)fclose(file);
    return in;
}

static int by_name(const struct dirent **a, const struct dirent **b)
{
    return strcmp((*a)->d_name, (*b)->d_name);
}

static int visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static size_t read_corpus(const char *directory, input *corpus)
{
    struct dirent **entries = NULL;
    const int n_entries = scandir(directory, &entries, visible, by_name);
    if (n_entries <= 0) {
        (void)fprintf(stderr, "%s: no corpus\n", directory);
        exit(2);
    }
    size_t n = 0;
    for (int i = 0; i < n_entries; ++i) {
        if (n < MAX_FILES)
            corpus[n++] = read_file(directory, entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
    return n;
}

/* Overwrites up to eight bytes, then cuts, or appends a piece of the same input. */
static size_t vary(const input *in, uint8_t *out, uint64_t *state)
{
    size_t size = in->size;
    memcpy(out, in->data, size);
    for (uint64_t k = random_below(state, 9); k > 0 && size > 0; --k)
        out[random_below(state, size)] = (uint8_t)random_below(state, 256);
    const uint64_t choice = random_below(state, 4);
    if (choice == 0)
        return (size_t)random_below(state, size + 1);
    if (choice == 1 && size > 0 && size < MAX_SIZE) {
        size_t extra = 1 + (size_t)random_below(state, size);
        if (extra > MAX_SIZE - size)
            extra = MAX_SIZE - size;
        memmove(out + size, out, extra);
        size += extra;
    }
    return size;
}

int main(int argc, char **argv)
{
    static input corpus[MAX_FILES];
    static uint8_t variation[MAX_SIZE];
    if (argc < 2) {
        (void)fprintf(stderr, "usage: replay CORPUS_DIR [ROUNDS]\n");
        return 2;
    }
    const char *times = getenv("ICC_FUZZ_TIMES");
    const long rounds = share_of(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 10000) *
                        (times != NULL ? strtol(times, NULL, 10) : 1);
    const size_t n = read_corpus(argv[1], corpus);
    for (size_t i = 0; i < n; ++i)
        run(corpus[i].data, corpus[i].size);
    uint64_t state = UINT64_C(0x9e3779b97f4a7c15);
    for (long i = 0; i < rounds; ++i) {
        const size_t size = vary(&corpus[random_below(&state, n)], variation, &state);
        run(variation, size);
    }
    (void)printf("%zu files, %ld variations\n", n, rounds);
    for (size_t i = 0; i < n; ++i)
        free(corpus[i].data);
    return 0;
}
