#include "study/correlations.h"

#include "base/text.h"
#include "study/inputs.h"

#include <string.h>

static const char name[] = "uncertainty.correlation";

/// The random input that is meant; -1 after reporting.
static int find(bt_reader* reader, bt_study* study, const bt_node* node) {
    char help[320];
    bt_text_nearest nearest = bt_text_search(node->text);
    const bt_input* input = bt_inputs_find(study, node->text);
    for (int i = 0; i < study->input_count; ++i)
        if (study->inputs[i].random)
            bt_text_look(&nearest, study->inputs[i].path);
    if (!input || !input->random) {
        bt_reader_error(reader, node->where, "%s: \"%s\" has no distribution in uncertainty%s",
                        name, node->text, bt_text_suggest(&nearest, help, sizeof help));
        return -1;
    }
    if (bt_distribution_has_atoms(&input->distribution)) {
        bt_reader_error(reader, node->where,
                        "%s: %s takes single values (%s), which have no density that a correlation "
                        "could change; an empirical one has with a bandwidth",
                        name, node->text, bt_distribution_names[input->distribution.kind]);
        return -1;
    }
    return (int)(input - study->inputs);
}

static bool is_known(const bt_study* study, int a, int b) {
    for (int i = 0; i < study->correlation_count; ++i) {
        const bt_correlation* c = &study->correlations[i];
        if ((c->first == a && c->second == b) || (c->first == b && c->second == a))
            return true;
    }
    return false;
}

static void read_pair(bt_reader* reader, bt_study* study, const bt_node* node) {
    static const bt_field rank = {.kind = BT_FIELD_PLAIN, .unit = "", .least = -1, .greatest = 1};
    if (node->kind != BT_NODE_SEQUENCE || node->count != 3) {
        bt_reader_error(reader, node->where,
                        "%s: two inputs and their rank correlation are wanted here, as in "
                        "[landing.sink_speed, landing.pitch, -0.4]",
                        name);
        return;
    }
    bt_correlation c = {find(reader, study, node->first), find(reader, study, node->first->next),
                        0};
    if (!bt_reader_number(reader, &rank, node->last, name, true, &c.rank) || c.first < 0 ||
        c.second < 0)
        return;
    if (c.first == c.second || is_known(study, c.first, c.second))
        bt_reader_error(reader, node->where, "%s: %s", name,
                        c.first == c.second ? "an input with itself" : "this pair is given twice");
    else if (study->correlation_count < BT_CORRELATION_MAX)
        study->correlations[study->correlation_count++] = c;
}

void bt_correlations_read(bt_reader* reader, bt_study* study, const bt_node* node) {
    const int before = reader->errors;
    if (node->kind != BT_NODE_SEQUENCE) {
        bt_reader_error(reader, node->where,
                        "%s: a sequence of [input, input, rank correlation] is wanted here", name);
        return;
    }
    for (const bt_node* pair = node->first; pair; pair = pair->next)
        read_pair(reader, study, pair);
    if (reader->errors != before)
        return;
    const int fit = bt_copula_make(study->correlations, study->correlation_count,
                                   study->input_count, &study->copula);
    const bt_node* pair = node->first;
    for (int i = 0; i < fit; ++i)
        pair = pair->next;
    if (pair)
        bt_reader_error(reader, pair->where,
                        "%s: with %s and %s at %s the correlations are not positive definite: no "
                        "variables can be correlated so (pairs not given are 0); weaken this one "
                        "or others of these inputs",
                        name, pair->first->text, pair->first->next->text, pair->last->text);
}
