/// One landing whose numbers may be impossible.
#include "campaign/executor.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Keeps the first error of a check.
typedef struct first_error {
    char text[512];
} first_error;

static void keep_first(void* user, bt_severity severity, bt_where where, const char* text) {
    first_error* first = user;
    (void)where;
    if (severity == BT_ERROR && !first->text[0])
        snprintf(first->text, sizeof first->text, "%s", text);
}

/// A failed run from "key: reason". It never began, so it has no time.
static void refuse(bt_landing_result* result, bt_status status, const char* message) {
    const char* colon = strstr(message, ": ");
    *result = (bt_landing_result){.outcome = BT_FAILED,
                                  .mode = BT_MODE_NONE,
                                  .margin_m = NAN,
                                  .time_of_contact_s = NAN,
                                  .failed_time_s = 0};
    const char* reason = colon ? colon + 2 : *message ? message : bt_status_text(status);
    snprintf(result->failed_element, sizeof result->failed_element, "%.*s",
             colon ? (int)(colon - message) : (int)strlen("model"), colon ? message : "model");
    snprintf(result->failed_quantity, sizeof result->failed_quantity, "%s", reason);
}

bt_status bt_landing_try(bt_lander* lander, const bt_model_params* model, bt_landing_result* result,
                         bt_landing_observer* observer, void* user) {
    first_error first = {""};
    bt_diag check = {.sink = keep_first, .user = &first};
    bt_status status = bt_group_check(&bt_model_group, model, "", &check);
    if (status == BT_OK)
        status = bt_lander_run(lander, model, result, observer, user, &check);
    if (status != BT_ERR_INPUT)
        return status;
    refuse(result, status, first.text);
    return BT_OK;
}

bt_status bt_landing_possible(bt_lander* lander, const bt_model_params* model, char* why,
                              size_t size) {
    first_error first = {""};
    bt_diag check = {.sink = keep_first, .user = &first};
    bt_status status = bt_group_check(&bt_model_group, model, "", &check);
    if (status == BT_OK)
        status = bt_lander_prepare(lander, model, &check);
    snprintf(why, size, "%s", first.text);
    return status;
}

bt_status bt_landing_at(bt_lander* lander, bt_model_params* model, const bt_input* inputs,
                        const bt_axes* axes, const double* x, bt_landing_result* result,
                        bt_landing_observer* observer, void* user) {
    for (int i = 0; i < axes->count; ++i) {
        const bt_input* input = &inputs[axes->input[i]];
        bt_field_set(input->field, model, input->offset, x[i]);
    }
    return bt_landing_try(lander, model, result, observer, user);
}
