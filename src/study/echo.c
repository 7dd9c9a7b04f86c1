#include "study/echo.h"

#include "base/text.h"
#include "base/units.h"
#include "study/uncertainty.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_SIZE = 128, INDENT = 2 };

// --- text -----------------------------------------------------------------------------------

/// A value with its unit, and what was typed where that is not the same.
static void write_value(FILE* out, const char* value, const bt_node* typed) {
    fputs(value, out);
    const bool same = typed && typed->kind == BT_NODE_SCALAR && strcmp(typed->text, value) == 0;
    if (!typed)
        fputs("  # default", out);
    else if (!same && typed->kind == BT_NODE_SCALAR && !strpbrk(typed->text, "\r\n"))
        fprintf(out, "  # typed: %s", typed->text);
    fputc('\n', out);
}

static void write_list(FILE* out, const bt_field* field, const bt_list* list) {
    char text[TEXT_SIZE];
    fputc('[', out);
    for (int i = 0; i < list->count; ++i) {
        bt_unit_print(list->value[i], field->unit, text, sizeof text);
        fprintf(out, "%s%s", i ? ", " : "", text);
    }
    fputs("]\n", out);
}

static void write_table(FILE* out, const bt_field* field, const bt_table* table) {
    char x[TEXT_SIZE], y[TEXT_SIZE], x_token[32];
    const char* middle = strstr(field->unit, "__");
    snprintf(x_token, sizeof x_token, "%.*s", (int)(middle - field->unit), field->unit);
    fputc('[', out);
    for (int i = 0; i < table->count; ++i) {
        bt_unit_print(table->x[i], x_token, x, sizeof x);
        bt_unit_print(table->y[i], middle + 2, y, sizeof y);
        fprintf(out, "%s[%s, %s]", i ? ", " : "", x, y);
    }
    fputs("]\n", out);
}

static void write_group(FILE* out, const bt_group* group, const void* params, int depth,
                        const bt_node* typed);

static void write_variant(FILE* out, const bt_variant* variant, const bt_variant_head* member,
                          int depth, const bt_node* typed);

static void write_field(FILE* out, const bt_field* field, const void* member, int depth,
                        const bt_node* typed) {
    char text[TEXT_SIZE];
    fprintf(out, "%*s%s:%s", depth * INDENT, "", field->name,
            field->kind == BT_FIELD_GROUP || field->kind == BT_FIELD_VARIANT ? "\n" : " ");
    switch (field->kind) {
    case BT_FIELD_REAL:
    case BT_FIELD_PLAIN:
    case BT_FIELD_COUNT:
        bt_unit_print(bt_field_get(field, member, 0), *field->unit ? field->unit : "1", text,
                      sizeof text);
        write_value(out, text, typed);
        break;
    case BT_FIELD_FLAG:
        write_value(out, *(const bool*)member ? "true" : "false", typed);
        break;
    case BT_FIELD_CHOICE:
        write_value(out, field->choices[*(const int*)member], typed);
        break;
    case BT_FIELD_LIST:
        write_list(out, field, member);
        break;
    case BT_FIELD_TABLE:
        write_table(out, field, member);
        break;
    case BT_FIELD_GROUP:
        write_group(out, field->group, member, depth + 1, typed);
        break;
    case BT_FIELD_VARIANT:
        write_variant(out, field->variant, member, depth + 1, typed);
        break;
    }
}

static void write_variant(FILE* out, const bt_variant* variant, const bt_variant_head* member,
                          int depth, const bt_node* typed) {
    write_field(out, &variant->type, &member->type, depth,
                bt_node_child(typed, variant->type.name));
    write_group(out, bt_variant_group(variant, member), member->params, depth, typed);
}

static void write_group(FILE* out, const bt_group* group, const void* params, int depth,
                        const bt_node* typed) {
    for (int i = 0; i < group->field_count; ++i) {
        const bt_field* field = &group->fields[i];
        write_field(out, field, (const char*)params + field->offset, depth,
                    bt_node_child(typed, field->name));
    }
}

/// A text as a double-quoted scalar.
static void write_quoted(FILE* out, const char* text) {
    fputc('"', out);
    for (; *text; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(out, "\\%c", c);
        else if (c < ' ' || c == 0x7f)
            fprintf(out, "\\x%02X", c);
        else
            fputc(c, out);
    }
    fputs("\"\n", out);
}

static void write_parameter(FILE* out, const bt_input* input, const char* name, double value) {
    char text[TEXT_SIZE];
    const bool plain = bt_distribution_is_plain(name) || input->field->kind == BT_FIELD_PLAIN;
    bt_unit_print(value, plain ? "1" : input->field->unit, text, sizeof text);
    fprintf(out, ", %s: %s", name, text);
}

/// Values in full, so that the text needs no other file; equal ones of a file as often as they
/// were.
static void write_sample(FILE* out, const bt_input* input) {
    const bt_sample* sample = input->distribution.sample;
    const bool discrete = input->distribution.kind == BT_DISCRETE;
    const char* unit = *input->field->unit ? input->field->unit : "1";
    const char* between = "";
    char text[TEXT_SIZE];
    double value, weight;
    fputs(", values: [", out);
    for (int i = 0; i < bt_sample_count(sample); ++i) {
        bt_sample_get(sample, i, &value, &weight);
        bt_unit_print(value, unit, text, sizeof text);
        for (int k = 0; k < (discrete ? 1 : (int)weight); ++k, between = ", ")
            fprintf(out, "%s%s", between, text);
    }
    fputs(discrete ? "], probabilities: [" : "]", out);
    for (int i = 0; i < bt_sample_count(sample) && discrete; ++i) {
        bt_sample_get(sample, i, &value, &weight);
        bt_text_print_number(weight, text, sizeof text);
        fprintf(out, "%s%s", i > 0 ? ", " : "", text);
    }
    if (discrete)
        fputc(']', out);
    else if (bt_sample_is_smooth(sample))
        write_parameter(out, input, "bandwidth", bt_sample_bandwidth_of(sample));
}

