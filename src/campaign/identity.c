#include "base/text.h"
#include "campaign/ledger.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct writer {
    FILE* out;
    const void* params;
} writer;

static void write_number(FILE* out, double value) {
    char text[40];
    bt_text_print_number(value, text, sizeof text);
    fprintf(out, " %s", text);
}

static bool write_field(void* user, const bt_field* field, const char* path, size_t offset) {
    const writer* w = user;
    const char* const member = (const char*)w->params + offset;
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

static void write_axis(FILE* out, const bt_input* input, bool by_distribution) {
    if (by_distribution) {
        const bt_distribution* d = &input->distribution;
        fprintf(out, "uncertainty.%s = %s", input->path, bt_distribution_names[d->kind]);
        const double value[] = {d->mean, d->sd, d->lower, d->upper, d->mode, d->scale, d->shape};
        for (size_t i = 0; i < sizeof value / sizeof value[0]; ++i)
            write_number(out, value[i]);
    } else {
        fprintf(out, "campaign.bounds.%s =", input->path);
        write_number(out, input->lower);
        write_number(out, input->upper);
        fprintf(out, " levels %d", input->levels);
    }
    fputc('\n', out);
}

char* bt_study_identity(const bt_study* study) {
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    const int design = study->campaign.design;
    fprintf(out, "campaign.design = %s\ncampaign.seed = %lld\n", bt_design_names[design],
            (long long)study->campaign.seed);
    /* The points of the other designs do not depend on their number: a campaign may grow. */
    if (design == BT_DESIGN_LATIN_HYPERCUBE || design == BT_DESIGN_FULL_FACTORIAL)
        fprintf(out, "campaign.samples = %lld\n", (long long)study->campaign.samples);
    const bt_axes axes = bt_design_axes(study);
    for (int i = 0; i < axes.count; ++i)
        write_axis(out, &study->inputs[axes.input[i]], design == BT_DESIGN_MONTE_CARLO);
    writer w = {.out = out, .params = &study->model};
    bt_params_walk(&bt_model_group, &study->model, write_field, &w);
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    return text;
}
