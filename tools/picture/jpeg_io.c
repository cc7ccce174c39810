/* JPEG through libjpeg-turbo. The colour profile and the size of pixels become the picture's
 * notes. Exif's orientation is obeyed. The rest of Exif is dropped, because it describes another
 * picture. */
#include "picture/picture_file.h"

#include "base/allocate.h"

#include <jerror.h>
#include <jpeglib.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

/* The most scans of a progressive picture. Each costs a pass over the whole picture, and a few
 * bytes announce one. Encoders write about ten. */
enum { MOST_SCANS = 500 };

enum { USUAL_QUALITY = 92 };

/* libjpeg leaves its functions by longjmp, to a place that the caller sets. */
typedef struct trouble {
    struct jpeg_error_mgr manager; /* first, because libjpeg only knows this part */
    jmp_buf back;
    char message[JMSG_LENGTH_MAX];
} trouble;

static void stop(j_common_ptr jpeg)
{
    trouble *t = (trouble *)(void *)jpeg->err;
    t->manager.format_message(jpeg, t->message);
    longjmp(t->back, 1);
}

/* Warnings mean that pixels are missing or wrong, except some about data around them. */
static void warn(j_common_ptr jpeg, int level)
{
    static const int harmless[] = {JWRN_ADOBE_XFORM, JWRN_BOGUS_ICC, JWRN_EXTRANEOUS_DATA,
                                   JWRN_JFIF_MAJOR, JWRN_NOT_SEQUENTIAL};
    for (size_t i = 0; i < sizeof harmless / sizeof *harmless; i++)
        if (level >= 0 || jpeg->err->msg_code == harmless[i])
            return;
    stop(jpeg);
}

static struct jpeg_error_mgr *make_trouble(trouble *t)
{
    jpeg_std_error(&t->manager);
    t->manager.error_exit = stop;
    t->manager.emit_message = warn;
    return &t->manager;
}

/* ------------------------------------------------------------------ reading */

typedef struct reader {
    struct jpeg_decompress_struct jpeg;
    struct jpeg_progress_mgr progress;
    trouble trouble;
    JSAMPLE *row;
    unsigned orientation;
} reader;

static void count_scans(j_common_ptr jpeg)
{
    if (((j_decompress_ptr)(void *)jpeg)->input_scan_number > MOST_SCANS)
        ERREXIT(jpeg, JERR_BAD_PROGRESSION);
}

static unsigned number(const JOCTET *bytes, size_t n, bool little)
{
    unsigned value = 0;
    for (size_t i = 0; i < n; i++)
        value = value << 8 | bytes[little ? n - 1 - i : i];
    return value;
}

/* The orientation in a segment of Exif, a TIFF file whose first directory may have it. 0 if it is
 * not given. */
static unsigned read_orientation(const JOCTET *bytes, size_t n)
{
    enum { ORIENTATION = 0x112, SHORT = 3 };
    if (n < 14 || memcmp(bytes, "Exif\0", 6) != 0)
        return 0;
    bytes += 6;
    n -= 6;
    bool little = bytes[0] == 'I';
    size_t at = number(bytes + 4, 4, little);
    if (at > n - 2)
        return 0;
    size_t n_entries = number(bytes + at, 2, little);
    for (at += 2; n_entries > 0 && n - at >= 12; n_entries--, at += 12) {
        if (number(bytes + at, 2, little) == ORIENTATION &&
            number(bytes + at + 2, 2, little) == SHORT) {
            unsigned value = number(bytes + at + 8, 2, little);
            return value <= 8 ? value : 0;
        }
    }
    return 0;
}

