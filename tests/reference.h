/// The reference study as the landing tests use it: read once per test program from
/// studies/reference (tests run in the repository's root), changed by --set texts.
#ifndef BT_TESTS_REFERENCE_H
#define BT_TESTS_REFERENCE_H

#include "near.h"

#include "landing/landing.h"
#include "study/study.h"

#include <stdio.h>

/// A sink that keeps all messages in one text.
typedef struct messages {
    char text[4096];
} messages;

static inline void keep_message(void* user, bt_severity severity, bt_where where,
                                const char* text) {
    messages* kept = user;
    const size_t used = strlen(kept->text);
    bt_diag_format(kept->text + used, sizeof kept->text - used, severity, where, text);
}

/// The reference model with COUNT texts PATH=VALUE applied.
static inline bt_model_params reference_model(const char* const* sets, int count) {
    static bt_study study; // large
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (bt_study_read("studies/reference/study.yaml", sets, count, &study, &diag) != BT_OK)
        fail_msg("the reference study cannot be read: %s", kept.text);
    const bt_model_params model = study.model;
    bt_study_destroy(&study);
    return model;
}

/// The reference model with the texts in the braces: REFERENCE("landing.pitch=5 deg").
#define REFERENCE(...)                                                                             \
    reference_model((const char* const[]){__VA_ARGS__},                                            \
                    (int)(sizeof((const char* const[]){__VA_ARGS__}) / sizeof(const char*)))

/// Runs a landing that must be assembled and must not fail.
static inline bt_landing_result land(bt_lander* lander, const bt_model_params* model,
                                     bt_landing_observer* observer, void* user) {
    bt_landing_result result;
    messages kept = {""};
    bt_diag diag = {.sink = keep_message, .user = &kept};
    if (bt_lander_run(lander, model, &result, observer, user, &diag) != BT_OK)
        fail_msg("the landing was refused: %s", kept.text);
    if (result.outcome == BT_FAILED)
        fail_msg("the landing failed: %s, %s at %g s", result.failed_element,
                 result.failed_quantity, result.failed_time_s);
    return result;
}

static inline bt_lander* new_lander(void) {
    bt_lander* lander = NULL;
    assert_int_equal(bt_lander_create(&lander), BT_OK);
    return lander;
}

#endif
