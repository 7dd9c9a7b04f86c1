#include "study/inputs.h"

#include "base/text.h"
#include "base/units.h"
#include "study/correlations.h"
#include "study/uncertainty.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 256 };

// --- paths ----------------------------------------------------------------------------------

static bool may_be_input(const bt_field* field) {
    return field->kind == BT_FIELD_REAL || field->kind == BT_FIELD_PLAIN;
}

static bool look_at_path(void* user, const bt_field* field, const char* path, size_t offset) {
    (void)offset;
    if (may_be_input(field))
        bt_text_look(user, path);
    return true;
}

static void report_path(bt_reader* reader, const bt_node* key, const char* chapter,
                        const bt_model_params* model, const bt_field* field) {
    const char* typed = key->text;
    if (field && (field->kind == BT_FIELD_GROUP || field->kind == BT_FIELD_VARIANT)) {
        const bt_group* below =
            field->kind == BT_FIELD_GROUP ? field->group : field->variant->groups[0];
        bt_reader_error(reader, key->where,
                        "%s.%s: a group of keys; name one of its values, as in %s.%s", chapter,
                        typed, typed, below->fields[0].name);
        return;
    }
    if (field) {
        bt_reader_error(reader, key->where,
                        "%s.%s: only a number that may take any value in a range can vary", chapter,
                        typed);
        return;
    }
    bt_text_nearest nearest = bt_text_search(typed);
    bt_params_walk(&bt_model_group, model, look_at_path, &nearest);
    char help[PATH_SIZE + 32];
    bt_text_suggest(&nearest, help, sizeof help);
    bt_reader_error(reader, key->where, "%s.%s: no such key of the model%s", chapter, typed,
                    *help ? help : "; it must be a path as in landing.sink_speed");
}

bt_input* bt_inputs_find_or_add(bt_reader* reader, bt_study* study, const bt_node* key,
                                const char* chapter) {
    for (int i = 0; i < study->input_count; ++i)
        if (strcmp(study->inputs[i].path, key->text) == 0)
            return &study->inputs[i];
    size_t offset;
    const bt_field* field = bt_params_find(&bt_model_group, &study->model, key->text, &offset);
    if (!field || !may_be_input(field) || strlen(key->text) >= BT_PATH_MAX) {
        report_path(reader, key, chapter, &study->model, field);
        return NULL;
    }
    if (study->input_count == BT_INPUT_MAX) {
        bt_reader_error(reader, key->where, "%s.%s: more than %d inputs", chapter, key->text,
                        (int)BT_INPUT_MAX);
        return NULL;
    }
    bt_input* input = &study->inputs[study->input_count++];
    *input = (bt_input){.field = field, .offset = offset, .where = key->where};
    snprintf(input->path, sizeof input->path, "%s", key->text);
    return input;
}

bt_input* bt_inputs_find(bt_study* study, const char* path) {
    for (int i = 0; i < study->input_count; ++i)
        if (strcmp(study->inputs[i].path, path) == 0)
            return &study->inputs[i];
    return NULL;
}

// --- bounds, levels, conditions -------------------------------------------------------------

static bool is_sequence(bt_reader* reader, const bt_node* node, const char* path,
                        const char* wanted) {
    if (node->kind == BT_NODE_SEQUENCE || node->refused)
        return node->kind == BT_NODE_SEQUENCE;
    bt_reader_error(reader, node->where, "%s: %s is wanted here", path, wanted);
    return false;
}

static void read_range(bt_reader* reader, bt_input* input, const bt_node* node, const char* path) {
    if (!is_sequence(reader, node, path, "a range [least, greatest]"))
        return;
    if (node->count != 2) {
        bt_reader_error(reader, node->where, "%s: a range has two values; this has %d", path,
                        node->count);
        return;
    }
    double lower, upper;
    const bool lower_read = bt_reader_number(reader, input->field, node->first, path, true, &lower);
    const bool upper_read = bt_reader_number(reader, input->field, node->last, path, true, &upper);
    if (!lower_read || !upper_read)
        return;
    if (!(lower < upper)) {
        bt_reader_error(reader, node->where, "%s: %s is not below %s", path, node->first->text,
                        node->last->text);
        return;
    }
    snprintf(input->typed, sizeof input->typed, "%s", node->first->text);
    input->bounded = true;
    input->lower = lower;
    input->upper = upper;
}

static void read_bounds(bt_reader* reader, bt_study* study, const bt_node* node) {
    if (!bt_reader_is_mapping(reader, node, "campaign.bounds"))
        return;
    for (const bt_node* child = node->first; child; child = child->next) {
        char path[PATH_SIZE];
        bt_reader_join(path, sizeof path, "campaign.bounds", child->key->text);
        bt_input* input = bt_inputs_find_or_add(reader, study, child->key, "campaign.bounds");
        if (input)
            read_range(reader, input, child, path);
    }
}