static void read_notes(reader *r, picture_notes *notes)
{
    struct jpeg_decompress_struct *jpeg = &r->jpeg;
    JOCTET *profile;
    unsigned length;
    for (jpeg_saved_marker_ptr m = jpeg->marker_list; m != NULL && r->orientation == 0; m = m->next)
        if (m->marker == JPEG_APP0 + 1)
            r->orientation = read_orientation(m->data, m->data_length);
    if (jpeg_read_icc_profile(jpeg, &profile, &length)) {
        snprintf(notes->profile_name, sizeof notes->profile_name, "ICC profile");
        notes->profile = profile;
        notes->n_profile = length;
    }
    if (!jpeg->saw_JFIF_marker || (jpeg->density_unit == 0 && jpeg->X_density == jpeg->Y_density))
        return;
    double metre = jpeg->density_unit == 1 ? 1 / 0.0254 : jpeg->density_unit == 2 ? 100 : 1;
    notes->density[0] = (uint32_t)(jpeg->X_density * metre + 0.5);
    notes->density[1] = (uint32_t)(jpeg->Y_density * metre + 0.5);
    notes->per_metre = jpeg->density_unit == 1 || jpeg->density_unit == 2;
}

/* All calls from which libjpeg may jump. */
static bool decode(reader *r, picture *out, const char *bytes, size_t n)
{
    struct jpeg_decompress_struct *jpeg = &r->jpeg;
    if (setjmp(r->trouble.back))
        return false;
    jpeg_create_decompress(jpeg);
    r->progress.progress_monitor = count_scans;
    jpeg->progress = &r->progress;
    unsigned long n_bytes = (unsigned long)n;
    if (n_bytes != n) {
        snprintf(r->trouble.message, sizeof r->trouble.message, "it is larger than libjpeg reads");
        return false;
    }
    jpeg_mem_src(jpeg, (const unsigned char *)bytes, n_bytes);
    jpeg_save_markers(jpeg, JPEG_APP0 + 1, 0xffff);
    jpeg_save_markers(jpeg, JPEG_APP0 + 2, 0xffff);
    jpeg_read_header(jpeg, TRUE);
    if (jpeg->jpeg_color_space == JCS_CMYK || jpeg->jpeg_color_space == JCS_YCCK) {
        snprintf(r->trouble.message, sizeof r->trouble.message,
                 "its colours are those of inks (CMYK); save it with red, green and blue");
        return false;
    }
    /* A bit gives at most a block of 64 pixels; 16 allows for subsampled colours. */
    if ((uint64_t)jpeg->image_width * jpeg->image_height / (8 * 64 * 16) > n)
        ERREXIT(jpeg, JERR_INPUT_EOF);
    bool is_grey = jpeg->num_components == 1;
    jpeg->out_color_space = is_grey ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_start_decompress(jpeg);
    *out = picture_make(jpeg->output_width, jpeg->output_height, is_grey ? 1 : 3, 8);
    size_t n_samples = out->width * out->channels;
    r->row = need(n_samples, sizeof *r->row);
    while (jpeg->output_scanline < jpeg->output_height) {
        uint16_t *to = out->samples + jpeg->output_scanline * n_samples;
        jpeg_read_scanlines(jpeg, &r->row, 1);
        for (size_t i = 0; i < n_samples; i++)
            to[i] = r->row[i];
    }
    read_notes(r, &out->notes);
    jpeg_finish_decompress(jpeg);
    return true;
}

bool jpeg_decode(picture *out, const char *bytes, size_t n, problem *wrong)
{
    reader *r = need(1, sizeof *r);
    r->jpeg.err = make_trouble(&r->trouble);
    bool good = decode(r, out, bytes, n);
    if (good)
        picture_turn(out, r->orientation);
    else {
        spoilt(wrong, 0, "the JPEG picture cannot be read: %.150s", r->trouble.message);
        picture_free(out);
    }
    jpeg_destroy_decompress(&r->jpeg);
    free(r->row);
    free(r);
    return good;
}

/* ------------------------------------------------------------------ writing */

typedef struct writer {
    struct jpeg_compress_struct jpeg; /* first, because libjpeg only knows this part */
    struct jpeg_destination_mgr destination;
    trouble trouble;
    JSAMPLE *row;
    unsigned char *bytes;
    size_t n, room;
} writer;

