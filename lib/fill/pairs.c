/* Sets of pairs of numbers, as hash tables. */
#include "fill/pairs.h"

static uint64_t key_of(uint32_t a, uint32_t b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

/* Returns the place of a key, or where it would be. */
static size_t find(const iccp_pairs *p, uint64_t key)
{
    uint64_t hash = key * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
    size_t at = (size_t)(hash * 0xbf58476d1ce4e5b9u >> 20) & (p->room - 1);
    while (p->when[at] == p->now && p->key[at] != key)
        at = (at + 1) & (p->room - 1);
    return at;
}

static bool grow(iccp_pairs *p)
{
    iccp_pairs bigger = {.memory = p->memory, .room = p->room > 0 ? 2 * p->room : 64, .now = 1};
    bigger.key = iccp_alloc(&p->memory, bigger.room, sizeof *bigger.key);
    bigger.when = iccp_alloc_zero(&p->memory, bigger.room, sizeof *bigger.when);
    if (bigger.key == NULL || bigger.when == NULL) {
        iccp_pairs_free(&bigger);
        return false;
    }
    for (size_t i = 0; i < p->room; ++i)
        if (p->when[i] == p->now) {
            const size_t at = find(&bigger, p->key[i]);
            bigger.key[at] = p->key[i];
            bigger.when[at] = 1;
        }
    bigger.n = p->n;
    iccp_pairs_free(p);
    *p = bigger;
    return true;
}

iccp_pair_added iccp_pairs_add(iccp_pairs *p, uint32_t a, uint32_t b)
{
    if (2 * p->n >= p->room && !grow(p))
        return ICCP_PAIR_MEMORY;
    const uint64_t key = key_of(a, b);
    const size_t at = find(p, key);
    if (p->when[at] == p->now)
        return ICCP_PAIR_KNOWN;
    p->key[at] = key;
    p->when[at] = p->now;
    ++p->n;
    return ICCP_PAIR_NEW;
}

bool iccp_pairs_have(const iccp_pairs *p, uint32_t a, uint32_t b)
{
    return p->room > 0 && p->when[find(p, key_of(a, b))] == p->now;
}

void iccp_pairs_clear(iccp_pairs *p)
{
    p->n = 0;
    if (++p->now != 0)
        return;
    for (size_t i = 0; i < p->room; ++i)
        p->when[i] = 0;
    p->now = 1;
}

void iccp_pairs_free(iccp_pairs *p)
{
    iccp_free(&p->memory, p->key);
    iccp_free(&p->memory, p->when);
}
