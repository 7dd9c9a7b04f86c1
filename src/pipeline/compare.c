#include "pipeline/compare.h"

#include "study/identity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- keys ---------------------------------------------------------------------------------------

/// What landings drawn from the distributions depend on, as lines "path = value".
static char* lines_of(const bt_study* study, int64_t seed) {
    bt_study* copy = malloc(sizeof *copy); // owns nothing
    if (!copy)
        return NULL;
    *copy = *study;
    copy->campaign.design = BT_DESIGN_MONTE_CARLO;
    copy->campaign.seed = seed;
    char* text = bt_study_identity(copy);
    free(copy);
    return text;
}

static const char* next_line(const char* line) {
    line += strcspn(line, "\n");
    return line + (*line == '\n');
}

/// The line of a text that begins with the same path; NULL: there is none.
static const char* line_of(const char* text, const char* path, size_t length) {
    for (; *text; text = next_line(text))
        if (strncmp(text, path, length) == 0)
            return text;
    return NULL;
}

static void copy_value(const char* line, size_t path, char* value) {
    const size_t length = strcspn(line + path, "\n");
    snprintf(value, BT_KEY_VALUE_SIZE, "%.*s", (int)length, line + path);
}

/// Lines of `text` that `other` has not, or has otherwise. swapped: `text` is that of the second
/// study, and what both have was noted before.
static void note_keys(bt_comparison* c, const char* text, const char* other, bool swapped) {
    for (; *text; text = next_line(text)) {
        const char* equals = strstr(text, " = ");
        const size_t length = strcspn(text, "\n");
        if (!equals || equals > text + length)
            continue;
        const size_t path = (size_t)(equals - text) + 3;
        const char* twin = line_of(other, text, path);
        if (twin && (swapped || (strcspn(twin, "\n") == length && !strncmp(twin, text, length))))
            continue;
        if (c->key_count < BT_DIFFERENT_KEYS_MAX) {
            bt_different_key* k = &c->key[c->key_count];
            *k = (bt_different_key){0};
            snprintf(k->path, sizeof k->path, "%.*s", (int)(equals - text), text);
            copy_value(text, path, swapped ? k->second : k->first);
            if (twin)
                copy_value(twin, path, k->second);
        }
        ++c->key_count;
    }
}

static bt_status compare_keys(const bt_compare_stage* s, bt_comparison* c) {
    char* first = lines_of(s->first, 0);
    char* second = lines_of(s->second, 0);
    const bool there = first && second;
    if (there) {
        note_keys(c, first, second, false);
        note_keys(c, second, first, true);
    }
    free(first);
    free(second);
    return there ? BT_OK : BT_ERR_MEMORY;
}

// --- landings -----------------------------------------------------------------------------------

static void warn_of_inputs(const bt_compare_stage* s, bt_diag* diag) {
    const bt_study* const study[2] = {s->first, s->second};
    int at[2] = {0, 0};
    for (;;) {
        const char* path[2] = {NULL, NULL};
        for (int k = 0; k < 2; ++k) {
            while (at[k] < study[k]->input_count && !study[k]->inputs[at[k]].random)
                ++at[k];
            if (at[k] < study[k]->input_count)
                path[k] = study[k]->inputs[at[k]++].path;
        }
        if (!path[0] && !path[1])
            return;
        if (path[0] && path[1] && strcmp(path[0], path[1]) == 0)
            continue;
        bt_diag_add(diag, BT_WARNING, BT_NOWHERE,
                    "the studies do not scatter the same inputs (%s against %s): from there on "
                    "their landings share no random numbers, and the interval is as wide as that "
                    "of separate samples",
                    path[0] ? path[0] : "nothing", path[1] ? path[1] : "nothing");
        return;
    }
}

static bt_status run(const bt_compare_stage* s, int which, bt_noise_landing* landings,
                     bt_diag* diag) {
    bt_study* study = malloc(sizeof *study); // owns nothing
    if (!study)
        return BT_ERR_MEMORY;
    *study = which ? *s->second : *s->first;
    study->campaign.seed = s->first->campaign.seed;
    bt_status status = bt_noise_run(study, NULL, s->count, (int)s->first->campaign.threads, s->stop,
                                    s->backend, landings, diag);
    if (status == BT_OK)
        status = bt_noise_check_failed(study, landings, s->count, diag);
    free(study);
    return status;
}

static void count(const bt_noise_landing* first, const bt_noise_landing* second, int64_t n,
                  bt_comparison* c) {
    for (int64_t i = 0; i < n; ++i) {
        const bool a = first[i].outcome == BT_ENGAGED, b = second[i].outcome == BT_ENGAGED;
        if (first[i].outcome == BT_FAILED || second[i].outcome == BT_FAILED)
            ++c->failed;
        else if (a)
            ++*(b ? &c->pairs.both : &c->pairs.first_only);
        else
            ++*(b ? &c->pairs.second_only : &c->pairs.neither);
    }
    const int64_t trials = n - c->failed, both = c->pairs.both;
    const int64_t engaged[2] = {both + c->pairs.first_only, both + c->pairs.second_only};
    for (int k = 0; k < 2; ++k) {
        c->engaged[k] = trials > 0 ? (double)engaged[k] / (double)trials : NAN;
        c->engaged_ci95[k] = bt_clopper_pearson(engaged[k], trials, 0.95);
    }
    c->difference = bt_paired_compare(&c->pairs);
}

bt_status bt_stage_compare(const bt_compare_stage* s, bt_comparison* c, bt_diag* diag) {
    *c = (bt_comparison){0};
    BT_TRY(compare_keys(s, c));
    warn_of_inputs(s, diag);
    bt_noise_landing* first = calloc((size_t)s->count, sizeof *first);
    bt_noise_landing* second = calloc((size_t)s->count, sizeof *second);
    bt_status status = first && second ? run(s, 0, first, diag) : BT_ERR_MEMORY;
    if (status == BT_OK)
        status = run(s, 1, second, diag);
    if (status == BT_OK)
        count(first, second, s->count, c);
    free(first);
    free(second);
    return status;
}
