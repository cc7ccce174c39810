/* Khronos Group, glTF 2.0 Specification, 2021: sections 3.6 (buffers) and 4 (the binary form).
 *
 * All buffers become one, each from a multiple of four bytes on. In the JSON only the list of
 * buffers, and the buffer and offset of each view, change. */
#include "base/gltf_pack.h"

#include "base/allocate.h"
#include "base/base64.h"
#include "base/bytes.h"
#include "base/file.h"
#include "base/json_decode.h"
#include "base/json_in.h"
#include "base/json_scan.h"
#include "base/json_tree.h"
#include "base/system.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N_HEAD = 12, N_CHUNK = 8 };

/* Looks at the members of the outermost object, up to its "type", which other formats have. */
bool gltf_told(const char *text, size_t n)
{
    json_scan s;
    bool is_scene = false;
    json_scan_start(&s, text, n);
    bool goes_on = json_scan_next(&s) == JSON_OBJECT;
    while (goes_on && !is_scene && json_scan_next(&s) == JSON_NAME) {
        const char *begin = s.text + s.begin, *end = s.text + s.end;
        bool is_type = json_string_is(begin, end, "type");
        is_scene = json_string_is(begin, end, "asset");
        json_kind kind = json_scan_next(&s);
        goes_on = !is_type && json_scan_skip(&s, kind) != JSON_BAD;
    }
    json_scan_end(&s);
    return is_scene;
}

/* ----------------------------------------------------------------- buffers */

typedef struct packer {
    const char *name;
    json_tree tree;
    size_t n_buffers;
    size_t *begins; /* of each buffer, in the chunk */
    char *chunk;    /* its head and the bytes of all buffers */
    size_t n, room;
    problem *wrong;
} packer;

/* Adds n bytes, and zeros up to a multiple of four. */
static void add_bytes(packer *p, const char *bytes, size_t n)
{
    size_t padded = (n + 3) / 4 * 4;
    p->chunk = grow(p->chunk, &p->room, p->n + padded, 1);
    memcpy(p->chunk + p->n, bytes, n);
    memset(p->chunk + p->n + n, 0, padded - n);
    p->n += padded;
}

static bool add_whole(packer *p, size_t index, const char *bytes, size_t n, size_t wanted)
{
    if (n < wanted)
        return spoilt(p->wrong, 0, "buffers[%zu] should have %zu bytes, but it has %zu", index,
                      wanted, n);
    add_bytes(p, bytes, wanted);
    return true;
}

static bool add_data(packer *p, size_t index, const char *uri, size_t wanted)
{
    static const char mark[] = ";base64";
    const size_t n_mark = sizeof mark - 1;
    const char *comma = strchr(uri, ',');
    if (comma == NULL || (size_t)(comma - uri) < n_mark ||
        memcmp(comma - n_mark, mark, n_mark) != 0)
        return spoilt(p->wrong, 0, "buffers[%zu].uri has data that are not in base64", index);
    size_t n_text = strlen(++comma), n;
    char *bytes = need(n_text / 4 + 1, 3);
    bool good = base64_decode(comma, n_text, bytes, &n)
                    ? add_whole(p, index, bytes, n, wanted)
                    : spoilt(p->wrong, 0, "buffers[%zu].uri is not base64", index);
    free(bytes);
    return good;
}

/* Replaces %XY by the byte XY. False if it is none. */
static bool decode_percent(char *text)
{
    char *to = text;
    for (const char *from = text; *from != '\0'; from++) {
        int value = (unsigned char)*from;
        if (*from == '%') {
            int high = json_hex_digit(from[1]), low = high < 0 ? -1 : json_hex_digit(from[2]);
            value = low < 0 ? 0 : 16 * high + low;
            from += 2;
        }
        if (value == 0)
            return false;
        *to++ = (char)value;
    }
    *to = '\0';
    return true;
}

/* True for a file in the scene's folder or below it. */
static bool is_near(const char *path)
{
    bool near = path[0] != '\0' && path[0] != '/' && strpbrk(path, ":\\") == NULL;
    for (const char *part = path; near && part != NULL; part = strchr(part, '/')) {
        part += *part == '/';
        near = strncmp(part, "..", 2) != 0 || (part[2] != '/' && part[2] != '\0');
    }
    return near;
}

/* Reads a file beside the scene. */
static bool add_file(packer *p, size_t index, const char *uri, size_t wanted)
{
    const size_t n_folder = (size_t)(system_last_part(p->name) - p->name), n_uri = strlen(uri);
    char *path = need(n_folder + n_uri + 1, 1), shown[32];
    memcpy(path, p->name, n_folder);
    memcpy(path + n_folder, uri, n_uri + 1);
    bool good = strcmp(p->name, "-") != 0 ||
                spoilt(p->wrong, 0,
                       "buffers[%zu] is the file '%s', but standard input has no folder; name the "
                       "scene's file",
                       index, quoted(shown, uri));
    if (good && !(decode_percent(path + n_folder) && is_near(path + n_folder)))
        good = spoilt(p->wrong, 0,
                      "buffers[%zu] is at '%s'; only files in the scene's folder or below it are "
                      "read, so put it there",
                      index, quoted(shown, uri));
    size_t n = 0;
    char *bytes = good ? file_read(path, &n) : NULL;
    good = bytes != NULL && add_whole(p, index, bytes, n, wanted);
    free(bytes);
    free(path);
    return good;
}