static boolean make_room(j_compress_ptr jpeg)
{
    writer *w = (writer *)(void *)jpeg;
    w->n = w->room;
    w->bytes = grow(w->bytes, &w->room, w->n + 4096, 1);
    w->destination.next_output_byte = w->bytes + w->n;
    w->destination.free_in_buffer = w->room - w->n;
    return TRUE;
}

static void begin(j_compress_ptr jpeg)
{
    make_room(jpeg);
}

static void end(j_compress_ptr jpeg)
{
    writer *w = (writer *)(void *)jpeg;
    w->n = w->room - w->destination.free_in_buffer;
}

/* Writes the size of pixels if both numbers fit. */
static void set_density(struct jpeg_compress_struct *jpeg, const picture_notes *notes)
{
    double metre = notes->per_metre ? 0.0254 : 1, x = notes->density[0] * metre + 0.5,
           y = notes->density[1] * metre + 0.5;
    if (!(x >= 1 && y >= 1 && x < 65536 && y < 65536))
        return;
    jpeg->density_unit = notes->per_metre;
    jpeg->X_density = (UINT16)x;
    jpeg->Y_density = (UINT16)y;
}

/* All calls from which libjpeg may jump. From quality 90 on, colours are as sharp as brightness. */
static bool encode(writer *w, const picture *p, const picture_style *style)
{
    struct jpeg_compress_struct *jpeg = &w->jpeg;
    if (setjmp(w->trouble.back))
        return false;
    jpeg_create_compress(jpeg);
    w->destination.init_destination = begin;
    w->destination.empty_output_buffer = make_room;
    w->destination.term_destination = end;
    jpeg->dest = &w->destination;
    jpeg->image_width = (JDIMENSION)p->width;
    jpeg->image_height = (JDIMENSION)p->height;
    jpeg->input_components = (int)p->channels;
    jpeg->in_color_space = p->channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(jpeg);
    int quality = style->quality > 0 ? style->quality : USUAL_QUALITY;
    jpeg_set_quality(jpeg, quality, TRUE);
    jpeg->optimize_coding = TRUE;
    if (quality >= 90)
        jpeg->comp_info[0].h_samp_factor = jpeg->comp_info[0].v_samp_factor = 1;
    if (style->notes != NULL)
        set_density(jpeg, style->notes);
    jpeg_start_compress(jpeg, TRUE);
    if (style->notes != NULL && style->notes->profile != NULL)
        jpeg_write_icc_profile(jpeg, style->notes->profile, (unsigned)style->notes->n_profile);
    size_t n_samples = p->width * p->channels;
    for (size_t y = 0; y < p->height; y++) {
        const uint16_t *from = p->samples + y * n_samples;
        for (size_t i = 0; i < n_samples; i++)
            w->row[i] = (JSAMPLE)(p->depth == 8 ? from[i] : (from[i] + 128u) / 257);
        jpeg_write_scanlines(jpeg, &w->row, 1);
    }
    jpeg_finish_compress(jpeg);
    return true;
}

unsigned char *jpeg_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong)
{
    if (p->width > JPEG_MAX_DIMENSION || p->height > JPEG_MAX_DIMENSION) {
        spoilt(wrong, 0, "JPEG holds at most %ld pixels along an axis, and these are %zu x %zu",
               JPEG_MAX_DIMENSION, p->width, p->height);
        return NULL;
    }
    writer *w = need(1, sizeof *w);
    w->row = need(p->width, p->channels * sizeof *w->row);
    w->jpeg.err = make_trouble(&w->trouble);
    bool good = encode(w, p, style);
    if (!good)
        spoilt(wrong, 0, "the JPEG picture cannot be written: %.150s", w->trouble.message);
    jpeg_destroy_compress(&w->jpeg);
    free(w->row);
    unsigned char *bytes = w->bytes;
    *n = w->n;
    free(w);
    if (good)
        return bytes;
    free(bytes);
    return NULL;
}