static void write_uncertainty(FILE* out, const bt_study* study) {
    bool begun = false;
    for (int i = 0; i < study->input_count; ++i) {
        const bt_input* input = &study->inputs[i];
        if (!input->random)
            continue;
        if (!begun)
            fputs("uncertainty:\n", out);
        begun = true;
        bt_distribution d = input->distribution;
        fprintf(out, "  %s: {distribution: %s", input->path, bt_distribution_names[d.kind]);
        const char* const* names = bt_distribution_parameters(d.kind);
        if (d.sample)
            write_sample(out, input);
        for (; *names && !d.sample; ++names)
            if (!isinf(*bt_distribution_parameter(&d, *names))) // a bound that is not there
                write_parameter(out, input, *names, *bt_distribution_parameter(&d, *names));
        fputs("}\n", out);
    }
    for (int i = 0; i < study->correlation_count; ++i) {
        const bt_correlation* c = &study->correlations[i];
        char text[TEXT_SIZE];
        bt_text_print_number(c->rank, text, sizeof text);
        fprintf(out, "%s[%s, %s, %s]%s", i == 0 ? "  correlation: [" : ", ",
                study->inputs[c->first].path, study->inputs[c->second].path, text,
                i + 1 == study->correlation_count ? "]\n" : "");
    }
}

static void print_input(const bt_input* input, double value, char* text) {
    bt_unit_print(value, *input->field->unit ? input->field->unit : "1", text, TEXT_SIZE);
}

static void write_bounds(FILE* out, const bt_study* study) {
    bool begun = false;
    for (int i = 0; i < study->input_count; ++i) {
        const bt_input* input = &study->inputs[i];
        if (!input->bounded)
            continue;
        if (!begun)
            fputs("  bounds:\n", out);
        begun = true;
        char lower[TEXT_SIZE], upper[TEXT_SIZE];
        print_input(input, input->lower, lower);
        print_input(input, input->upper, upper);
        fprintf(out, "    %s: [%s, %s]\n", input->path, lower, upper);
    }
}

static void write_levels(FILE* out, const bt_study* study) {
    bool begun = false;
    for (int i = 0; i < study->input_count; ++i) {
        const bt_input* input = &study->inputs[i];
        if (input->levels <= 0)
            continue;
        if (!begun)
            fputs("  levels:\n", out);
        begun = true;
        fprintf(out, "    %s: %d\n", input->path, input->levels);
    }
}

static void write_conditions(FILE* out, const bt_study* study) {
    int last = -1;
    for (int i = 0; i < study->condition_count; ++i) {
        const bt_condition* c = &study->conditions[i];
        const bt_input* input = &study->inputs[c->input];
        char text[TEXT_SIZE];
        print_input(input, c->mean, text);
        if (i == 0)
            fputs("  conditions:\n", out);
        if (c->input != last)
            fprintf(out, "%s    %s: [%s", i > 0 ? "]\n" : "", input->path, text);
        else
            fprintf(out, ", %s", text);
        last = c->input;
    }
    if (last >= 0)
        fputs("]\n", out);
}

/// Names of the measured curves, as comments: nothing that is computed depends on them, and this
/// text may be read where the files are not.
static void write_curves(FILE* out, const bt_study* study) {
    for (int kind = 0; kind < BT_RIG_COUNT; ++kind)
        for (int i = 0; i < study->rig_inputs[kind].curve_count; ++i) {
            const char* path = study->rig_inputs[kind].curves[i].path;
            const char* slash = strrchr(path, '/');
            fprintf(out, "# rigs.%s.reference.curve: ", bt_rig_keys[kind]);
            write_quoted(out, slash ? slash + 1 : path);
        }
}

static void write_study(FILE* out, const bt_study* study, const bt_node* root) {
    fputs("title: ", out);
    write_quoted(out, study->title);
    write_group(out, &bt_model_group, &study->model, 0, root);
    write_uncertainty(out, study);
    fputs("campaign:\n", out);
    write_group(out, &bt_campaign_group, &study->campaign, 1, bt_node_child(root, "campaign"));
    write_bounds(out, study);
    write_levels(out, study);
    fputs("surrogate:\n", out);
    write_group(out, &bt_surrogate_group, &study->surrogate, 1, bt_node_child(root, "surrogate"));
    fputs("reliability:\n", out);
    write_group(out, &bt_reliability_group, &study->reliability, 1,
                bt_node_child(root, "reliability"));
    write_conditions(out, study);
    fputs("rigs:\n", out);
    write_group(out, &bt_rigs_group, &study->rigs, 1, bt_node_child(root, "rigs"));
    write_curves(out, study);
}

char* bt_study_echo(const bt_study* study, const bt_node* root) {
    char* text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    write_study(out, study, root);
    const bool failed = ferror(out) != 0;
    if (fclose(out) != 0 || failed) {
        free(text);
        return NULL;
    }
    return text;
}
