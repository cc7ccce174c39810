/* Takes PNG files apart and puts their parts in a row. A part is its length, a name of four
 * letters, its bytes and a checksum. */
#include "plot/film.h"

#include <string.h>

enum {
    SIGNATURE = 8,
    HEAD = 8,
    TAIL = 4,
    SIZE = 8 /* bytes at the beginning of IHDR: width, height */
};

static void put_number(unsigned char *at, uint32_t value)
{
    for (int k = 0; k < 4; k++)
        at[k] = (unsigned char)(value >> (24 - 8 * k));
}

static uint32_t number_at(const unsigned char *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* The cyclic redundancy check of PNG, four bits at a time. Begin and end with the complement. */
static uint32_t check(uint32_t sum, const unsigned char *bytes, size_t n)
{
    uint32_t table[16];
    for (uint32_t i = 0; i < 16; i++) {
        table[i] = i;
        for (int k = 0; k < 4; k++)
            table[i] = table[i] >> 1 ^ (table[i] & 1 ? UINT32_C(0xedb88320) : 0);
    }
    for (size_t i = 0; i < n; i++) {
        sum = sum >> 4 ^ table[(sum ^ bytes[i]) & 15];
        sum = sum >> 4 ^ table[(sum ^ (uint32_t)bytes[i] >> 4) & 15];
    }
    return sum;
}

/* Writes a part whose bytes are in two pieces. */
static void write_part(film *f, const char *name, const unsigned char *first, size_t n_first,
                       const unsigned char *rest, size_t n_rest)
{
    unsigned char head[HEAD], tail[TAIL];
    put_number(head, (uint32_t)(n_first + n_rest));
    memcpy(head + 4, name, 4);
    uint32_t sum = check(~UINT32_C(0), head + 4, 4);
    sum = check(check(sum, first, n_first), rest, n_rest);
    put_number(tail, ~sum);
    fwrite(head, 1, sizeof head, f->file.stream);
    fwrite(first, 1, n_first, f->file.stream);
    fwrite(rest, 1, n_rest, f->file.stream);
    fwrite(tail, 1, sizeof tail, f->file.stream);
}

bool film_open(film *out, const char *name, uint32_t n_pictures, uint32_t rate)
{
    *out = (film){.rate = rate, .n_pictures = n_pictures};
    return outfile_open(&out->file, name);
}

/* Announces a picture: its size, no offset, how long it is shown, and that it replaces what was
 * there. */
static void write_control(film *f, const unsigned char *size)
{
    unsigned char control[26] = {0};
    put_number(control, f->n_parts++);
    memcpy(control + 4, size, SIZE);
    control[21] = 1; /* 1 / rate of a second */
    control[22] = (unsigned char)(f->rate >> 8);
    control[23] = (unsigned char)f->rate;
    write_part(f, "fcTL", control, sizeof control, control, 0);
}

/* Writes what a film has before its first picture's colours. */
static void write_heading(film *f)
{
    unsigned char counts[8] = {0}; /* pictures, and 0 for a film without an end */
    put_number(counts, f->n_pictures);
    write_part(f, "acTL", counts, sizeof counts, counts, 0);
}

/* Writes the bytes of a picture's colours. Only those of the first picture are where PNG has
 * them. */
static void write_colours(film *f, const unsigned char *bytes, size_t n)
{
    unsigned char number[4];
    if (f->n_written == 0) {
        write_part(f, "IDAT", bytes, n, bytes, 0);
        return;
    }
    put_number(number, f->n_parts++);
    write_part(f, "fdAT", number, sizeof number, bytes, n);
}

void film_add(film *f, const unsigned char *png, size_t n)
{
    bool is_first = f->n_written == 0, announced = false;
    if (is_first)
        fwrite(png, 1, SIGNATURE, f->file.stream);
    for (size_t at = SIGNATURE; at + HEAD + TAIL <= n;) {
        const unsigned char *part = png + at, *bytes = part + HEAD;
        size_t length = number_at(part);
        bool colours = memcmp(part + 4, "IDAT", 4) == 0;
        if (colours && !announced) {
            if (is_first)
                write_heading(f);
            write_control(f, png + SIGNATURE + HEAD);
            announced = true;
        }
        if (colours)
            write_colours(f, bytes, length);
        else if (is_first && memcmp(part + 4, "IEND", 4) != 0)
            fwrite(part, 1, HEAD + length + TAIL, f->file.stream);
        at += HEAD + length + TAIL;
    }
    f->n_written++;
}

bool film_close(film *f)
{
    static const unsigned char none[1];
    write_part(f, "IEND", none, 0, none, 0);
    return outfile_close(&f->file);
}

void film_abandon(film *f)
{
    outfile_abandon(&f->file);
}
