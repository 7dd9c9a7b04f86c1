#include "reliability/classifier.h"

#include "surrogate/features.h"
#include "surrogate/predictor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GATHER = 128 };

struct bt_surrogate_classifier {
    bt_classifier classifier;
    bt_predictor* predictor;
    bt_features features;    ///< of the study's inputs
    int dims, inputs;        ///< of the surrogate, of the study
    int input[BT_INPUT_MAX]; ///< the study's input, or input_count + feature, behind each
    bool straight;           ///< the same inputs in the same order
};

static void classify(void* user, const double* x, int n, int8_t* label, float* decision) {
    const bt_surrogate_classifier* c = user;
    if (c->straight) {
        bt_predictor_label(c->predictor, x, n, label, decision);
        return;
    }
    double extended[GATHER * (BT_INPUT_MAX + BT_FEATURES)], gathered[GATHER * BT_INPUT_MAX];
    const int wide = c->inputs + c->features.count;
    for (int at = 0; at < n; at += GATHER) {
        const int count = n - at < GATHER ? n - at : GATHER;
        bt_features_extend(&c->features, x + (size_t)at * (size_t)c->inputs, count, extended);
        for (int i = 0; i < count; ++i)
            for (int k = 0; k < c->dims; ++k)
                gathered[i * c->dims + k] = extended[i * wide + c->input[k]];
        bt_predictor_label(c->predictor, gathered, count, label + at, decision + at);
    }
}

/// The place of a surrogate's input among the study's inputs and features; -1: none.
static int find_input(const bt_study* study, const bt_features* features, const char* path) {
    for (int i = 0; i < study->input_count; ++i)
        if (!strcmp(study->inputs[i].path, path))
            return i;
    for (int i = 0; i < features->count; ++i)
        if (!strcmp(bt_feature_names[i], path))
            return study->input_count + i;
    return -1;
}

static bt_status find_inputs(const bt_study* study, const bt_surrogate* surrogate,
                             bt_surrogate_classifier* c, bt_diag* diag) {
    bt_status status = BT_OK;
    for (int k = 0; k < c->dims; ++k) {
        const int input = c->input[k] = find_input(study, &c->features, surrogate->path[k]);
        c->straight = c->straight && input == k;
        if (input < 0) {
            bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                        "the surrogate was trained on %s, which is not an input of this study; run "
                        "fit again",
                        surrogate->path[k]);
            status = BT_ERR_INPUT;
        } else if (input < c->inputs) {
            c->classifier.least[input] = surrogate->least[k];
            c->classifier.greatest[input] = surrogate->greatest[k];
        }
    }
    return status;
}

bt_status bt_surrogate_classifier_create(const bt_study* study, const bt_surrogate* surrogate,
                                         bt_surrogate_classifier** made, bt_diag* diag) {
    *made = NULL;
    bt_surrogate_classifier* c = calloc(1, sizeof *c);
    if (!c)
        return BT_ERR_MEMORY;
    int all[BT_INPUT_MAX];
    for (int i = 0; i < study->input_count; ++i)
        all[i] = i;
    c->dims = surrogate->dims;
    c->inputs = study->input_count;
    c->straight = c->dims == c->inputs;
    c->features = bt_features_of(study, all, study->input_count);
    c->classifier =
        (bt_classifier){.classify = classify, .user = c, .dims = c->inputs, .boxed = true};
    for (int i = 0; i < c->inputs; ++i) {
        c->classifier.least[i] = -INFINITY;
        c->classifier.greatest[i] = INFINITY;
    }
    bt_status status = find_inputs(study, surrogate, c, diag);
    if (status == BT_OK)
        status = bt_predictor_create(surrogate, bt_isa_best(), &c->predictor);
    if (status == BT_OK)
        *made = c;
    else
        bt_surrogate_classifier_destroy(c);
    return status;
}

void bt_surrogate_classifier_destroy(bt_surrogate_classifier* made) {
    if (!made)
        return;
    bt_predictor_destroy(made->predictor);
    free(made);
}

const bt_classifier* bt_surrogate_classifier_get(const bt_surrogate_classifier* made) {
    return &made->classifier;
}

void bt_surrogate_name(bt_surrogate* surrogate, const bt_study* study, const int* inputs,
                       int count) {
    for (int k = 0; k < surrogate->dims; ++k) {
        const char* name = k < count ? study->inputs[inputs[k]].path : bt_feature_names[k - count];
        memcpy(surrogate->path[k], name, strlen(name) + 1);
    }
}