static void read_levels(bt_reader* reader, bt_study* study, const bt_node* node,
                        const bt_node* bounds) {
    static const bt_field level = {.kind = BT_FIELD_COUNT, .unit = "", .least = 2, .greatest = 1e6};
    if (!bt_reader_is_mapping(reader, node, "campaign.levels"))
        return;
    for (const bt_node* child = node->first; child; child = child->next) {
        char path[PATH_SIZE];
        bt_reader_join(path, sizeof path, "campaign.levels", child->key->text);
        bt_input* input = bt_inputs_find(study, child->key->text);
        double levels;
        if (!bt_node_child(bounds, child->key->text))
            bt_reader_error(reader, child->key->where, "%s: has no range in campaign.bounds", path);
        else if (bt_reader_number(reader, &level, child, path, true, &levels) && input)
            input->levels = (int)levels;
    }
    if (study->campaign.design != BT_DESIGN_FULL_FACTORIAL && node->count > 0)
        bt_reader_error(reader, node->key->where,
                        "campaign.levels: only the design full_factorial has levels, not %s",
                        bt_design_names[study->campaign.design]);
}

static void add_condition(bt_reader* reader, bt_study* study, int index, const bt_node* node,
                          const char* path) {
    const bt_input* input = &study->inputs[index];
    double mean;
    if (!bt_reader_number(reader, input->field, node, path, true, &mean))
        return;
    if (!input->random) // its distribution was refused: said once, where it stands
        return;
    if (input->bounded && !(mean >= input->lower && mean <= input->upper)) {
        char lower[64], upper[64];
        const char* unit;
        bt_unit_print_as(input->lower, node->text, lower, sizeof lower, &unit);
        bt_unit_print_as(input->upper, node->text, upper, sizeof upper, &unit);
        bt_reader_error(reader, node->where, "%s: %s is outside campaign.bounds, %s .. %s%s%s",
                        path, node->text, lower, upper, *unit ? " " : "", unit);
        return;
    }
    if (study->condition_count == BT_CONDITION_MAX) {
        bt_reader_error(reader, node->where, "%s: more than %d conditions", path,
                        (int)BT_CONDITION_MAX);
        return;
    }
    const bt_distribution moved = bt_distribution_moved(&input->distribution, mean);
    const char* fault = bt_distribution_check(&moved);
    if (fault) {
        bt_reader_error(reader, node->where, "%s: %s with the mean at %s", path, fault, node->text);
        return;
    }
    study->conditions[study->condition_count++] = (bt_condition){index, mean};
}

static void read_conditions(bt_reader* reader, bt_study* study, const bt_node* node,
                            const bt_node* uncertainty) {
    if (!bt_reader_is_mapping(reader, node, "reliability.conditions"))
        return;
    for (const bt_node* child = node->first; child; child = child->next) {
        char path[PATH_SIZE];
        bt_reader_join(path, sizeof path, "reliability.conditions", child->key->text);
        const bt_input* input = bt_inputs_find(study, child->key->text);
        if (!bt_node_child(uncertainty, child->key->text)) {
            bt_reader_error(reader, child->key->where,
                            "%s: has no distribution in uncertainty whose mean could move", path);
            continue;
        }
        if (!input || !is_sequence(reader, child, path, "a sequence of means"))
            continue;
        for (const bt_node* item = child->first; item; item = item->next)
            add_condition(reader, study, (int)(input - study->inputs), item, path);
    }
}

// --- together -------------------------------------------------------------------------------

static int by_offset(const void* a, const void* b) {
    const size_t x = ((const bt_input*)a)->offset, y = ((const bt_input*)b)->offset;
    return (x > y) - (x < y);
}

/// A surrogate knows only the axes of the design: every random input must be one of them, and its
/// mean inside.
static void check_coverage(bt_reader* reader, const bt_study* study) {
    if (bt_design_is_random(study->campaign.design))
        return;
    for (int i = 0; i < study->input_count; ++i) {
        const bt_input* input = &study->inputs[i];
        if (!input->random || input->distribution.kind == BT_CONSTANT)
            continue;
        const double mean = bt_distribution_mean(&input->distribution);
        if (!input->bounded)
            bt_reader_error(reader, input->where,
                            "uncertainty.%s: random, but no axis of the design; give it a range "
                            "in campaign.bounds",
                            input->path);
        else if (!(mean >= input->lower && mean <= input->upper))
            bt_reader_error(reader, input->where,
                            "uncertainty.%s: its mean lies outside its campaign.bounds",
                            input->path);
    }
}

static bool any_bounds(const bt_study* study) {
    for (int i = 0; i < study->input_count; ++i)
        if (study->inputs[i].bounded)
            return true;
    return false;
}

void bt_inputs_read(bt_reader* reader, const bt_study_files* files, bt_study* study,
                    const bt_node* uncertainty, const bt_node* bounds, const bt_node* levels,
                    const bt_node* conditions) {
    const int before = reader->errors;
    if (uncertainty)
        bt_uncertainty_read(reader, files, study, uncertainty);
    if (bounds)
        read_bounds(reader, study, bounds);
    // the tables' order, so that the order of a file's lines never changes a result
    qsort(study->inputs, (size_t)study->input_count, sizeof study->inputs[0], by_offset);
    if (bt_node_child(uncertainty, "correlation"))
        bt_correlations_read(reader, study, bt_node_child(uncertainty, "correlation"));
    if (levels)
        read_levels(reader, study, levels, bounds);
    if (conditions)
        read_conditions(reader, study, conditions, uncertainty);
    if (reader->errors == before && any_bounds(study))
        check_coverage(reader, study);
}
