#include "study/identity.h"

#include "base/hash.h"
#include "base/text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct writer {
    FILE* out;
    const bt_study* study;
    const void* params;
} writer;

/// Whether the design gives an input its values: by its distribution or by its bounds.
static bool is_axis(const bt_study* study, const bt_input* input) {
    return bt_design_is_random(study->campaign.design) ? input->random : input->bounded;
}

/// Whether no run has a key's own value, as every run gets one from the design.
static bool is_replaced(const bt_study* study, const char* path) {
    for (int i = 0; i < study->input_count; ++i)
        if (is_axis(study, &study->inputs[i]) && strcmp(study->inputs[i].path, path) == 0)
            return true;
    return false;
}

static void write_number(FILE* out, double value) {
    char text[40];
    bt_text_print_number(value, text, sizeof text);
    fprintf(out, " %s", text);
}

static bool write_field(void* user, const bt_field* field, const char* path, size_t offset) {
    const writer* w = user;
    const char* const member = (const char*)w->params + offset;
    if (is_replaced(w->study, path))
        return true;
    fprintf(w->out, "%s =", path);
    switch (field->kind) {
    case BT_FIELD_FLAG:
        fprintf(w->out, " %s", *(const bool*)member ? "true" : "false");
        break;
    case BT_FIELD_CHOICE:
        fprintf(w->out, " %s", field->choices[*(const int*)member]);
        break;
    case BT_FIELD_LIST: {
        const bt_list* list = (const bt_list*)member;
        for (int i = 0; i < list->count; ++i)
            write_number(w->out, list->value[i]);
        break;
    }
    case BT_FIELD_TABLE: {
        const bt_table* table = (const bt_table*)member;
        for (int i = 0; i < table->count; ++i) {
            write_number(w->out, table->x[i]);
            write_number(w->out, table->y[i]);
        }
        break;
    }
    default:
        write_number(w->out, bt_field_get(field, w->params, offset));
    }
    fputc('\n', w->out);
    return true;
}

static void write_distribution(FILE* out, const bt_input* input) {
    const bt_distribution* d = &input->distribution;
    fprintf(out, "uncertainty.%s = %s", input->path, bt_distribution_names[d->kind]);
    const double value[] = {d->mean, d->sd, d->lower, d->upper, d->mode, d->scale, d->shape};
    for (size_t i = 0; i < sizeof value / sizeof value[0]; ++i)
        write_number(out, value[i]);
    if (d->sample)
        fprintf(out, " values %016" PRIx64, bt_sample_hash(d->sample));
    fputc('\n', out);
}

static void write_bounds(FILE* out, const bt_input* input, bool with_levels) {
    fprintf(out, "campaign.bounds.%s =", input->path);
    write_number(out, input->lower);
    write_number(out, input->upper);
    if (with_levels)
        fprintf(out, " levels %d", input->levels);
    fputc('\n', out);
}

/// What makes the points. Those of the designs sobol and monte_carlo do not depend on their number:
/// a campaign may grow. Those of a factorial do not depend on the seed.
static void write_design(FILE* out, const bt_study* study) {
    const int design = study->campaign.design;
    const bool factorial = design == BT_DESIGN_FULL_FACTORIAL;
    fprintf(out, "campaign.design = %s\n", bt_design_names[design]);
    if (!factorial)
        fprintf(out, "campaign.seed = %lld\n", (long long)study->campaign.seed);
    if (factorial || design == BT_DESIGN_LATIN_HYPERCUBE)
        fprintf(out, "campaign.samples = %lld\n", (long long)study->campaign.samples);
    for (int i = 0; i < study->input_count; ++i) {
        const bt_input* input = &study->inputs[i];
        if (!is_axis(study, input))
            continue;
        if (bt_design_is_random(design))
            write_distribution(out, input);
        else
            write_bounds(out, input, factorial);
    }
}

/// The conditions that the design draws from, and how.
static void write_conditions(FILE* out, const bt_study* study) {
    for (int i = 0; i < study->condition_count; ++i) {
        fprintf(out, "reliability.conditions.%s =", study->inputs[study->conditions[i].input].path);
        write_number(out, study->conditions[i].mean);
        fputc('\n', out);
    }
    fprintf(out, "campaign.unsure =");
    write_number(out, study->campaign.unsure);
    fputc('\n', out);
}

static void write_correlations(FILE* out, const bt_study* study) {
    for (int i = 0; i < study->correlation_count; ++i) {
        const bt_correlation* c = &study->correlations[i];
        fprintf(out, "uncertainty.correlation.%s.%s =", study->inputs[c->first].path,
                study->inputs[c->second].path);
        write_number(out, c->rank);
        fputc('\n', out);
    }
}

char* bt_study_identity(const bt_study* study) {
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    write_design(out, study);
    if (bt_design_is_random(study->campaign.design))
        write_correlations(out, study);
    if (study->campaign.design == BT_DESIGN_CONDITIONS)
        write_conditions(out, study);
    writer w = {.out = out, .study = study, .params = &study->model};
    bt_params_walk(&bt_model_group, &study->model, write_field, &w);
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}

uint64_t bt_study_identity_hash(const char* identity) {
    return bt_hash_bytes(BT_HASH_START, identity, strlen(identity));
}
