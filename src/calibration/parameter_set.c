#include "calibration/parameter_set.h"

#include <stdio.h>
#include <string.h>

static const char rigs_prefix[] = "rigs.";
enum { PREFIX_LENGTH = sizeof rigs_prefix - 1 };

const bt_field* bt_parameter_set_find(const bt_parameter_set* set, const char* path,
                                      size_t* offset) {
    const bool of_rigs = strncmp(path, rigs_prefix, PREFIX_LENGTH) == 0;
    size_t inner = 0;
    const bt_field* field =
        of_rigs ? bt_params_find(&bt_rigs_group, &set->rigs, path + PREFIX_LENGTH, &inner)
                : bt_params_find(&bt_model_group, &set->model, path, &inner);
    *offset =
        inner + (of_rigs ? offsetof(bt_parameter_set, rigs) : offsetof(bt_parameter_set, model));
    return field;
}

/// The paths of a group below a prefix.
typedef struct search {
    bt_text_nearest nearest;
    const char* prefix;
} search;

static bool look_at_path(void* user, const bt_field* field, const char* path, size_t offset) {
    search* s = user;
    char whole[BT_TEXT_NAME_MAX];
    (void)offset;
    snprintf(whole, sizeof whole, "%s%s", s->prefix, path);
    if (field->kind <= BT_FIELD_COUNT)
        bt_text_look(&s->nearest, whole);
    return true;
}

bt_text_nearest bt_parameter_set_nearest(const bt_parameter_set* set, const char* typed) {
    search s = {.nearest = bt_text_search(typed), .prefix = ""};
    bt_params_walk(&bt_model_group, &set->model, look_at_path, &s);
    s.prefix = rigs_prefix;
    bt_params_walk(&bt_rigs_group, &set->rigs, look_at_path, &s);
    return s.nearest;
}

bt_status bt_parameter_set_check(const bt_parameter_set* set, bt_parameter_set_part part,
                                 bt_diag* diag) {
    const bt_aircraft_params* a = &set->model.aircraft;
    if (part == BT_PART_LANDING)
        return bt_group_check(&bt_model_group, &set->model, "", diag);
    bt_status status;
    if (part == BT_PART_HOOK)
        status = bt_group_check(&bt_hook_group, &a->hook, "aircraft.hook", diag);
    else if (part == BT_PART_NOSE_GEAR)
        status = bt_group_check(&bt_gear_group, &a->nose_gear, "aircraft.nose_gear", diag);
    else
        status = bt_group_check(&bt_gear_group, &a->main_gear, "aircraft.main_gear", diag);
    const bt_status rigs = bt_group_check(&bt_rigs_group, &set->rigs, "rigs", diag);
    return status != BT_OK ? status : rigs;
}