static bool add_buffer(packer *p, const json_item *buffer, size_t index)
{
    char where[48];
    uint32_t wanted;
    const char *uri = json_string_of(json_get(buffer, "uri"));
    snprintf(where, sizeof where, "buffers[%zu].byteLength", index);
    p->begins[index] = p->n - N_CHUNK;
    if (!json_index(json_get(buffer, "byteLength"), where, "number of bytes", UINT32_MAX, &wanted,
                    p->wrong))
        return false;
    if (json_get(json_get(buffer, "extensions"), "EXT_meshopt_compression") != NULL)
        return spoilt(p->wrong, 0, "buffers[%zu] is compressed; save without compression", index);
    if (uri == NULL)
        return spoilt(p->wrong, 0, "buffers[%zu] has no uri, so its bytes are missing", index);
    return (strncmp(uri, "data:", 5) == 0 ? add_data : add_file)(p, index, uri, wanted);
}

static bool add_buffers(packer *p)
{
    const json_item *list = json_get(p->tree.root, "buffers");
    if (!json_list(list, "buffers", &p->n_buffers, p->wrong))
        return false;
    p->begins = need(p->n_buffers, sizeof *p->begins);
    p->chunk = grow(p->chunk, &p->room, N_CHUNK, 1);
    p->n = N_CHUNK;
    size_t i = 0;
    for (const json_item *x = json_first(list); x != NULL; x = json_next(x))
        if (!add_buffer(p, x, i++))
            return false;
    put_little_endian((unsigned char *)p->chunk, (uint32_t)(p->n - N_CHUNK));
    memcpy(p->chunk + 4, "BIN", 4);
    return true;
}

/* -------------------------------------------------------------------- JSON */

/* Sets the buffer of a view to the only one, and its offset there. */
static bool move_view(const packer *p, edits *e, const json_item *view, size_t index)
{
    char where[48];
    uint32_t buffer, offset = 0;
    const json_item *number = json_get(view, "buffer"), *at = json_get(view, "byteOffset");
    snprintf(where, sizeof where, "bufferViews[%zu].buffer", index);
    if (!json_index(number, where, "glTF buffer", p->n_buffers, &buffer, p->wrong))
        return false;
    snprintf(where, sizeof where, "bufferViews[%zu].byteOffset", index);
    if (at != NULL && !json_index(at, where, "number", UINT32_MAX, &offset, p->wrong))
        return false;
    if (buffer == 0)
        return true;
    edits_replace(e, number->begin, number->end);
    edits_put_text(e, "0");
    edits_replace(e, at != NULL ? at->begin : view->end - 1, at != NULL ? at->end : view->end - 1);
    edits_put_text(e, at != NULL ? "" : ",\"byteOffset\":");
    edits_put_number(e, (double)p->begins[buffer] + (double)offset);
    return true;
}

static bool edit_json(const packer *p, edits *e)
{
    const json_item *buffers = json_get(p->tree.root, "buffers"),
                    *views = json_get(p->tree.root, "bufferViews");
    size_t i = 0, n;
    if (!json_list(views, "bufferViews", &n, p->wrong))
        return false;
    for (const json_item *view = json_first(views); view != NULL; view = json_next(view))
        if (!move_view(p, e, view, i++))
            return false;
    if (p->n_buffers == 0)
        return true;
    edits_replace(e, buffers->begin, buffers->end);
    edits_put_text(e, "[{\"byteLength\":");
    edits_put_number(e, (double)(p->n - N_CHUNK));
    edits_put_text(e, "}]");
    return true;
}

static bool is_version_2(const packer *p)
{
    const char *version = json_string_of(json_get(json_get(p->tree.root, "asset"), "version"));
    char shown[32];
    return (version != NULL && strncmp(version, "2.", 2) == 0) ||
           spoilt(p->wrong, 0, "this is glTF version %s; libicc reads version 2",
                  version != NULL ? quoted(shown, version) : "?");
}

char *gltf_join(edits *e, const char *json, size_t n_json, const char *rest, size_t n_rest,
                size_t *n)
{
    char *edited = edits_apply(e, json, &n_json, NULL, 0);
    size_t padded = (n_json + 3) / 4 * 4;
    *n = N_HEAD + N_CHUNK + padded + n_rest;
    char *out = need(*n + 1, 1), *at = out;
    memcpy(at, "glTF", 4);
    put_little_endian((unsigned char *)at + 4, 2);
    put_little_endian((unsigned char *)at + 8, (uint32_t)*n);
    put_little_endian((unsigned char *)at + N_HEAD, (uint32_t)padded);
    memcpy(at + N_HEAD + 4, "JSON", 4);
    at += N_HEAD + N_CHUNK;
    memcpy(at, edited, n_json);
    memset(at + n_json, ' ', padded - n_json);
    free(edited);
    if (n_rest > 0)
        memcpy(at + padded, rest, n_rest);
    return out;
}

char *gltf_pack(const char *name, const char *text, size_t n, size_t *n_packed, problem *wrong)
{
    packer p = {.name = name, .wrong = wrong};
    edits e = {0};
    char *out = NULL;
    size_t mark = n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    *wrong = (problem){0};
    if (json_tree_read(&p.tree, text + mark, n - mark, wrong) && is_version_2(&p) &&
        add_buffers(&p) && edit_json(&p, &e)) {
        const size_t n_chunk = p.n_buffers > 0 ? p.n : 0;
        if (n - mark + n_chunk + e.n_bytes > UINT32_MAX / 2)
            spoilt(wrong, 0, "the scene is larger than one binary file can be");
        else
            out = gltf_join(&e, text + mark, p.tree.root->end, p.chunk, n_chunk, n_packed);
    }
    edits_free(&e);
    json_tree_free(&p.tree);
    free(p.begins);
    free(p.chunk);
    return out;
}
