#include "study/uncertainty.h"

#include "study/inputs.h"
#include "study/samples.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 256 };

double* bt_distribution_parameter(bt_distribution* d, const char* name) {
    const struct {
        const char* name;
        double* value;
    } rows[] = {{"mean", &d->mean},   {"sd", &d->sd},        {"lower", &d->lower},
                {"upper", &d->upper}, {"mode", &d->mode},    {"scale", &d->scale},
                {"shape", &d->shape}, {"freedom", &d->shape}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
        if (strcmp(rows[i].name, name) == 0)
            return rows[i].value;
    return NULL;
}

bool bt_distribution_is_plain(const char* name) {
    return strcmp(name, "shape") == 0 || strcmp(name, "freedom") == 0;
}

/// Whether `lower` is where the distribution begins, 0 when it is not given.
static bool has_location(const bt_distribution* d) {
    return d->kind == BT_WEIBULL || d->kind == BT_EXPONENTIAL || d->kind == BT_GAMMA ||
           d->kind == BT_RAYLEIGH;
}

/// Whether a parameter that is not given has a value all the same: the mean is then the key's own
/// value, a location is zero, a bound of a truncated normal is infinite.
static bool may_be_left_out(const bt_distribution* d, const char* name) {
    if (strcmp(name, "mean") == 0)
        return true;
    if (d->kind == BT_TRUNCATED_NORMAL)
        return strcmp(name, "lower") == 0 || strcmp(name, "upper") == 0;
    return strcmp(name, "lower") == 0 && has_location(d);
}

static void read_parameter(bt_reader* reader, const bt_input* input, const bt_node* node,
                           const char* name, const char* path, bt_distribution* d) {
    static const bt_field plain = {.kind = BT_FIELD_PLAIN, .unit = ""};
    char place[PATH_SIZE];
    bt_reader_join(place, sizeof place, path, name);
    const bt_node* value = bt_node_child(node, name);
    const bool shape = bt_distribution_is_plain(name);
    // values of the key itself, not widths, nor a location that no sample needs to come near
    const bool width = shape || strcmp(name, "sd") == 0 || strcmp(name, "scale") == 0;
    const bool ranged = !width && !(has_location(d) && strcmp(name, "lower") == 0);
    if (value)
        bt_reader_number(reader, shape ? &plain : input->field, value, place, ranged,
                         bt_distribution_parameter(d, name));
    else if (!may_be_left_out(d, name))
        bt_reader_error(reader, node->key->where, "%s: missing; %s needs it", place,
                        bt_distribution_names[d->kind]);
}

static void read_distribution(bt_reader* reader, const bt_study_files* files, bt_study* study,
                              bt_input* input, const bt_node* node, const char* path) {
    static const char* const kind_key[] = {"distribution", NULL};
    const int before = reader->errors;
    if (!bt_reader_is_mapping(reader, node, path))
        return;
    char place[PATH_SIZE];
    bt_reader_join(place, sizeof place, path, "distribution");
    const bt_node* kind_node = bt_node_child(node, "distribution");
    int kind;
    if (!kind_node) {
        bt_reader_error(reader, node->key->where, "%s: missing; wanted: normal, uniform, ...",
                        place);
        return;
    }
    if (!bt_reader_choice(reader, bt_distribution_names, kind_node, place, &kind))
        return;
    bt_distribution* d = &input->distribution;
    *d = (bt_distribution){.kind = (bt_distribution_kind)kind};
    d->mean = bt_field_get(input->field, &study->model, input->offset);
    if (d->kind == BT_TRUNCATED_NORMAL) {
        d->lower = -INFINITY;
        d->upper = INFINITY;
    }
    const char* const* names = bt_distribution_parameters(d->kind);
    bt_reader_known_keys(reader, node, path, kind_key, names);
    if (d->kind == BT_DISCRETE || d->kind == BT_EMPIRICAL)
        bt_sample_read(reader, files, study, input, node, path);
    else
        for (; *names; ++names)
            read_parameter(reader, input, node, *names, path, d);
    const bt_node* sd = bt_node_child(node, "sd");
    if (sd && sd->kind == BT_NODE_SCALAR && !*input->typed)
        snprintf(input->typed, sizeof input->typed, "%s", sd->text);
    const char* fault = reader->errors == before ? bt_distribution_check(d) : NULL;
    if (fault)
        bt_reader_error(reader, node->key->where, "%s: %s", path, fault);
    input->random = reader->errors == before;
}

void bt_uncertainty_read(bt_reader* reader, const bt_study_files* files, bt_study* study,
                         const bt_node* node) {
    if (!bt_reader_is_mapping(reader, node, "uncertainty"))
        return;
    for (const bt_node* child = node->first; child; child = child->next) {
        char path[PATH_SIZE];
        if (strcmp(child->key->text, "correlation") == 0) // when all inputs are known
            continue;
        bt_reader_join(path, sizeof path, "uncertainty", child->key->text);
        bt_input* input = bt_inputs_find_or_add(reader, study, child->key, "uncertainty");
        if (input)
            read_distribution(reader, files, study, input, child, path);
    }
}
