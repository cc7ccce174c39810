/* Any bytes at all must give a cage of finite-sized arrays or a reason, and leak nothing. */
#include "cage/cage_features.h"
#include "cage/cage_read.h"
#include "cage/cage_ties.h"
#include "fuzz.h"

static bool is_message(const problem *wrong)
{
    return wrong->text[0] != '\0' && strpbrk(wrong->text, "\r\n") == NULL &&
           strlen(wrong->text) < sizeof wrong->text;
}

/* Outlines and holes first; then features by rising numbers, ties likewise. */
static void check_features(const cage *c, size_t size)
{
    char text[120];
    for (size_t i = 0; i < c->n_features; i++) {
        const cage_feature *f = &c->features[i];
        size_t least = feature_is_ring(f) ? 3 : f->kind == ICC_FEATURE_LINE ? 2 : 1;
        require(f->n >= least && f->points != NULL && f->line <= size + 1);
        require(i == 0 || feature_is_ring(f - 1) || f->number > f[-1].number);
        require(f->radius >= 0 && (f->radius == 0 || f->kind == ICC_FEATURE_POINT));
    }
    for (size_t i = 0; i < c->n_ties; i++)
        require(c->ties[i].n >= 2 && (i == 0 || c->ties[i].number > c->ties[i - 1].number));
    for (size_t i = 0; i < c->n_more; i++) {
        require(c->more[i].dim == 2 && c->more[i].n >= 3 && c->more[i].n_more == 0);
        check_features(&c->more[i], size);
    }
    require(strlen(cage_inside_text(text, c)) < sizeof text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = text_of(data, size);
    if (text == NULL)
        return 0;
    static const char *const names[] = {"name=b", NULL, "2", NULL};
    cage cages[2] = {{0}, {0}};
    problem wrong = {.text = ""};
    for (int role = CAGE_SOURCE; role <= CAGE_TARGET; role++) {
        cage *c = &cages[role == CAGE_TARGET];
        wrong.text[0] = '\0';
        const cage_choice choice = {
            .role = (cage_role)role,
            .named = role == CAGE_TARGET ? names[size % 4] : NULL,
            .flat = {role == CAGE_TARGET ? 0.25 : 0, cages[0].n_curves, cages[0].curve_edges}};
        bool good = cage_read(c, &choice, 2, text, size, &wrong);
        const bool has_rings = cage_outlines(c) > 1 || cage_count(c, ICC_FEATURE_REGION) > 0;
        require(good ? c->cells != NULL || c->n > c->dim || has_rings
                     : c->dim == 0 && c->points == NULL);
        require(good || is_message(&wrong));
        for (size_t i = 0; i < c->n; i++)
            require(c->lines[i] <= size + 1);
        check_features(c, size);
    }
    int side;
    if (cages[0].dim == 2 && cages[1].dim == 2 &&
        !(features_correspond(&cages[0], &cages[1], &wrong) &&
          ties_correspond(&cages[0], &cages[1], &side, &wrong)))
        require(is_message(&wrong));
    cage_is_named(CAGE_TARGET, text, size);
    char message[64];
    features_translate(message, sizeof message, &cages[0], text);
    require(strlen(message) < sizeof message);
    cage_free(&cages[0]);
    cage_free(&cages[1]);
    free(text);
    return 0;
}
